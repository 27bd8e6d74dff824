#pragma once
// formed.h5: the parts of a run as it left them, for a next one (bodies[].formed).
#include <string>
#include <vector>

#include "forming_sim/element/formed.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

struct FormedPart {
  std::string name;
  std::string material;              ///< as write_material() gives it
  std::string pressure_average;
  bool axisymmetric = false;
  std::vector<std::string> pressed_by, held_sets;  ///< tools ("tool punch"), pressures and loads (name_of) that pressed on it, and its sets that boundaries held or drove, until the end
  Mesh mesh;                         ///< where it stands
  FormedMemory memory;
};

/// To a temporary name, then renamed: the file is the old or the new one, whole. Throws Error(output_error).
void save_formed(const std::string& path, const std::vector<FormedPart>& parts);

/// The names of the parts in the file, then one of them. Both throw Error(mesh_error): not such a file, damaged (checksums), written by a version that keeps other things.
std::vector<std::string> formed_names(const std::string& path);
FormedPart load_formed(const std::string& path, std::size_t which);

}  // namespace forming_sim
