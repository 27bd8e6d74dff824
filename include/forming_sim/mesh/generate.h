#pragma once
// Meshes of simple blanks.
#include <string>

#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// The mesh of a strip (crossed, quad2 or quad1), plate, bar or tube (hex24, hex6 or hex1), with
/// its surface and these sets:
///   strip  left (least x) right bottom (least y) top
///   plate  left (least x) right front (least y) back bottom (least z) top
///   bar    bottom (least z) top side; symmetry_x (the face x = 0 of a half or
///          quarter, relative to the origin), symmetry_y (y = 0 of a quarter)
///   tube   start (least z) end inside outside; symmetry_x, symmetry_y as a bar
/// Sets hold the face centres of hex24 too.
/// Throws Error(invalid_scene) for a length, count or name out of range, and Error(mesh_error) for cells that rounding makes flat.
Mesh generate_blank(const BlankConfig& blank);

/// Of the four of a circle, those that a bar or tube of this portion has: full, half or quarter.
inline int quarters_of(const std::string& portion) { return portion == "quarter" ? 1 : portion == "half" ? 2 : 4; }

}  // namespace forming_sim
