// What a MeshConfig gives: a file by its ending, or points and cells.
#include "forming_sim/mesh/import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/url.h"
#include "gmsh_reader.h"
#include "raw_mesh.h"
#include "tool_surface.h"

namespace forming_sim {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(Code::mesh_error, what); }

void check_config(const MeshConfig& config) {
  if (!(config.unit_scale > 0) || !std::isfinite(config.unit_scale))
    refuse("mesh.unit_scale: given " + std::to_string(config.unit_scale) +
           "; metres per unit of the file are needed, 0.001 for millimetres");
  const bool is_inline = !config.points.empty() || !config.cells.empty();
  if (!config.url.empty() && is_inline) refuse("mesh: given both url and points; give one of them");
  if (config.url.empty() && !is_inline) refuse("mesh: given neither url nor points; give one of them");
}

std::string ending_of(const std::string& url) {
  std::string ending = std::filesystem::path(url).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool is_surface_file(const std::string& ending) {
  return ending == ".stl" || ending == ".obj" || ending == ".ply" || ending == ".dae";
}

RawMesh read_inline(const MeshConfig& config, const std::string& cell_type) {
  RawMesh raw;
  raw.source = "inline mesh";
  RawKind kind;
  if (cell_type == "triangle") kind = RawKind::triangle;
  else if (cell_type == "quadrilateral") kind = RawKind::quadrilateral;
  else if (cell_type == "tetrahedron") kind = RawKind::tetrahedron;
  else if (cell_type == "hexahedron") kind = RawKind::hexahedron;
  else if (cell_type == "wedge") kind = RawKind::wedge;
  else if (cell_type == "pyramid") kind = RawKind::pyramid;
  else refuse("mesh.cell_type: given \"" + cell_type + "\"; triangle, quadrilateral, tetrahedron, hexahedron, wedge or pyramid is needed");
  const int corners = shape_of(kind).corners, count = static_cast<int>(config.points.size());
  if (config.cells.empty() || config.cells.size() % corners != 0)
    refuse("mesh.cells: given " + std::to_string(config.cells.size()) + " indices; " + std::to_string(corners) +
           " per " + cell_type + " are needed");
  for (int p = 0; p < count; ++p) {
    raw.points.push_back(config.unit_scale * config.points[p]);
    raw.point_tags.push_back(p);
  }
  for (std::size_t i = 0; i < config.cells.size(); i += corners) {
    RawCell cell{kind, static_cast<long long>(i / corners), {}};
    for (int k = 0; k < corners; ++k) {
      cell.nodes[k] = config.cells[i + k];
      if (cell.nodes[k] < 0 || cell.nodes[k] >= count)
        refuse("mesh.cells[" + std::to_string(i + k) + "]: given " + std::to_string(cell.nodes[k]) +
               "; the points are numbered from 0 to " + std::to_string(count - 1));
    }
    raw.cells.push_back(cell);
  }
  raw.dimension = shape_of(kind).dimension;
  return raw;
}

}  // namespace

Mesh load_body_mesh(const MeshConfig& config, const std::string& base_directory, std::vector<std::string>& notes) {
  check_config(config);
  if (config.pattern != "fine" && config.pattern != "one_point")
    refuse("mesh.pattern: given \"" + config.pattern + "\"; fine or one_point is needed");
  const auto finish = [&](RawMesh raw) {
    raw.one_point = config.pattern == "one_point";
    Mesh mesh = assemble(raw);
    if (!raw.note.empty()) notes.push_back(raw.note);
    return mesh;
  };
  if (config.url.empty()) return finish(read_inline(config, config.cell_type));
  const std::string ending = ending_of(config.url);
  if (is_surface_file(ending))
    refuse("mesh file \"" + config.url + "\": " + ending +
           " holds a surface, and a body needs cells; mesh its volume with gmsh and give the .msh");
  if (ending != ".msh") refuse("mesh file \"" + config.url + "\": the ending \"" + ending + "\" is not known; a body needs a .msh");
  return finish(read_gmsh(resolve_url(config.url, base_directory), config.group, config.unit_scale));
}

Mesh load_tool_surface(const MeshConfig& config, const std::string& base_directory, std::vector<std::string>& notes) {
  check_config(config);
  if (config.url.empty()) {
    if (!config.cell_type.empty() && config.cell_type != "triangle")
      refuse("mesh.cell_type: given \"" + config.cell_type + "\"; a tool's surface is made of triangles");
    const RawMesh raw = read_inline(config, "triangle");
    Triangles triangles{raw.source, raw.points, {}};
    for (const RawCell& cell : raw.cells) triangles.corners.push_back({cell.nodes[0], cell.nodes[1], cell.nodes[2]});
    return clean_surface(triangles, notes);
  }
  const std::string ending = ending_of(config.url);
  if (!is_surface_file(ending))
    refuse("mesh file \"" + config.url + "\": the ending \"" + ending + "\" is not known for a tool; .stl, .obj, .ply or .dae is needed");
  return clean_surface(read_triangles(resolve_url(config.url, base_directory), config.unit_scale), notes);
}

}  // namespace forming_sim
