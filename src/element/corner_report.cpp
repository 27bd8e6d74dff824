// One-point cells that a corner tells about: pressed, or turned inside out (element/corner_guard.h).
#include <sstream>

#include "element/group.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/element/corner_guard.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

template <int D, bool Ring> struct LeastCorner {
  int corner = 0;
  double q = 1;
  LeastCorner(const double* constants, const Vector<double, D>* x) {
    Edges<double, D> e;
    find_one_point_edges<D, false>(constants, x, e.x);
    find_reciprocal(e);
    const CornerGuard<double, D, Ring> guard(constants, x, e.x, e.up);
    for (int a = 0; a < OnePoint<D>::nodes; ++a)
      if (guard.q[a] < q) q = guard.q[a], corner = a;
  }
};

}  // namespace

bool Elements::corners_pressed() const {
  return std::any_of(groups_.begin(), groups_.end(), [](const Group& g) {
    return is_one_point(static_cast<CellKind>(g.kind)) && !g.ring && std::any_of(g.pressed, g.pressed + g.blocks, [](bool pressed) { return pressed; });
  });
}

std::vector<int> Elements::pressed_cells(const NodeField& x) const {
  std::vector<int> found;
  for (const Group& g : groups_) {
    if (!is_one_point(static_cast<CellKind>(g.kind))) continue;
    for (int cell = 0; cell < g.cells; ++cell) {
      if (!g.pressed[cell / kLanes]) continue;
      with_dimension(dimension_, g.ring, [&](auto d, auto ring) {
        const StandingCell<d> at(g, x, cell);
        if (LeastCorner<d, ring>(at.constants.data(), at.x).q < kPressedCorner) found.push_back(g.element(cell, 0));
      });
    }
  }
  return found;
}

void Elements::report_corner_inversion(const NodeField& x) const {
  for (const Group& g : groups_) {
    if (!is_one_point(static_cast<CellKind>(g.kind)) || g.ring) continue;
    for (int cell = 0; cell < g.cells; ++cell) {
      const auto report = [&](const auto& least) {
        if (least.q > 0) return;
        const int n = g.node(cell, least.corner);
        std::ostringstream what;
        what << "one-point cell " << g.order[cell] << " of body " << g.body << " (elements " << g.element(cell, 0) << " to "
             << g.element(cell, g.parts - 1) << ") turned inside out at its corner at node " << n << " at " << place(vec3(x[n])) << ": the corner has " << least.q << " of its first share in the " << (dimension_ == 2 ? "area" : "volume")
             << " of the cell; a finer mesh there, larger tool radii, slower tools or pattern fine avoid it";
        throw Error(Code::mesh_error, what.str());
      };
      with_dimension(dimension_, false, [&](auto d, auto) {
        const StandingCell<d> at(g, x, cell);
        report(LeastCorner<d, false>(at.constants.data(), at.x));
      });
    }
  }
}

}  // namespace forming_sim
