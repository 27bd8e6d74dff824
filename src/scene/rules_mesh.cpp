// Meshes and blanks: what their fields say of each other.
#include <cctype>
#include <map>

#include "forming_sim/mesh/generate.h"
#include "rules.h"

namespace forming_sim {

namespace {

std::string ending_of(const std::string& url) {
  const std::size_t dot = url.find_last_of("./");
  std::string ending = dot == std::string::npos || url[dot] == '/' ? "" : url.substr(dot);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

const std::map<std::string, int>& corners_of_cells() {
  static const std::map<std::string, int> corners{{"triangle", 3}, {"quadrilateral", 4}, {"tetrahedron", 4}, {"hexahedron", 8}, {"wedge", 6}, {"pyramid", 5}};
  return corners;
}

void check_ending(const std::string& url, const std::string& path, const std::vector<std::string>& endings, const char* what, FaultList& faults) {
  if (std::find(endings.begin(), endings.end(), ending_of(url)) == endings.end()) faults.add(path + ".url", given_text(url), "give a file that ends in " + one_of(endings) + ": " + what);
}

void check_url(const MeshConfig& mesh, const std::string& path, bool of_a_tool, FaultList& faults) {
  if (of_a_tool) check_ending(mesh.url, path, {".stl", ".obj", ".ply", ".dae"}, "the surface of a tool", faults);
  else check_ending(mesh.url, path, {".msh"}, "the volume mesh of a body", faults);
  if (!mesh.cells.empty()) faults.add(path + ".cells", given_text(mesh.cells), "leave it out: cells belong to inline points, and a url is given");
  if (!mesh.cell_type.empty()) faults.add(path + ".cell_type", given_text(mesh.cell_type), "leave it out: it belongs to inline points, and a url is given");
}

void check_cells(const MeshConfig& mesh, const std::string& path, int dimension, bool of_a_tool, FaultList& faults) {
  if (!mesh.group.empty()) faults.add(path + ".group", given_text(mesh.group), "leave it out: groups belong to a .msh file, and points are given");
  if (mesh.cells.empty()) faults.add(path + ".cells", "nothing", "give the corner indices of the cells between the points");
  std::vector<std::string> types{"tetrahedron", "hexahedron", "wedge", "pyramid"};
  if (of_a_tool) types = {"triangle"};
  else if (dimension == 2) types = {"triangle", "quadrilateral"};
  if (std::find(types.begin(), types.end(), mesh.cell_type) == types.end()) {
    const std::string owner = of_a_tool ? "a tool" : "a body in dimension " + std::to_string(dimension);
    faults.add(path + ".cell_type", given_text(mesh.cell_type), "give " + one_of(types) + " for the inline mesh of " + owner);
    return;
  }
  const std::size_t corners = static_cast<std::size_t>(corners_of_cells().at(mesh.cell_type));
  if (mesh.cells.size() % corners != 0) {
    faults.add(path + ".cells", std::to_string(mesh.cells.size()) + " indices", "give " + std::to_string(corners) + " for each " + mesh.cell_type);
  }
  faults.each(mesh.cells, [&](std::size_t i) {
    if (mesh.cells[i] < static_cast<int>(mesh.points.size())) return;
    faults.add(join_path(path + ".cells", i), given_text(mesh.cells[i]), "give an index from 0 to " + std::to_string(mesh.points.size() - 1) + ": there are " + std::to_string(mesh.points.size()) + " points");
  });
}

}  // namespace

void check_mesh(const MeshConfig& mesh, const std::string& path, int dimension, bool of_a_tool, FaultList& faults) {
  if (of_a_tool && mesh.pattern != "fine") faults.add(path + ".pattern", given_text(mesh.pattern), "leave it out: only the cells of a body have a pattern");
  if (mesh.url.empty() == mesh.points.empty()) {
    faults.add(path, mesh.url.empty() ? "neither url nor points" : "both url and points", "give exactly one of them: the url of a file, or an inline mesh of points, cells and cell_type");
  } else if (!mesh.url.empty()) {
    check_url(mesh, path, of_a_tool, faults);
    if (of_a_tool && !mesh.group.empty()) faults.add(path + ".group", given_text(mesh.group), "leave it out: only the .msh file of a body has groups");
  } else {
    check_cells(mesh, path, dimension, of_a_tool, faults);
  }
}

void check_formed(const FormedConfig& formed, const std::string& path, FaultList& faults) {
  if (!formed.url.empty()) check_ending(formed.url, path, {".h5"}, "the formed.h5 of a run with output.formed", faults);
  if (formed.turn_deg.isZero(0) && !formed.turn_centre.isZero(0)) faults.add(path + ".turn_centre", given_text(formed.turn_centre), "leave it out: without turn_deg nothing turns about it");
}

double simplices_of(const BlankConfig& blank) {
  const bool fine = blank.pattern == "fine";
  const double along = blank.cells_along, radius = blank.cells_radius;
  if (blank.shape == "strip") return along * blank.cells_through * (fine ? 4 : 2);
  if (blank.shape == "plate") return along * blank.cells_across * blank.cells_through * (fine ? 24 : 6);
  if (blank.shape == "tube") return along * blank.cells_around * blank.cells_through * (fine ? 24 : 6);  // at most: of the whole circle
  return along * radius * radius * quarters_of(blank.portion) * (fine ? 24 : 6);  // at most: a quarter has radius^2 cells or fewer
}

}  // namespace forming_sim
