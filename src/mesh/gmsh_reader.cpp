#include "mesh/gmsh_reader.h"

#include <dlfcn.h>

#include <filesystem>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

using Reader = decltype(&forming_sim_read_gmsh);

/// In the directory of the library that this function belongs to.
Reader load_reader(const std::string& file) {
  Dl_info here{};
  dladdr(reinterpret_cast<const void*>(&load_reader), &here);
  const std::string path = std::filesystem::path(here.dli_fname).replace_filename("libforming_sim_gmsh.so").string();
  void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* reader = library ? dlsym(library, "forming_sim_read_gmsh") : nullptr;
  if (!reader) throw Error(Code::mesh_error, "mesh file \"" + file + "\": what reads .msh files cannot be loaded: " + dlerror());
  return reinterpret_cast<Reader>(reader);
}

}  // namespace

RawMesh read_gmsh(const std::string& path, const std::string& group, double unit_scale) {
  static const Reader reader = load_reader(path);  // once that succeeded, no second time
  RawMesh body;
  reader(path, group, unit_scale, body);
  return body;
}

}  // namespace forming_sim
