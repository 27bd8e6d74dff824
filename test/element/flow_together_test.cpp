// Mean and variation of two one-point cells that flow side by side: each as if it were alone.
#include "forming_sim/element/flow_together.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "forming_sim/element/one_point.h"
#include "support/bodies.h"

namespace forming_sim {
namespace {

/// A hexahedron of a plastic body whose law has answered a mean stress at the yield stress, with strains that vary across it.
struct Cell {
  static constexpr int size = 6;
  CurveTables curves;
  SolidConstants solid;
  std::vector<double> constants;
  Edges<double, 3, false> e;
  HourglassStrain<double, 3> strain;
  PointResponse<double, 3> point;
  double J = 0.999, memory[size + 1] = {}, hourglass[kHourglassItems<3>] = {};
  double limit = 0, left = 0;

  /// bent: strain that varies, over that of first yield; law: of rate_dependence, in a step of 1 us.
  Cell(unsigned seed, double bent, const char* law = nullptr) {
    MaterialConfig material = aluminium(true);
    if (law) {
      material.rate_dependence.emplace();
      material.rate_dependence->law = law;
      material.rate_dependence->reference_rate = 40, material.rate_dependence->exponent = 5, material.rate_dependence->coefficient = 0.02;
    }
    solid = solid_constants(material, curves);
    set_step(solid, 1e-6);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> even(-1, 1);
    Vec3 corners[8];
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) corners[a][i] = kCornerSides[a][i] * (1 + 0.5 * i) + 0.1 * even(random);
    constants = start_one_point(corners, 3, false, solid).constants;
    for (int m = 0; m < 3; ++m)
      for (int i = 0; i < 3; ++i) e.x[m][i] = (m == i) + 0.2 * even(random);
    find_reciprocal(e);
    const double sigma = yield_stress(solid.layer[0].hardening, 0.0).value, first = sigma / solid.mu;
    Symmetric<double, 3> S;
    for (int i = 0; i < size; ++i) S[i] = even(random);
    S = deviator(S);
    const double q = mises(S);
    for (int i = 0; i < size; ++i) point.S[i] = 0.99 * sigma / q * S[i];
    point.dissipation = 1e3;
    point.kept = 0.9;
    point.yield = yield_stress(solid.layer[0].hardening, 0.0);
    point.dp = seed % 3 == 0 ? 0 : 1e-4;
    if (law && point.dp > 0) {
      const double R = rate_factor(solid.layer[0].hardening.rate, std::log(point.dp)).value;
      point.yield = {R * point.yield.value, R * point.yield.slope, 0};
      for (int i = 0; i < size; ++i) point.S[i] *= R;
    }
    for (int d = 0; d < 3; ++d) strain.plane[d] = {bent * first * even(random), bent * first * even(random), bent * first * even(random)};
    const Symmetric<double, 3> G = metric_of<3, false>(e.up, 1.0);
    for (int i = 0; i < size; ++i) memory[i] = G[i] * (1 + 0.001 * even(random));
  }

  template <class Flow> void put(Flow& flow, int half) const {
    flow.put_cell(half, e, strain, solid.mu, J);
    flow.put_layer(half, point, memory, hourglass);
  }
  template <class Flow> void take(Flow& flow, int half) { flow.take(half, point, limit, left, memory, hourglass); }
  Cell& alone() {
    FlowTogether<double, 3, false> flow;
    put(flow, 0);
    flow.find_planes(constants.data());
    flow.flow(solid, solid.layer[0].hardening, PlaneModuli(solid));
    take(flow, 0);
    return *this;
  }
  std::vector<double> all() const {
    std::vector<double> v(memory, memory + size + 1);
    v.insert(v.end(), hourglass, hourglass + kHourglassItems<3>);
    v.insert(v.end(), point.S.c, point.S.c + size);
    v.insert(v.end(), {point.dissipation, limit, left});
    return v;
  }
};

/// Those of `half` flow in a twin beside the other.
std::vector<double> beside(unsigned seed, double bent, unsigned other_seed, double other_bent, int half, const char* law = nullptr) {
  Cell own(seed, bent, law), other(other_seed, other_bent, law);
  FlowTogether<Twin<double>, 3, false> flow{};
  own.put(flow, half);
  other.put(flow, 1 - half);
  const double *first = half == 0 ? own.constants.data() : other.constants.data(), *second = half == 0 ? other.constants.data() : own.constants.data();
  flow.find_planes(TwinItems{{first, second}});
  flow.flow(own.solid, own.solid.layer[0].hardening, PlaneModuli(own.solid));
  own.take(flow, half);
  return own.all();
}

TEST(FlowTogether, ACellBesideAnotherFlowsAsItDoesAlone) {
  for (const char* law : {static_cast<const char*>(nullptr), "cowper_symonds", "johnson_cook"})
    for (unsigned seed = 1; seed < 40; ++seed) {
      const double bent = 1 + 0.5 * seed;  // also so far outside that it returns near the surface first
      const std::vector<double> alone = Cell(seed, bent, law).alone().all();
      EXPECT_NE(alone, Cell(seed, bent, law).all()) << seed << ": it flows";
      for (int half : {0, 1})
        for (double other : {0.0, 1.0, 20.0})  // one that does not flow, one that does, one that is far outside
          EXPECT_EQ(beside(seed, bent, seed + 100, other, half, law), alone) << "seed " << seed << ", half " << half << ", beside " << other << (law ? law : "");
    }
}

TEST(FlowTogether, ACellThatDoesNotFlowKeepsItsMemoryBesideOneThatDoes) {
  const Cell before(7, 0.0);
  for (int half : {0, 1}) {
    const std::vector<double> after = beside(7, 0.0, 8, 20.0, half), all = before.all();
    for (int i = 0; i < Cell::size + 1 + kHourglassItems<3>; ++i) EXPECT_EQ(after[i], all[i]) << i;
  }
}

TEST(FlowTogether, AnIdleHalfDoesNoHarm) {
  Cell own(3, 4.0);
  FlowTogether<Twin<double>, 3, false> flow{};  // whose second half is nothing but zeros
  own.put(flow, 0);
  flow.find_planes(TwinItems{{own.constants.data(), own.constants.data()}});
  flow.flow(own.solid, own.solid.layer[0].hardening, PlaneModuli(own.solid));
  own.take(flow, 0);
  EXPECT_EQ(own.all(), Cell(3, 4.0).alone().all());
}

// R(dp) of what has flowed in the step is what the yield stress was raised by, also where three coordinates go part of their way.
TEST(FlowTogether, TheYieldStressIsRaisedByTheRateOfItsFlow) {
  for (const char* law : {"power", "cowper_symonds", "johnson_cook"})
    for (unsigned seed = 1; seed < 40; ++seed)
      for (double bent : {1.0, 1.5, 2.0}) {
        Cell cell(seed, bent, law);
        cell.point.kept = 1 / (1 + 3 * cell.solid.mu * cell.point.dp / mises(cell.point.S));  // as the law returns
        const HardeningCurve& hardening = cell.solid.layer[0].hardening;
        const double before = cell.memory[Cell::size], by_law = cell.point.dp > 0 ? rate_factor(hardening.rate, std::log(cell.point.dp)).value : 1;
        const double sigma = cell.point.yield.value / by_law, slope = cell.point.yield.slope / by_law;
        cell.alone();
        const double beyond = cell.memory[Cell::size] - before, dp = cell.point.dp + beyond;
        if (beyond == 0 || dp <= 0) continue;
        EXPECT_NEAR(cell.limit / (sigma + slope * beyond), rate_factor(hardening.rate, std::log(dp)).value, 5e-3 * cell.limit / sigma) << law << ", seed " << seed << ", bent " << bent;
      }
}

}  // namespace
}  // namespace forming_sim
