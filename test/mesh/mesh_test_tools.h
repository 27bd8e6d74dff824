#pragma once
// What the tests of meshes share: files in a folder of their own, and what must
// hold for every surface.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/import.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {

/// A folder that goes with the test.
class TempDir {
 public:
  TempDir() {
    std::string pattern = (std::filesystem::temp_directory_path() / "mesh_test_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TempDir() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string str() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// A body of which nothing is to be said.
inline Mesh body_mesh(const MeshConfig& config, const std::string& directory) {
  std::vector<std::string> notes;
  Mesh mesh = load_body_mesh(config, directory, notes);
  EXPECT_TRUE(notes.empty()) << notes.front();
  return mesh;
}

/// Lines and arcs: the end point and the radius of each.
inline ProfileConfig way(const Vec3& start, const std::vector<std::pair<Vec3, double>>& pieces) {
  ProfileConfig p;
  p.start = start;
  for (const auto& [to, radius] : pieces) {
    p.pieces.emplace_back();
    p.pieces.back().to = to;
    p.pieces.back().radius = radius;
  }
  return p;
}

/// The sentence of the Error that the call must throw.
inline std::string error_of(const std::function<void()>& call, Code code = Code::mesh_error) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error was thrown";
  return "";
}

/// Whatever was removed of it.
inline Mesh tool_surface(const MeshConfig& config, const std::string& base_directory) {
  std::vector<std::string> notes;
  return load_tool_surface(config, base_directory, notes);
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline Vec3 sum_of_areas(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Facet& f : mesh.surface) sum += area_vector(mesh, f);
  return sum;
}

/// Area (3D) or length (2D) of the surface.
inline double area(const Mesh& mesh) {
  double sum = 0;
  for (const Facet& f : mesh.surface) sum += area_vector(mesh, f).norm();
  return sum;
}

/// Volume (area) enclosed by the surface, by the divergence theorem.
inline double enclosed(const Mesh& mesh) {
  double sum = 0;
  for (const Facet& f : mesh.surface) sum += area_vector(mesh, f).dot(mesh.nodes[f.nodes[0]]) / mesh.dimension;
  return sum;
}

/// Vertices - edges + faces of the surface (3D).
inline int euler_characteristic(const Mesh& mesh) {
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  for (const Facet& f : mesh.surface)
    for (int k = 0; k < 3; ++k) {
      vertices.insert(f.nodes[k]);
      edges.insert(std::minmax({f.nodes[k], f.nodes[(k + 1) % 3]}));
    }
  return int(vertices.size()) - int(edges.size()) + int(mesh.surface.size());
}

}  // namespace forming_sim
