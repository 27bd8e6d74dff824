// A tube as a plate that is rolled up: its length runs around, its width along z, its thickness outwards. A half keeps x >= 0, a quarter x, y >= 0.
#include "generate_tube.h"

#include <cmath>

#include "face_quarters.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/split.h"

namespace forming_sim {
namespace {

/// Cosine and sine of i steps of a circle of `steps`, exact at its quarters.
Vec3 on_circle(int i, int steps) {
  const int in_circle = ((i % steps) + steps) % steps;
  if (4 * in_circle % steps == 0) {
    const Vec3 quarters[4] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    return quarters[4 * in_circle / steps];
  }
  const double angle = 2 * M_PI * in_circle / steps;
  return {std::cos(angle), std::sin(angle), 0};
}

struct TubeGrid {
  int around, along, through;  ///< cells
  bool closed;
  int columns() const { return closed ? around : around + 1; }
  int node(int i, int j, int k) const { return i % columns() + columns() * (j + (along + 1) * k); }
};

}  // namespace

Mesh generate_tube(const BlankConfig& blank, CellKind kind) {
  const int steps = blank.cells_around;
  const int quarters = quarters_of(blank.portion);
  const bool full = quarters == 4, half = quarters == 2;
  const TubeGrid grid{steps * quarters / 4, blank.cells_along, blank.cells_through, full};
  const int first = half ? -steps / 2 : 0;  // in half steps, from the axis x on
  Mesh mesh;
  mesh.sets = {{"start", {}}, {"end", {}}, {"inside", {}}, {"outside", {}}};
  if (!full) mesh.sets["symmetry_x"];
  if (!full && !half) mesh.sets["symmetry_y"];
  for (int k = 0; k <= grid.through; ++k)
    for (int j = 0; j <= grid.along; ++j)
      for (int i = 0; i < grid.columns(); ++i) {
        const Vec3 round = on_circle(first + 2 * i, 2 * steps);
        const double r = blank.radius - blank.thickness * (grid.through - k) / grid.through;
        const int node = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(blank.origin + r * round + Vec3(0, 0, blank.length * j / grid.along));
        if (j == 0) mesh.sets["start"].push_back(node);
        if (j == grid.along) mesh.sets["end"].push_back(node);
        if (k == 0) mesh.sets["inside"].push_back(node);
        if (k == grid.through) mesh.sets["outside"].push_back(node);
        if (!full && round.x() == 0) mesh.sets["symmetry_x"].push_back(node);
        if (!full && !half && round.y() == 0) mesh.sets["symmetry_y"].push_back(node);
      }
  std::vector<Hex> hexes;
  for (int k = 0; k < grid.through; ++k)
    for (int j = 0; j < grid.along; ++j)
      for (int i = 0; i < grid.around; ++i) {
        // Faces that stay whole mirror about the planes x = 0 and y = 0 and the middle of the length, as those of a plate do.
        const int quarter = (4 * (first + 2 * i + 1) + 8 * steps) / (2 * steps);
        const int turn = kind == CellKind::hex1 ? quarter_of(quarter % 2 == 1, 2 * j >= grid.along) : 0;
        Hex hex;
        for (int up = 0; up < 2; ++up) {
          const int corners[4] = {grid.node(i, j, k + up), grid.node(i + 1, j, k + up), grid.node(i + 1, j + 1, k + up), grid.node(i, j + 1, k + up)};
          for (int a = 0; a < 4; ++a) hex[4 * up + a] = corners[(a + turn) % 4];
        }
        hexes.push_back(hex);
      }
  const Centres centres = split_hexes(mesh, hexes, kind);
  for (auto& [name, set] : mesh.sets) centres.extend_by_faces(set, hexes);
  return mesh;
}

}  // namespace forming_sim
