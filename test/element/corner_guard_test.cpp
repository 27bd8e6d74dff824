// A corner of a one-point cell does not turn inside out unopposed (element/corner_guard.h).
#include "forming_sim/element/corner_guard.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "forming_sim/config/fault.h"
#include "forming_sim/element/hourglass_strain.h"
#include "support/dense_limit.h"
#include "support/kernels.h"
#include "support/moved.h"

namespace forming_sim {
namespace {

/// A skewed and tapered cell.
Vec3 distorted(const Vec3& X) { return Vec3(X.x() * (1 + 0.2 * X.y()) + 0.2 * X.y(), 0.7 * X.y() - 0.1 * X.x(), X.z() * (0.5 - 0.1 * X.x())); }

/// The guard of one cell alone.
template <int D, bool Ring = false> struct Alone {
  static constexpr int N = OnePoint<D, Ring>::nodes;
  OnePointStart start;
  Vector<double, D> X[N], x[N];

  /// place: where the corners of the unit cell lie.
  explicit Alone(const std::function<Vec3(const Vec3&)>& place) {
    Vec3 corners[N];
    for (int a = 0; a < N; ++a) {
      Vec3 unit = Vec3::Zero();
      for (int i = 0; i < D; ++i) unit[i] = kCornerSides[a][i] > 0;
      corners[a] = place(unit);
      for (int i = 0; i < D; ++i) x[a][i] = X[a][i] = corners[a][i];
    }
    CurveTables curves;
    start = start_one_point(corners, D, Ring, solid_constants(aluminium(), curves));
  }
  CornerGuard<double, D, Ring> guard() {
    const double* constants = start.constants.data();
    edges = {};
    find_one_point_edges<D, false>(constants, x, edges.x);
    find_reciprocal(edges);
    return {constants, x, edges.x, edges.up};
  }
  /// The square of the strains that vary.
  double strain() {
    guard();
    CornerSums<double, D> sums;
    sums.add_all(x);
    HourglassStrain<double, D> e;
    e.from(sums.mode, Fibres<double, D>(start.constants.data(), edges.up), start.constants.data());
    const double* first = start.constants.data() + OnePoint<D>::strain;
    for (int d = 0; d < D; ++d) {
      e.plane[d].a -= first[D == 2 ? d : 3 * d];
      if (D == 2) continue;
      e.plane[d].b -= first[3 * d + 1];
      e.plane[d].shear -= first[3 * d + 2];
      e.warp[d] -= first[9 + d];
    }
    return e.square();
  }
  /// size: along each coordinate.
  void shake(const Vec3& size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-1, 1);
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < D; ++i) x[a][i] = X[a][i] + size[i] * along(random);
  }
  Edges<double, D> edges;
};

/// Gradient and Hessian, in the metric of the masses, against central differences; size: of the cell.
template <int D, bool Ring> void expect_gradient_and_bound(Alone<D, Ring> cell, const Vec3& size) {
  constexpr int N = Alone<D, Ring>::N, all = N * D;
  cell.guard();
  const double whole = cell.edges.volume;
  double most = 0, least = 1;
  int guarded = 0;
  for (unsigned seed = 0; seed < 3000 && guarded < 60; ++seed) {
    cell.shake(0.45 * size, seed);
    const auto guard = cell.guard();
    if (!(guard.least() > 0.05 * kFreeCorner && guard.least() < 0.8 * kFreeCorner) || cell.edges.volume < 0.3 * whole) continue;
    ++guarded;
    least = std::min(least, guard.least());
    Vector<double, D> g[N];
    guard.gradient(g);
    double strongest = 0;
    for (const auto& of_node : g) strongest = std::max(strongest, std::sqrt(dot(of_node, of_node)));
    Eigen::Matrix<double, all, all> H;
    for (int c = 0; c < all; ++c) {
      const double h = 1e-6 * size[c % D] * guard.least();
      Vector<double, D> side[2][N];
      double energy[2];
      for (int k = 0; k < 2; ++k) {
        auto moved = cell;
        moved.x[c / D][c % D] += k ? h : -h;
        const auto there = moved.guard();
        energy[k] = there.energy();
        there.gradient(side[k]);
      }
      EXPECT_NEAR((energy[1] - energy[0]) / (2 * h), g[c / D][c % D], 1e-6 * strongest) << seed;
      for (int r = 0; r < all; ++r)
        H(r, c) = (side[1][r / D][r % D] - side[0][r / D][r % D]) / (2 * h) / std::sqrt(cell.start.share[r / D] * cell.start.share[c / D]);
    }
    const double largest = Eigen::SelfAdjointEigenSolver<decltype(H)>(0.5 * (H + H.transpose()), Eigen::EigenvaluesOnly).eigenvalues()[all - 1];
    EXPECT_LE(largest, guard.stiffness(guard.q)) << seed;
    most = std::max(most, largest / guard.stiffness(guard.q));
  }
  EXPECT_EQ(guarded, 60);
  EXPECT_LT(least, 0.2 * kFreeCorner);
  EXPECT_GT(most, 0.3);
  std::cout << "  least corner " << least << ", largest eigenvalue up to " << most << " of the bound\n";
}

TEST(CornerGuard, ForcesAreTheGradientAndTheirSlopeIsBounded) {
  for (double thin : {1., 0.2}) {
    const auto place = [&](int D) {
      return [=](const Vec3& X) {
        Vec3 x = distorted(X);
        x[D - 1] *= thin;
        return x;
      };
    };
    expect_gradient_and_bound(Alone<2>(place(2)), Vec3(1, 0.7 * thin, 0));
    expect_gradient_and_bound(Alone<3>(place(3)), Vec3(1, 0.7, 0.5 * thin));
    expect_gradient_and_bound(Alone<2, true>([&](const Vec3& X) { return Vec3(place(2)(X) + Vec3::UnitX()); }), Vec3(1, 0.7 * thin, 0));
  }
}

// Stretched, sheared and compressed as a whole: nothing, however far.
TEST(CornerGuard, EvenStrainIsFree) {
  const auto even = [](auto cell) {
    constexpr int D = sizeof(cell.x[0]) / sizeof(double);
    for (auto& x : cell.x) {
      const double y = x[1];
      x[0] = 3 * x[0] + 2 * y;
      x[1] = 0.1 * y;
    }
    const auto guard = cell.guard();
    for (double q : guard.q) EXPECT_NEAR(q, 1, 1e-12);
    EXPECT_EQ(guard.energy(), 0);
    static_assert(D == 2 || D == 3);
  };
  even(Alone<2>(distorted));
  even(Alone<3>(distorted));
}

/// The least corner of random shapes whose strains are `factor` times those that are near.
template <int D> double least_corner(const std::function<Vec3(const Vec3&)>& place, const Vec3& size, double factor) {
  Alone<D> cell(place);
  const double limit = factor * std::sqrt(cell.start.constants[OnePoint<D>::near]);
  double least = 1;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    cell.shake(0.3 * size, seed);
    Vector<double, D> way[Alone<D>::N];
    for (int a = 0; a < cell.N; ++a) way[a] = cell.x[a] - cell.X[a];
    double low = 0, high = 1;  // of the displacements
    for (int n = 0; n < 30; ++n) {
      const double middle = 0.5 * (low + high);
      for (int a = 0; a < cell.N; ++a) cell.x[a] = cell.X[a] + middle * way[a];
      (std::sqrt(cell.strain()) < limit ? low : high) = middle;
    }
    for (int a = 0; a < cell.N; ++a) cell.x[a] = cell.X[a] + low * way[a];
    if (cell.strain() <= limit * limit) least = std::min(least, cell.guard().least());
  }
  return least;
}
// Cells whose strains are near are not asked for their corners: none may be in the range. Where all corners move along one vector
// the limit is sharp; in space it lies low, the lower the thinner the cell.
TEST(CornerGuard, NoCornerInItsRangeIsMissed) {
  for (double thin : {1., 0.2}) {
    const auto straight = [&](const Vec3& X) { return Vec3(X.x(), 0.8 * X.y(), thin * X.z()); };
    const auto low = [&](const Vec3& X) { return Vec3(X.x(), thin * X.y(), 0); };
    const auto skewed = [&](const Vec3& X) { return Vec3(distorted(X).x(), distorted(X).y(), thin * distorted(X).z()); };
    EXPECT_GE(least_corner<2>(low, Vec3(1, thin, 0), 1), kFreeCorner);
    EXPECT_LT(least_corner<2>(low, Vec3(1, thin, 0), 1.1), kFreeCorner);
    EXPECT_GE(least_corner<2>(skewed, Vec3(1, 0.7, 0), 1), kFreeCorner);
    EXPECT_LT(least_corner<2>(skewed, Vec3(1, 0.7, 0), 1.1), kFreeCorner);
    EXPECT_GE(least_corner<3>(straight, Vec3(1, 0.8, thin), 1), kFreeCorner);
    EXPECT_LT(least_corner<3>(straight, Vec3(1, 0.8, thin), 12), kFreeCorner);
    EXPECT_GE(least_corner<3>(skewed, Vec3(1, 0.7, 0.5 * thin), 1), kFreeCorner);
    EXPECT_LT(least_corner<3>(skewed, Vec3(1, 0.7, 0.5 * thin), 12), kFreeCorner);
  }
}

/// Corner 0 of one cell pressed in, along all coordinates, by its last mode alone: the mean deformation is none. q of that corner of a
/// unit cell is 1 - u.
void press(Moved& body, double u) {
  const int D = body.body.mesh.dimension, mode = D == 2 ? 0 : 3;
  const std::vector<int>& nodes = body.body.mesh.cells[0].nodes;
  const double sign = D == 2 ? kHourglass<2>[mode][0] : kHourglass<3>[mode][0];
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (int i = 0; i < D; ++i) body.x[nodes[a]][i] = body.X[nodes[a]][i] + sign * (D == 2 ? kHourglass<2>[mode][a] : kHourglass<3>[mode][a]) * u / (2 * D);
}
Vec3 a_little(const Vec3& X) { return Vec3(X.x() * (1 + 0.1 * X.y()), X.y() - 0.05 * X.x(), X.z() * (1 + 0.1 * X.y())); }

// The whole cell: what it stores grows by the work of its forces, and these have no sum and no moment. The rubber is so soft that the
// guard makes most of them.
TEST(CornerGuard, ACellWithAPressedCornerStoresTheWorkOfItsForces) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1}) {
    const int D = shape_of(kind).dimension;
    Moved body(cell_of(kind, Vec3(1, 1, 1), a_little), rubber(1e10));
    press(body, 0.5);
    const double free = largest(body.forces());
    press(body, 0.85);
    const NodeField f = body.forces();
    EXPECT_GT(largest(f), 3 * free);
    const double h = 1e-6;
    const NodeField at = body.x;
    for (std::size_t n = 0; n < at.size(); ++n)
      for (int i = 0; i < D; ++i) {
        double energy[2];
        for (int s = 0; s < 2; ++s) {
          body.x = at;
          body.x[n][i] += s ? h : -h;
          energy[s] = body.energy();
        }
        EXPECT_NEAR(-(energy[1] - energy[0]) / (2 * h), body.f[n][i], 1e-5 * largest(f)) << shape_of(kind).name;
      }
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t n = 0; n < at.size(); ++n) sum += vec3(f[n]), moment += vec3(at[n]).cross(vec3(f[n]));
    EXPECT_LT(sum.norm(), 1e-12 * largest(f));
    EXPECT_LT(moment.norm(), 1e-12 * largest(f));
  }
}

TEST(CornerGuard, TheStepOfACellWithAPressedCornerIsABound) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1})
    for (double u : {0.5, 0.7, 0.85, 0.92}) {
      Moved body(cell_of(kind, Vec3(1, 1, 1), a_little), rubber(1e9));
      press(body, u);
      double dt = 0;
      int element = -1;
      body.elements.stable_step(body.x, body.v, dt, element);
      const double exact = dense_limit(body.elements, body.x, shape_of(kind).dimension);
      EXPECT_LE(dt, exact * (1 + 1e-5)) << u;
      EXPECT_GE(dt, 0.3 * exact) << u;
      std::cout << "  " << shape_of(kind).name << " " << u << ": bound / true limit " << dt / exact << "\n";
    }
}

// A perfectly plastic cell does not resist its own variation further once it yields; its guard does.
TEST(CornerGuard, APressedCornerOfAYieldingCellIsHeld) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1}) {
    Moved body(cell_of(kind, Vec3(1, 1, 1)), perfectly_plastic());
    const auto resistance = [&](double u) {
      press(body, u);
      return body.forces()[body.body.mesh.cells[0].nodes[0]].norm();
    };
    for (int step = 1; step < 100; ++step) resistance(0.005 * step);
    const double yielding = resistance(0.5);
    for (int step = 101; step < 190; ++step) resistance(0.005 * step);
    const double held = resistance(0.95);
    EXPECT_GT(held, 10 * yielding) << shape_of(kind).name;
    EXPECT_GT(resistance(0.99), 10 * held) << shape_of(kind).name;
  }
}

// A cell of a body pressed, by the kernels of every vector width; of a ring too.
TEST(CornerGuard, WidthsAgree) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1})
    for (bool ring : {false, true}) {
      if (ring && kind == CellKind::hex1) continue;
      Mesh mesh = block_of(kind, 3);
      for (Vec3& X : mesh.nodes) X.x() += 0.5;
      const BodyModel body = body_of(mesh, rubber(1e9));
      const NodeField X = positions_of(mesh), v(X.size(), Node::Zero());
      NodeField x = X;
      const std::vector<int>& cell = mesh.cells[0].nodes;  // the first cell: its corner next to the middle of the body pressed in
      const int a = kind == CellKind::quad1 ? 2 : 6;
      x[cell[a]] += (a == 2 ? 0.45 : 0.29) * (X[cell[0]] - X[cell[a]]);
      ElementOptions options;
      options.axisymmetric = ring;
      expect_widths_agree([&](const char* name) {
        Elements elements({body}, mesh.dimension, X, options, 1, name);
        NodeField f(X.size(), Node::Zero());
        elements.forces(x, v, 0, 0, f);
        EXPECT_EQ(elements.corners_pressed(), !ring);
        EXPECT_EQ(elements.pressed_cells(x), std::vector<int>{0});
        EXPECT_TRUE(elements.pressed_cells(X).empty());
        return f;
      });
    }
}

TEST(CornerGuard, ACornerInsideOutIsNamed) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1}) {
    Moved body(cell_of(kind, Vec3(1, 1, 1)), perfectly_plastic());
    press(body, 1.01);
    try {
      body.forces();
      FAIL() << "no error";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Code::mesh_error);
      EXPECT_NE(std::string(e.what()).find("one-point cell 0 of body block"), std::string::npos) << e.what();
      const std::vector<int>& nodes = body.body.mesh.cells[0].nodes;
      const int opposite = kind == CellKind::quad1 ? 2 : 6;  // pressed alike
      const auto named = [&](int a) { return std::string(e.what()).find("corner at node " + std::to_string(nodes[a]) + " ") != std::string::npos; };
      EXPECT_TRUE(named(0) || named(opposite)) << e.what();
    }
  }
}

}  // namespace
}  // namespace forming_sim
