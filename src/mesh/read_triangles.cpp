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
#include <string_view>
#include <vector>

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

/// Of an STL file of text: small letters, and neither the names of solids nor the normals of facets, which nothing here uses and in
/// which assimp takes a word for another or breaks over a normal that is no number.
std::vector<char> plain_text(std::string text, const std::string& source, std::size_t& triangles) {
  std::replace(text.begin(), text.end(), '\r', '\n');
  text = lower(std::move(text));
  std::string plain;
  plain.reserve(text.size());
  const auto next = [&](const char* characters, std::size_t from, std::size_t end) { return std::min(end, text.find_first_of(characters, from)); };
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = next("\n", begin, text.size());
    const std::size_t word = text.find_first_not_of(" \t\n", begin);
    if (word >= end) continue;
    const std::string_view line(&text[begin], end - begin), first(&text[word], next(" \t", word, end) - word);
    const bool alone = line.find("vertex") == line.npos;  // a name or a normal, and no more
    if (alone && (first == "solid" || first == "endsolid")) plain += first;
    else if (alone && first == "facet") plain += "facet normal 0 0 0";
    else plain += line;
    plain += '\n';
  }
  constexpr std::string_view kEnd = "endfacet";
  std::size_t last = 0;
  for (std::size_t at = 0; (at = plain.find(kEnd, at)) != std::string::npos; at += kEnd.size()) ++triangles, last = at;
  if (const std::size_t closed = plain.rfind("endsolid"); closed == std::string::npos || closed < last)
    throw Error(Code::mesh_error, source + ": it begins with solid, and does not end with endsolid; it is cut short: write it again");
  return {plain.begin(), plain.end()};
}

/// An STL file in the form that assimp reads. triangles: how many it has, which tells whether all of it was read.
std::vector<char> read_stl(const std::string& path, const std::string& source, std::size_t& triangles) {
  constexpr std::size_t kHead = 84, kTriangle = 50;  // bytes, of a binary one
  std::vector<char> bytes(std::filesystem::file_size(path));
  std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const std::size_t size = bytes.size();
  std::uint32_t announced = 0;
  if (size >= kHead) std::memcpy(&announced, &bytes[kHead - sizeof announced], sizeof announced);
  const std::size_t binary_size = kHead + kTriangle * announced;
  triangles = announced;
  if (size == binary_size) return bytes;
  std::string_view text(bytes.data(), size);
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool solid = begin != text.npos && lower(std::string(text.substr(begin, 5))) == "solid";  // many a binary one says so too
  if (announced > 0 && size > binary_size && (!solid || std::find(bytes.begin() + kHead, bytes.begin() + binary_size, '\0') != bytes.begin() + binary_size)) {
    bytes.resize(binary_size);  // what follows is no triangle
    return bytes;
  }
  triangles = 0;
  if (solid) return plain_text(std::string(text), source, triangles);
  throw Error(Code::mesh_error, source + ": it does not begin with solid, as an STL file of text does, and as a binary one it would have " + std::to_string(binary_size) + " bytes for the " +
                                    std::to_string(announced) + " triangles that it announces, not " + std::to_string(size) + "; it is damaged or cut short: write it again");
}

Triangles read(const std::string& path, double unit_scale) {
  Triangles all;
  all.source = "mesh file \"" + path + "\"";
  if (std::filesystem::file_size(path) == 0)
    throw Error(Code::mesh_error, all.source + ": the file is empty; a tool needs a surface of triangles");
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  const bool is_stl = extension == ".stl";
  std::size_t triangles = 0;
  const std::vector<char> stl = is_stl ? read_stl(path, all.source, triangles) : std::vector<char>();
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = is_stl ? importer.ReadFileFromMemory(stl.data(), stl.size(), aiProcess_Triangulate, "stl") : importer.ReadFile(path, aiProcess_Triangulate);
  if (!scene || !scene->mRootNode)
    throw Error(Code::mesh_error, all.source + ": assimp cannot read it: " + importer.GetErrorString() + "; write it again");
  // With the up direction left alone, the root of a COLLADA scene holds its unit
  // and nothing else; the user's unit_scale takes its place.
  const bool collada = extension == ".dae";
  Transform root = Transform::Zero();
  root.leftCols<3>().setIdentity();
  if (!collada) root = times(root, scene->mRootNode->mTransformation);
  append(*scene, *scene->mRootNode, unit_scale * root, all);
  if (is_stl && all.corners.size() != triangles)
    throw Error(Code::mesh_error, all.source + ": assimp reads " + std::to_string(all.corners.size()) + " of its " + std::to_string(triangles) + " triangles; it is damaged: write it again, as a binary STL if it is one of text");
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
