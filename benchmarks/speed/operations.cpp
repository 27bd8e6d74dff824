#include "speed/operations.h"

#include <vector>

#include "forming_sim/element/edge_points.h"
#include "forming_sim/element/one_point_law.h"
#include "forming_sim/material/law.h"
#include "speed/counted.h"

namespace forming_sim::bench {
namespace {

/// A law with its memory, at one element of unit edges (one-point: the unit cube) that is stretched step by step.
template <int D, bool Ring, bool OnePointCell> class CountedElement {
  using Cell = OnePoint<D>;
  static constexpr int corners = OnePointCell ? Cell::nodes : D + 1;

 public:
  explicit CountedElement(const SpeedFamily& family) : family_(family), solid_(solid_constants(aluminium(true), curves_)) {
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < D; ++i) X_[a][i] = OnePointCell ? 0.5 + 0.5 * kCornerSides[a][i] : a == i + 1 ? 1 : 0;
    Mat3 edges = Mat3::Identity();
    if constexpr (OnePointCell) {
      Vec3 at[8];
      for (int a = 0; a < corners; ++a) at[a] = Vec3(X_[a][0], X_[a][1], D == 3 ? X_[a][2] : 0);
      const OnePointStart start = start_one_point(at, D, Ring, solid_);
      edges = start.edges;
      volume_ = start.volume;
      constants_ = start.constants;
      hourglass_.assign(hourglass_items<D>(solid_), 0.0);
    } else {
      if (Ring) edges(2, 2) = 1.0 / 3;
      volume_ = edges.determinant() * (D == 3 ? 1.0 / 6 : Ring ? kTwoPi / 2 : 0.5);
    }
    const Mat3 up = edges.inverse(), G = up * up.transpose();
    Symmetric<double, D> start;
    const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int i = 0; i < Symmetric<double, D>::size; ++i) start[i] = G(row[i], column[i]);
    memory_.resize(memory_items<D>(solid_));
    start_memory<D>(solid_, start, axes_at_start(solid_.orthotropy, D, edges).data(), [&](int item, double value) { memory_[item] = value; });
  }

  /// Operations of the step to the strain e.
  long step(double e) {
    const Vec3 lambda = stretches(family_, D, e);
    Vector<Counted, D> x[corners], f[corners];
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < D; ++i) x[a][i] = lambda[i] * X_[a][i], f[a][i] = 0;
    Counted::operations = 0;
    Edges<Counted, D, Ring> edges;
    CornerSums<Counted, D> sums;
    if constexpr (OnePointCell) {
      sums.add_all(x);
      sums.find_edges(constants_.data(), edges.x);
    } else {
      for (int m = 0; m < D; ++m) edges.x[m] = x[m + 1] - x[0];
      if constexpr (Ring) edges.x[2] = {{Counted(1.0 / 3) * (x[0][0] + x[1][0] + x[2][0]), Counted(0)}};
    }
    find_reciprocal(edges);
    const Counted J = edges.volume / Counted(volume_);
    Counted p = Counted(solid_.K) * (J - Counted(1));
    Vector<Counted, D> force[D], r[Cell::modes];
    PointResponse<Counted, D> point;
    if constexpr (OnePointCell) {
      const PlaneModuli moduli(solid_);
      forming_sim::OnePointCell<Counted, D, Ring> cell(moduli, constants_.data(), memory_.data(), hourglass_.data());
      cell.e = edges, cell.sums = sums, cell.J = J;
      if (try_one_layer(solid_, cell)) flow_alone(solid_, moduli, cell);
      finish_one_layer(cell);
      point = cell.point;
      cell.hourglass.gradient(Counted(volume_), r);
    } else {
      point = von_mises_step(solid_, edges, J, memory_.data(), Keep::yes);
    }
    for (int i = 0; i < 3; ++i) point.S[i] += p;
    for (int m = 0; m < D; ++m) force[m] = -edges.volume * (point.S * edges.up[m]);
    if constexpr (OnePointCell) {
      for (int k = 0; k < Cell::modes; ++k)
        for (int m = 0; m < D; ++m) force[m] += dot(edges.up[m], sums.mode[k]) * r[k];
      const CornerForces<Counted, D> at_corners(constants_.data(), force, r);
      repeat<corners / 2>([&](auto a) { at_corners.template at<a>(f[a], f[a + corners / 2]); });
    } else {
      for (int m = 0; m < D; ++m) f[m + 1] += force[m], f[0] += force[m];
      if constexpr (Ring) {
        const Counted hoop = edges.volume * edges.up[2][0] * point.S[2] * Counted(1.0 / 3);
        for (int a = 0; a < 3; ++a) f[a][0] -= hoop;
      }
    }
    return Counted::operations;
  }

 private:
  const SpeedFamily& family_;
  CurveTables curves_;
  SolidConstants solid_;
  Vector<double, D> X_[corners];
  double volume_ = 0;
  std::vector<double> memory_, constants_, hourglass_;
};

template <int D, bool Ring, bool OnePointCell> double count(const SpeedFamily& family, const SpeedMotion& motion) {
  CountedElement<D, Ring, OnePointCell> element(family);
  element.step(motion.start);
  return static_cast<double>(element.step(motion.start + motion.per_step));
}

/// Of a simplex whose law is at its edges: its share of them, each with the sums over its nodes by which it makes its edge
/// vectors and hands back forces. The nodes' pressures, some tens, are not counted.
double at_edges(const SpeedFamily& family, double of_point) {
  const Mesh mesh = block_of(family.kind, 6);
  const auto simplices = mesh.simplices();
  const int D = mesh.dimension;
  const EdgePoints points = find_edge_points(simplices, positions_of(mesh), D, family.ring);
  const double nodes = static_cast<double>(points.node.size()) / points.count();
  return points.count() / static_cast<double>(simplices.size()) * (of_point + 4 * D * D * nodes);
}

}  // namespace

double operations_of_step(const SpeedFamily& family, const SpeedMotion& motion) {
  const bool flat = shape_of(family.kind).dimension == 2;
  if (family.average == std::string("node")) return at_edges(family, flat ? count<2, false, false>(family, motion) : count<3, false, false>(family, motion));
  if (is_one_point(family.kind)) return flat ? count<2, false, true>(family, motion) : count<3, false, true>(family, motion);
  if (flat) return family.ring ? count<2, true, false>(family, motion) : count<2, false, false>(family, motion);
  return count<3, false, false>(family, motion);
}

}  // namespace forming_sim::bench
