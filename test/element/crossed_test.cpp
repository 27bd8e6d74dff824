// What the law sees of a cell of crossed triangles (element/crossed.h), and their guard.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "forming_sim/element/crossed.h"
#include "forming_sim/mesh/cell_tables.h"
#include "support/column.h"
#include "support/dense_limit.h"
#include "support/rings.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

const Vec3 kSkewed[5] = {{0, 0, 0}, {1.3, 0.2, 0}, {1.1, 0.9, 0}, {-0.2, 0.7, 0}, {0.5, 0.5, 0}};

/// F of triangle s whose corners have gone from X to x, and its volume.
Eigen::Matrix2d gradient(const Vec3* X, const Vec3* x, int s, double& V) {
  Eigen::Matrix2d at_rest, now;
  for (int m = 0; m < 2; ++m) {
    at_rest.col(m) = (X[kCrossed[s][m + 1]] - X[4]).head<2>();
    now.col(m) = (x[kCrossed[s][m + 1]] - x[4]).head<2>();
  }
  V = at_rest.determinant() / 2;
  return now * at_rest.inverse();
}

// F + lambda (F_s - F - beta_s z g_s), of a cell whose sides are neither even nor parallel.
TEST(Crossed, TheLawSeesStrainsDrawnToTheMeanOfTheCell) {
  const double lambda = 0.9;
  for (bool by_shape : {false, true}) {
    const auto items = crossed_weights(kSkewed, false, lambda, by_shape, crossed_ratio(kSkewed));
    const auto item = [&](int i) { return items[i]; };
    Vec3 x[5], way[4], z = Vec3::Zero(), at_rest = Vec3::Zero();
    for (int a = 0; a < 5; ++a) x[a] = kSkewed[a] + 0.1 * Vec3(std::sin(3 * a + 1), std::cos(5 * a), 0);
    for (int b = 0; b < 4; ++b) {
      way[b] = x[b] - x[4];
      z -= items[kCrossedApex + b] / -lambda * way[b];
      at_rest += items[kCrossedApex + b] * (kSkewed[b] - kSkewed[4]);
    }
    EXPECT_LT(at_rest.norm(), 1e-14);
    Eigen::Matrix2d F[4], mean = Eigen::Matrix2d::Zero(), sum_drawn = Eigen::Matrix2d::Zero();
    double V[4], sum = 0;
    for (int s = 0; s < 4; ++s) {
      F[s] = gradient(kSkewed, x, s, V[s]);
      mean += V[s] * F[s];
      sum += V[s];
    }
    mean /= sum;
    double apart = 0, freed = 0;
    for (int s = 0; s < 4; ++s) {
      Vec3 y[5];
      Eigen::Matrix2d z_g = Eigen::Matrix2d::Zero();  // z g_s, from how F follows the middle node
      for (int i = 0; i < 2; ++i) {
        Vec3 moved[5];
        std::copy(kSkewed, kSkewed + 5, moved);
        moved[4][i] += 1;
        z_g += z[i] * (gradient(kSkewed, moved, s, V[s]) - Eigen::Matrix2d::Identity());
      }
      y[4] = x[4];
      for (int m = 0; m < 2; ++m) {
        const int c = kCrossed[s][m + 1];
        y[c] = x[4] + crossed_mix(item, c * 4, way) + items[kCrossedFreed + s] * crossed_mix(item, kCrossedApex, way);
      }
      const Eigen::Matrix2d found = gradient(kSkewed, y, s, V[s]);
      EXPECT_LT((found - mean - lambda * (F[s] - mean - items[kCrossedFreed + s] * z_g)).norm(), 1e-14);
      sum_drawn += V[s] / sum * found;
      apart = std::max(apart, (F[s] - mean).norm());
      freed = std::max(freed, std::abs(items[kCrossedFreed + s]));
    }
    EXPECT_LT((sum_drawn - mean).norm(), 1e-14);
    EXPECT_GT(apart, 0.1);
    EXPECT_EQ(freed > 0.1, by_shape) << freed;
  }
}

// Forces of uniform stress are in balance at every node inside a distorted mesh; where a node is off they are not.
TEST(Crossed, UniformStrainOfADistortedMeshIsInBalance) {
  Mesh mesh = block_of(CellKind::crossed, 4);
  const auto inside = [](const Node& X) { return X[0] > 1e-9 && X[0] < 1 - 1e-9 && X[1] > 1e-9 && X[1] < 0.8 - 1e-9; };
  NodeField X = positions_of(mesh);
  NodeField moved = X;
  shake(moved, 2, 0.04, 7);
  for (std::size_t n = 0; n < X.size(); ++n)
    if (inside(X[n])) X[n] = moved[n];
  Elements elements({body_of(mesh, aluminium())}, 2, X, {}, 1);
  NodeField x = X;
  for (Node& n : x) n = Node(1.02 * n[0] + 0.05 * n[1], 0.99 * n[1] - 0.01 * n[0], 0, 0);
  const NodeField at_rest(x.size(), Node::Zero());
  NodeField f(x.size());
  const auto largest_inside = [&] {
    elements.forces(x, at_rest, 0, 0, f);
    double largest = 0, on_edges = 0;
    for (std::size_t n = 0; n < x.size(); ++n) (inside(X[n]) ? largest : on_edges) = std::max(inside(X[n]) ? largest : on_edges, f[n].norm());
    return largest / on_edges;
  };
  EXPECT_LT(largest_inside(), 1e-12);
  for (std::size_t n = 0; n < x.size(); ++n)
    if (inside(X[n])) {
      x[n][0] += 1e-3;
      break;
    }
  EXPECT_GT(largest_inside(), 1e-3);
}

// The bound of the step holds for cells that are far from even, and for long ones: their law has other edges than their volume.
TEST(Crossed, TheStableStepIsABoundWhereCellsAreBent) {
  for (double stretch : {1.0, 4.0, 10.0}) {
    BodyModel b = body_of(block_of(CellKind::crossed), aluminium());
    for (Vec3& X : b.mesh.nodes) X[0] *= stretch;
    const NodeField X = positions_of(b.mesh);
    Elements elements({b}, 2, X, {}, 1);
    double timid = 1, even = 0;
    int element = -1;
    elements.stable_step(X, NodeField(X.size(), Node::Zero()), even, element);
    even /= dense_limit(elements, X, 2);
    EXPECT_LE(even, 1);
    for (unsigned seed = 1; seed <= 40; ++seed) {
      NodeField x = X;
      shake(x, 2, 0.09, seed);
      double dt = 0;
      elements.stable_step(x, NodeField(x.size(), Node::Zero()), dt, element);
      const double exact = dense_limit(elements, x, 2);
      EXPECT_LE(dt, exact) << "seed " << seed;
      timid = std::min(timid, dt / exact);
    }
    std::printf("  %g times as long: bound over true limit %.3f at rest, at least %.3f bent\n", 1.25 * stretch, even, timid);
  }
}

double elastic_moment(double nu, int cells, int steps = 4000, double aspect = 1) {
  MaterialConfig material = aluminium();
  material.poissons_ratio = nu;
  Column column(2, cells, aspect, material);
  const double kt = 1e-3, t = kSheetThickness;
  const double moment = column.turn(kt * column.length() / t, steps * cells);
  return moment / (material.youngs_modulus / (1 - nu * nu) * kt * t * t / 12);
}

// A column of square cells. Without drawn strains two cells would be stiffer by 4/7 3 (1-nu) - 1 over 4: 18, 5 and 3 %.
TEST(Crossed, ElasticBendingIsExact) {
  for (double nu : {0.0, 0.3, 0.34})
    for (int cells : {2, 3}) {
      const double found = elastic_moment(nu, cells);
      std::printf("  nu %.2f, %d cells: M %+.4f %%\n", nu, cells, 100 * (found - 1));
      EXPECT_NEAR(found, 1, 3e-4);
    }
}

// And of cells longer than high; drawn as square ones are, those would be too stiff by 130 and 650 % of their own bending.
// (The moment lags behind the turn by the square of the length over the number of steps.)
TEST(Crossed, ElasticBendingOfLongCellsIsExact) {
  for (double aspect : {1.4, 2.0, 4.0, 8.0}) {
    const double found = elastic_moment(0.3, 2, static_cast<int>(30000 * aspect * aspect), aspect);
    std::printf("  %g times as long as high: M %+.4f %%\n", aspect, 100 * (found - 1));
    EXPECT_NEAR(found, 1, 3e-4);
  }
}

// Next to nu = 1/2 no cell locks: its own bending has 6/7 of the exact stiffness, a share 1/n^2 of the whole. A share of
// the pressure that were each triangle's own would make it more than exact. (Steps are short there: the turn takes more of them.)
TEST(Crossed, NearlyIncompressibleCellsBend) {
  for (int cells : {2, 4}) EXPECT_NEAR(elastic_moment(0.4999, cells, 32000), 1 - 1.0 / (7 * cells * cells), 5e-4);
}

// A middle node goes towards an edge: free as long as no triangle has lost a fifth of its volume, at a long edge some more, then held, whatever the material.
TEST(Crossed, AGuardKeepsTrianglesFromCollapse) {
  MaterialConfig soft = aluminium(true);
  soft.hardening->curve = "perfect";
  soft.hardening->yield_stress = 1;  // Pa: all but the pressure is nothing
  const double half[2] = {0.5, 0.4};
  const NodeField X = positions_of(block_of(CellKind::crossed, 1));
  Elements elements({body_of(block_of(CellKind::crossed, 1), soft)}, 2, X, {}, 1);
  const NodeField at_rest(X.size(), Node::Zero());
  NodeField f(X.size());
  int middle = -1;
  for (std::size_t n = 0; n < X.size(); ++n)
    if (std::abs(X[n][0] - half[0]) < 1e-9 && std::abs(X[n][1] - half[1]) < 1e-9) middle = static_cast<int>(n);
  ASSERT_GE(middle, 0);
  const Vec3 corners[5] = {{0, 0, 0}, {1, 0, 0}, {1, 0.8, 0}, {0, 0.8, 0}, {0.5, 0.4, 0}};
  const auto items = crossed_weights(corners, false, 1, true, crossed_ratio(corners));
  EXPECT_DOUBLE_EQ(items[kCrossedGuard], 0.2 / 0.8);
  EXPECT_DOUBLE_EQ(items[kCrossedGuard + 1], 0.2);
  const double K = soft.youngs_modulus / (3 * (1 - 2 * soft.poissons_ratio));
  for (int i = 0; i < 2; ++i) {
    const auto force = [&](double part) {  // J of the triangles before and behind: 1 -+ part
      NodeField x = X;
      x[middle][i] -= part * half[i];
      elements.forces(x, at_rest, 0, 0, f);
      return f[middle][i];
    };
    const double free = i == 0 ? 0.2 : 0.25;
    EXPECT_LT(std::abs(force(free - 0.01)), 1e-9 * K);
    // p = theta K d^3 pushes on the edges of both: f = 2 p times half the length of the edge.
    const double d = 0.6 - free;
    EXPECT_NEAR(force(0.6), 2 * 0.2 * K * d * d * d * half[1 - i], 1e-6 * K);
  }
}

TEST(Crossed, WeightsFollowWhatHasBecomeShorterOrLonger) {
  for (double flip : {1., -1.}) {
    const auto renewed = [&](double of_weights, double now) { return std::pow(renewed_ratio(std::pow(6, flip), std::pow(of_weights, flip), std::pow(now, flip)), flip); };
    EXPECT_DOUBLE_EQ(renewed(6, 5), 6);
    EXPECT_DOUBLE_EQ(renewed(6, 6.4), 6);
    EXPECT_DOUBLE_EQ(renewed(6, 6.5), 2);  // stretched by 2.5/6^2
    EXPECT_DOUBLE_EQ(renewed(2, 8), 2);
    EXPECT_DOUBLE_EQ(renewed(2, 8.2), 1);  // by .7/2
    EXPECT_DOUBLE_EQ(renewed(6, 4), 4);
    EXPECT_DOUBLE_EQ(renewed(4, 3.1), 3.1);
    EXPECT_DOUBLE_EQ(renewed(4, 2.9), 1);  // half of the start
    EXPECT_DOUBLE_EQ(renewed(4, .5), 1);   // long the other way
    EXPECT_DOUBLE_EQ(renewed(1.1, .2), 1.1);
  }
}

// Long cells that have flowed into square ones, unevenly: with their new weights they store what they did and feel the same stresses, and a state that was
// saved goes on as it was.
TEST(Crossed, NewWeightsChangeNoEnergy) {
  MaterialConfig rolled = aluminium(true);
  rolled.anisotropy.emplace();
  rolled.anisotropy->r0 = .6, rolled.anisotropy->r45 = 1.2, rolled.anisotropy->r90 = 1.9;
  for (const auto& [ring, metal] : {std::pair(false, aluminium(true)), {true, aluminium(true)}, {false, rolled}, {true, rolled}}) {
    Mesh mesh = ring ? ring_block(CellKind::crossed, .3, 4) : block_of(CellKind::crossed, 4);
    for (Vec3& X : mesh.nodes) X.y() *= 4;
    const BodyModel body = body_of(std::move(mesh), metal);
    const NodeField X = positions_of(body.mesh), rest(X.size(), Node::Zero());
    ElementOptions options;
    options.axisymmetric = ring;
    Elements elements({body}, 2, X, options, 1), same({body}, 2, X, options, 1);
    NodeField x = X, f(x.size());
    for (int step = 0; step < 40; ++step) {
      for (Node& n : x) n[1] *= .97, n[0] *= ring ? 1.015 : 1 / .97;
      shake(x, 2, 1e-3, static_cast<unsigned>(step));
      elements.forces(x, rest, 0, 0, f);
    }
    const double energy = elements.stored_energy(x), work = elements.plastic_work();
    const ElementFields before = elements.observe(x);
    std::vector<double> state;
    elements.append_state(state);
    elements.renew_weights(x);
    const double after = elements.stored_energy(x);
    std::printf("  %s%s: energy %.6g J, changed by %.1e of it\n", metal.anisotropy ? "rolled, " : "", ring ? "rings" : "plane", energy, after / energy - 1);
    EXPECT_NEAR(after, energy, 1e-12 * energy);
    EXPECT_EQ(elements.plastic_work(), work);
    // J S of the deviator: V of the law changes a little, where a cell is uneven.
    const ElementFields fields = elements.observe(x);
    double largest = 0, apart = 0;
    for (std::size_t e = 0; e < fields.stress.size(); ++e)
      for (int c = 0; c < 6; ++c) {
        largest = std::max(largest, std::abs(before.stress[e][c]));
        apart = std::max(apart, std::abs(fields.stress[e][c] - before.stress[e][c]));
      }
    EXPECT_LT(apart, .02 * largest);
    std::vector<double> renewed, again;
    elements.append_state(renewed);
    EXPECT_NE(renewed, state);
    // Once is enough.
    elements.renew_weights(x);
    elements.append_state(again);
    EXPECT_EQ(again, renewed);
    same.read_state(renewed.data());
    NodeField g(x.size());
    shake(x, 2, 1e-4, 99);
    elements.forces(x, rest, 0, 0, f);
    same.forces(x, rest, 0, 0, g);
    for (std::size_t n = 0; n < x.size(); ++n) ASSERT_EQ(f[n], g[n]) << n;
    if (ring) continue;
    Node sum = Node::Zero();
    double size = 0;
    for (const Node& force : f) sum += force, size += force.norm();
    EXPECT_LT(sum.norm(), 1e-12 * size);
  }
}

}  // namespace
}  // namespace forming_sim
