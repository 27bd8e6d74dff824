#pragma once
// Meshes that the user brings: a body from a .msh file or inline, the surface
// of a tool from STL, OBJ, PLY, DAE or inline.
#include <string>
#include <vector>

#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// A body: triangles and tetrahedra as they are, quadrilaterals as crossed
/// triangles, hexahedra as hex24, or both whole as cells of one point, as `config` says. `dimension` is the highest dimension of the
/// cells in the file (or in `group`); in 2D all nodes lie in z = 0 and cells are
/// turned counter-clockwise. Every physical group becomes a set of its nodes,
/// including those that splitting adds on it; a group without a name is called
/// group_<tag>; where groups of several dimensions have one name, each is called NAME_point, NAME_curve, NAME_surface, NAME_volume. Of cells of
/// higher order the corners are taken, which `notes` says. Surface found, volumes checked.
/// Throws Error(mesh_error) for a file that is missing, not readable or without cells, in 2D for nodes off z = 0, for inverted cells, named by their nodes, and for cells
/// that touch without being joined (see seams.h), as tetrahedra on the face of a hexahedron do; SceneError, field group, for one that is no body.
Mesh load_body_mesh(const MeshConfig& config, const std::string& base_directory, std::vector<std::string>& notes);

/// A tool: triangles in `surface`, coinciding nodes merged, triangles without
/// area and repeated ones removed; what was removed is said in `notes`.
/// `unit_scale` is the only scale applied, whatever the file says of units and axes.
/// Throws Error(mesh_error) for a file that is missing, not readable, or has no
/// triangle with an area, and for coordinates that are not finite.
Mesh load_tool_surface(const MeshConfig& config, const std::string& base_directory, std::vector<std::string>& notes);

}  // namespace forming_sim
