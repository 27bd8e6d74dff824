#pragma once
// What does not change while a scene runs: the joined mesh of all bodies, their
// materials, the tools in their own frames. Built by scene/build.h.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/material/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// A body's share of the joined mesh.
struct BodyModel {
  std::string name;
  int first_node = 0, node_count = 0;
  int first_element = 0, element_count = 0;  ///< simplices
  MaterialConfig material;
  std::string pressure_average;  ///< cell | node | element
  Mesh mesh;                     ///< its own mesh, nodes numbered from 0; sets hold the named sets of the scene too
};

/// A rigid tool. A plane is a tool whose `mesh` is empty.
struct ToolModel {
  std::string name;
  Mesh mesh;                     ///< surface only, in the tool's frame (dimension 2: segments, 3: triangles)
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  ///< plane, normal of length 1
  bool is_plane() const { return mesh.surface.empty(); }
  Vec3 position = Vec3::Zero(), rotation_deg = Vec3::Zero();  ///< initial pose of the frame
  std::optional<MotionConfig> motion;
  double friction = 0;
};

struct Model {
  int dimension = 3;
  std::vector<BodyModel> bodies;
  std::vector<ToolModel> tools;

  int node_count() const { return bodies.empty() ? 0 : bodies.back().first_node + bodies.back().node_count; }
  int element_count() const { return bodies.empty() ? 0 : bodies.back().first_element + bodies.back().element_count; }
};

}  // namespace forming_sim
