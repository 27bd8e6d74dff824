#include "support/free_mesh.h"

#include <gmsh.h>

#include <cmath>
#include <functional>
#include <unordered_map>

#include "forming_sim/mesh/import.h"

namespace forming_sim {
namespace {

/// The cells of the highest dimension of what `shape` puts into the model.
Mesh meshed(int dimension, double edge, const std::function<void()>& shape) {
  static const bool once = (gmsh::initialize(0, nullptr, false), true);  // that the library reads files with it too does no harm
  (void)once;
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMin", edge);
  gmsh::option::setNumber("Mesh.MeshSizeMax", edge);
  gmsh::model::add("free");
  shape();
  gmsh::model::occ::synchronize();
  gmsh::model::mesh::generate(dimension);
  std::vector<std::size_t> tags, elements, corners;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::unordered_map<std::size_t, std::size_t> number;
  for (std::size_t n = 0; n < tags.size(); ++n) number[tags[n]] = n;
  gmsh::model::mesh::getElementsByType(dimension == 2 ? 2 : 4, elements, corners);
  MeshConfig config;
  config.unit_scale = 1;
  config.cell_type = dimension == 2 ? "triangle" : "tetrahedron";
  std::unordered_map<std::size_t, int> used;
  for (std::size_t tag : corners) {
    const auto [place, fresh] = used.emplace(tag, static_cast<int>(config.points.size()));
    const double* x = &coordinates[3 * number[tag]];
    if (fresh) config.points.emplace_back(x[0], x[1], x[2]);
    config.cells.push_back(place->second);
  }
  gmsh::model::remove();
  std::vector<std::string> nothing_odd;
  return load_body_mesh(config, "", nothing_odd);
}

void name_side(Mesh& mesh, const std::string& name, int axis, double at) {
  std::vector<int>& set = mesh.sets[name];
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(mesh.nodes[n][axis] - at) < 1e-9 * (1 + std::abs(at))) {
      mesh.nodes[n][axis] = at;
      set.push_back(static_cast<int>(n));
    }
}

}  // namespace

Mesh free_rectangle(double length, double height, double edge) {
  Mesh mesh = meshed(2, edge, [&] { gmsh::model::occ::addRectangle(0, 0, 0, length, height); });
  name_side(mesh, "left", 0, 0);
  name_side(mesh, "right", 0, length);
  name_side(mesh, "bottom", 1, 0);
  name_side(mesh, "top", 1, height);
  return mesh;
}

Mesh free_box(const Vec3& size, double edge) {
  Mesh mesh = meshed(3, edge, [&] { gmsh::model::occ::addBox(0, 0, 0, size.x(), size.y(), size.z()); });
  const char* names[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
  for (int axis = 0; axis < 3; ++axis) {
    name_side(mesh, names[axis][0], axis, 0);
    name_side(mesh, names[axis][1], axis, size[axis]);
  }
  return mesh;
}

Mesh free_quarter_bar(double radius, double length, double edge) {
  Mesh mesh = meshed(3, edge, [&] { gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, length, radius, -1, M_PI / 2); });
  name_side(mesh, "symmetry_x", 0, 0);
  name_side(mesh, "symmetry_y", 1, 0);
  name_side(mesh, "bottom", 2, 0);
  name_side(mesh, "top", 2, length);
  return mesh;
}

Mesh free_bar(double radius, double length, double edge) {
  Mesh mesh = meshed(3, edge, [&] { gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, length, radius); });
  name_side(mesh, "bottom", 2, 0);
  name_side(mesh, "top", 2, length);
  return mesh;
}

MeshConfig inline_mesh(const Mesh& mesh) {
  MeshConfig config;
  config.unit_scale = 1;
  config.cell_type = mesh.dimension == 2 ? "triangle" : "tetrahedron";
  config.points = mesh.nodes;
  config.cells = mesh.cells.at(0).nodes;
  return config;
}

}  // namespace forming_sim
