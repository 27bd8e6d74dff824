#pragma once
// A rigid tool with its surface.
#include <optional>
#include <string>

#include "forming_sim/loads/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// A rigid tool. A plane is a tool whose `mesh` is empty.
struct ToolModel {
  std::string name;
  Mesh mesh;                     ///< surface only, in the tool's frame (dimension 2: segments, 3: triangles)
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  ///< plane, in the tool's frame; normal of length 1
  bool is_plane() const { return mesh.surface.empty(); }
  Vec3 position = Vec3::Zero(), rotation_deg = Vec3::Zero();  ///< initial pose of the frame
  std::optional<MotionConfig> motion;
  double friction = 0;
  double friction_limit = 0;  ///< Pa; 0: none
  bool turns_freely() const { return motion && motion->turns_freely(); }
};

}  // namespace forming_sim
