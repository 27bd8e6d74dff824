// The files of surfaces, by way of assimp, in a process of its own: assimp breaks over some files.
#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "forming_sim/config/fault.h"
#include "files/read_apart.h"
#include "tool_surface.h"

namespace forming_sim {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

using Transform = Eigen::Matrix<double, 3, 4>;

Transform times(const Transform& a, const aiMatrix4x4& m) {
  Eigen::Matrix4d b;
  b << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return a * b;
}

// The meshes of a node and of the nodes below it, each where its node puts it.
void append(const aiScene& scene, const aiNode& node, const Transform& to_root, Triangles& all) {
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const int first = static_cast<int>(all.points.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& x = part.mVertices[v];
      all.points.push_back(to_root * Eigen::Vector4d(x.x, x.y, x.z, 1));
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (face.mIndices[k] >= part.mNumVertices)
          throw Error(Code::mesh_error, all.source + ": face " + std::to_string(f) + " names vertex " + std::to_string(face.mIndices[k]) + " of " + std::to_string(part.mNumVertices) +
                                            "; the file is damaged or cut short: write it again");
      if (face.mNumIndices == 3)
        all.corners.push_back({first + int(face.mIndices[0]), first + int(face.mIndices[1]), first + int(face.mIndices[2])});
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    append(scene, *node.mChildren[c], times(to_root, node.mChildren[c]->mTransformation), all);
}

/// What assimp does not see in an STL file: that it was cut short.
void check_stl(const std::string& path, const std::string& source) {
  constexpr std::uintmax_t kHead = 84, kTriangle = 50;  // bytes, of a binary one
  constexpr std::streamoff kEnd = 4096;
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, &head[kHead - sizeof triangles], sizeof triangles);
  if (size >= kHead && size == kHead + kTriangle * triangles) return;
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos || head.compare(begin, 5, "solid") != 0)
    throw Error(Code::mesh_error, source + ": it does not begin with solid, as an STL file of text does, and as a binary one it would have " + std::to_string(kHead + kTriangle * triangles) + " bytes for the " +
                                      std::to_string(triangles) + " triangles that it announces, not " + std::to_string(size) + "; it is damaged or cut short: write it again");
  file.clear();
  file.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(size) - kEnd));
  const std::string end{std::istreambuf_iterator<char>(file), {}};
  const std::size_t closed = end.rfind("endsolid"), open = end.rfind("endfacet");
  if (closed == std::string::npos || (open != std::string::npos && open > closed))
    throw Error(Code::mesh_error, source + ": it begins with solid, and does not end with endsolid; it is cut short: write it again");
}

Triangles read(const std::string& path, double unit_scale) {
  Triangles all;
  all.source = "mesh file \"" + path + "\"";
  if (std::filesystem::file_size(path) == 0)
    throw Error(Code::mesh_error, all.source + ": the file is empty; a tool needs a surface of triangles");
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension == ".stl") check_stl(path, all.source);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (!scene || !scene->mRootNode)
    throw Error(Code::mesh_error, all.source + ": assimp cannot read it: " + importer.GetErrorString() + "; write it again");
  // With the up direction left alone, the root of a COLLADA scene holds its unit
  // and nothing else; the user's unit_scale takes its place.
  const bool collada = extension == ".dae";
  Transform root = Transform::Zero();
  root.leftCols<3>().setIdentity();
  if (!collada) root = times(root, scene->mRootNode->mTransformation);
  append(*scene, *scene->mRootNode, unit_scale * root, all);
  return all;
}

}  // namespace

Triangles read_triangles(const std::string& path, double unit_scale) {
  return read_apart<Triangles>("mesh file \"" + path + "\"", path, [&] { return read(path, unit_scale); }, [](auto& archive, auto& triangles) {
    archive.text(triangles.source);
    archive.list(triangles.points);
    archive.list(triangles.corners);
  });
}

}  // namespace forming_sim
