#pragma once
// What reads .msh files lies in a library of its own, libforming_sim_gmsh.so beside this one: libgmsh brings a hundred others
// along, which take longer to start than many a scene takes to check. They are loaded with the first .msh.
#include "mesh/raw_mesh.h"

namespace forming_sim {

/// The body of a .msh file at a path, scaled. Throws Error(mesh_error), also where libgmsh cannot be loaded; SceneError, field group, where that is no body.
RawMesh read_gmsh(const std::string& path, const std::string& group, double unit_scale);

/// Of libforming_sim_gmsh.so.
extern "C" void forming_sim_read_gmsh(const std::string& path, const std::string& group, double unit_scale, RawMesh& body);

}  // namespace forming_sim
