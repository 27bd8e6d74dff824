#include "forming_sim/mesh/generate.h"

#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/split.h"
#include "face_quarters.h"
#include "generate_bar.h"
#include "generate_tube.h"

namespace forming_sim {
namespace {

[[noreturn]] void refuse(const std::string& field, const std::string& given, const std::string& remedy) {
  throw Error(Code::invalid_scene, "blank." + field + ": given " + given + "; " + remedy);
}

double length_of(const char* field, double value) {
  if (!(value > 0) || !std::isfinite(value)) refuse(field, std::to_string(value), "a length above 0 m is needed");
  return value;
}

int count_of(const char* field, int value, int least = 1) {
  if (value < least) refuse(field, std::to_string(value), "at least " + std::to_string(least) + " is needed");
  return value;
}

void check_portion(const std::string& portion) {
  if (portion != "full" && portion != "half" && portion != "quarter") refuse("portion", "\"" + portion + "\"", "full, half or quarter is needed");
}

// Corners of a grid of nx * ny * nz cells (nz = 0: flat), x fastest.
struct Grid {
  int nx, ny, nz;
  int node(int i, int j, int k = 0) const { return i + (nx + 1) * (j + (ny + 1) * k); }

  void place_nodes(Mesh& mesh, const Vec3& origin, const Vec3& extent) const {
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
          mesh.nodes.push_back(origin + Vec3(extent.x() * i / nx, extent.y() * j / ny,
                                             nz ? extent.z() * k / nz : 0));
  }

  // Nodes whose index along the axis has the value.
  std::vector<int> layer(int axis, int value) const {
    std::vector<int> nodes;
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
          if ((axis == 0 ? i : axis == 1 ? j : k) == value) nodes.push_back(node(i, j, k));
    return nodes;
  }
};

Mesh generate_strip(const BlankConfig& blank, CellKind kind) {
  const double length = length_of("length", blank.length), thickness = length_of("thickness", blank.thickness);
  const Grid grid{count_of("cells_along", blank.cells_along), count_of("cells_through", blank.cells_through), 0};
  if (blank.origin.z() != 0) refuse("origin", std::to_string(blank.origin.z()) + " in z", "a strip lies in z = 0");
  Mesh mesh;
  mesh.dimension = 2;
  grid.place_nodes(mesh, blank.origin, Vec3(length, thickness, 0));
  std::vector<Quad> quads;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      quads.push_back({grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1), grid.node(i, j + 1)});
  mesh.sets = {{"left", grid.layer(0, 0)},
               {"right", grid.layer(0, grid.nx)},
               {"bottom", grid.layer(1, 0)},
               {"top", grid.layer(1, grid.ny)}};
  split_quads(mesh, quads, kind);
  return mesh;
}

Mesh generate_plate(const BlankConfig& blank, CellKind kind) {
  const Vec3 extent(length_of("length", blank.length), length_of("width", blank.width),
                    length_of("thickness", blank.thickness));
  const Grid grid{count_of("cells_along", blank.cells_along), count_of("cells_across", blank.cells_across),
                  count_of("cells_through", blank.cells_through)};
  Mesh mesh;
  grid.place_nodes(mesh, blank.origin, extent);
  std::vector<Hex> hexes;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        Hex hex;
        const int turn = kind == CellKind::hex1 ? quarter_of(2 * i >= grid.nx, 2 * j >= grid.ny) : 0;
        for (int up = 0; up < 2; ++up) {
          const int corners[4] = {grid.node(i, j, k + up), grid.node(i + 1, j, k + up), grid.node(i + 1, j + 1, k + up), grid.node(i, j + 1, k + up)};
          for (int a = 0; a < 4; ++a) hex[4 * up + a] = corners[(a + turn) % 4];
        }
        hexes.push_back(hex);
      }
  mesh.sets = {{"left", grid.layer(0, 0)},         {"right", grid.layer(0, grid.nx)},
               {"front", grid.layer(1, 0)},        {"back", grid.layer(1, grid.ny)},
               {"bottom", grid.layer(2, 0)},       {"top", grid.layer(2, grid.nz)}};
  const Centres centres = split_hexes(mesh, hexes, kind);
  for (auto& [name, set] : mesh.sets) centres.extend_by_faces(set, hexes);
  return mesh;
}

}  // namespace

Mesh generate_blank(const BlankConfig& blank) {
  const bool fine = blank.pattern == "fine", one_point = blank.pattern == "one_point";
  if (!fine && !one_point && blank.pattern != "coarse") refuse("pattern", "\"" + blank.pattern + "\"", "fine, coarse or one_point is needed");
  if (!blank.origin.allFinite()) refuse("origin", "a number that is not finite", "finite coordinates are needed");
  const CellKind flat = fine ? CellKind::crossed : one_point ? CellKind::quad1 : CellKind::quad2;
  const CellKind solid = fine ? CellKind::hex24 : one_point ? CellKind::hex1 : CellKind::hex6;
  Mesh mesh;
  if (blank.shape == "strip") {
    mesh = generate_strip(blank, flat);
  } else if (blank.shape == "plate") {
    mesh = generate_plate(blank, solid);
  } else if (blank.shape == "bar") {
    length_of("length", blank.length);
    length_of("radius", blank.radius);
    count_of("cells_along", blank.cells_along);
    count_of("cells_radius", blank.cells_radius, 2);
    check_portion(blank.portion);
    mesh = generate_bar(blank, solid);
  } else if (blank.shape == "tube") {
    length_of("length", blank.length);
    if (!(length_of("thickness", blank.thickness) < length_of("radius", blank.radius)))
      refuse("thickness", std::to_string(blank.thickness), "a wall thinner than the radius, " + std::to_string(blank.radius) + " m, is needed");
    count_of("cells_along", blank.cells_along);
    count_of("cells_through", blank.cells_through);
    count_of("cells_around", blank.cells_around, 3);
    check_portion(blank.portion);
    const int parts = 4 / quarters_of(blank.portion);
    if (blank.cells_around % parts != 0)
      refuse("cells_around", std::to_string(blank.cells_around), "so many go around the whole circle: a multiple of " + std::to_string(parts) + " is needed for portion " + blank.portion);
    mesh = generate_tube(blank, solid);
  } else {
    refuse("shape", "\"" + blank.shape + "\"", "strip, plate, bar or tube is needed");
  }
  find_surface(mesh);
  check_volumes(mesh);
  return mesh;
}

}  // namespace forming_sim
