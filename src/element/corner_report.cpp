// One-point cells that a corner tells about: pressed, or turned inside out (element/corner_guard.h).
#include <sstream>

#include "element/group.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/element/corner_guard.h"

namespace forming_sim {
namespace {

template <int D, bool Ring> struct LeastCorner {
  int corner = 0;
  double q = 1;
  LeastCorner(const Vec3* at, const double* constants) {
    constexpr int N = OnePoint<D, Ring>::nodes;
    Vector<double, D> x[N];
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < D; ++i) x[a][i] = at[a][i];
    Edges<double, D> e = {};
    for (int a = 0; a < N; ++a)
      for (int m = 0; m < D; ++m) e.x[m] += constants[a * D + m] * x[a];
    find_reciprocal(e);
    const CornerGuard<double, D, Ring> guard(constants, x, e.x, e.up);
    for (int a = 0; a < N; ++a)
      if (guard.q[a] < q) q = guard.q[a], corner = a;
  }
};

}  // namespace

bool Elements::corners_pressed() const {
  return std::any_of(groups_.begin(), groups_.end(), [](const Group& g) {
    return is_one_point(static_cast<CellKind>(g.kind)) && std::any_of(g.pressed, g.pressed + g.blocks, [](bool pressed) { return pressed; });
  });
}

void Elements::report_corner_inversion(const NodeField& x) const {
  for (const Group& g : groups_) {
    if (!is_one_point(static_cast<CellKind>(g.kind))) continue;
    std::vector<double> constants(one_point_items(dimension_, g.ring));
    for (int cell = 0; cell < g.cells; ++cell) {
      const int block = cell / kLanes, l = cell % kLanes;
      for (std::size_t i = 0; i < constants.size(); ++i) constants[i] = g.constant(block, static_cast<int>(i), l);
      const auto node = [&](int a) { return g.node_storage[(static_cast<std::size_t>(block) * g.cell_nodes + a) * kLanes + l]; };
      Vec3 at[8];
      for (int a = 0; a < g.cell_nodes; ++a) at[a] = vec3(x[node(a)]);
      const auto report = [&](const auto& least) {
        if (least.q > 0) return;
        std::ostringstream what;
        what << "one-point cell " << cell << " of body " << g.body << " (elements " << g.first_element + cell * g.parts << " to "
             << g.first_element + (cell + 1) * g.parts - 1 << ") turned inside out at its corner at node " << node(least.corner) << " at ("
             << at[least.corner].transpose() << ") m: the corner has " << least.q << " of its first share in the " << (dimension_ == 2 ? "area" : "volume")
             << " of the cell; a finer mesh there, larger tool radii, slower tools or pattern fine avoid it";
        throw Error(Code::mesh_error, what.str());
      };
      if (g.ring) report(LeastCorner<2, true>(at, constants.data()));
      else if (dimension_ == 2) report(LeastCorner<2, false>(at, constants.data()));
      else report(LeastCorner<3, false>(at, constants.data()));
    }
  }
}

}  // namespace forming_sim
