// Two blocks whose meshes do not match, pressed together: the stress is the same everywhere.
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {
namespace {

struct Patch {
  double mean, spread;        ///< of the stress along the pressing, of all elements: mean over the exact one - 1, rms about the mean
  double worst;               ///< largest departure of an element from the mean
  double balance;
  long crossings;
};

/// Two blocks of 1 x .5 m (3D: 1 x 1 x .5), E 1 MPa, nu 0, pressed by .01 m; n cells of the lower, m of the upper along 1 m.
Patch press(int dimension, int n, int m) {
  const double E = 1e6, rho = 1000, pressing = 0.01, time = 0.6;
  Model model;
  RunPlan plan;
  model.dimension = dimension;
  MaterialConfig material;
  material.density = rho;
  material.youngs_modulus = E;
  material.poissons_ratio = 0;
  const int up = dimension - 1;
  const double h0 = 1e-5;
  for (int side = 0; side < 2; ++side) {
    BlankConfig blank;
    blank.shape = dimension == 2 ? "strip" : "plate";
    blank.pattern = dimension == 2 ? "fine" : "coarse";
    blank.length = blank.width = 1;
    blank.thickness = 0.5;
    blank.cells_along = blank.cells_across = side == 0 ? n : m;
    blank.cells_through = (blank.cells_along + 1) / 2;
    blank.origin[up] = side == 0 ? -0.5 - h0 : 0;
    BodyModel body = body_of(generate_blank(blank), material);
    BodyLoads& loads = add_flying(model, plan, std::move(body), side == 0 ? "lower" : "upper", Vec3::Zero());
    BoundaryConfig b;
    b.set = side == 0 ? "bottom" : "top";
    if (side == 0) {
      b.kind = "symmetric";
      b.normal = Vec3::Unit(up);
    } else {
      b.kind = "velocity";
      b.axes = {dimension == 2 ? "y" : "z"};
      b.times = {0, 0.5 * time, time};
      b.velocities = {Vec3::Zero(), -Vec3::Unit(up) * pressing / (0.5 * time), Vec3::Zero()};
      b.profile = "smooth";
    }
    loads.boundaries.push_back(b);
    for (int axis = 0; axis < up; ++axis) {  // nothing moves sideways: nu is 0
      BoundaryConfig held;
      held.set = axis == 0 ? "left" : "front";
      held.kind = "symmetric";
      held.normal = Vec3::Unit(axis);
      loads.boundaries.push_back(held);
    }
  }
  plan.contact.layer = h0;
  plan.time_step.damping = 60;  // of the slowest swing along the pressing
  plan.stages.push_back(form_for(time + 0.6));
  Simulation sim(plan, model, 1);
  while (sim.step()) {
  }
  const std::vector<Sym> stress = sim.stress();
  double mean = 0, square = 0, worst = 0;
  for (const Sym& s : stress) mean += s[up] / static_cast<double>(stress.size());
  for (const Sym& s : stress) {
    square += std::pow(s[up] - mean, 2) / static_cast<double>(stress.size());
    worst = std::max(worst, std::abs(s[up] - mean));
  }
  // 1e4 Pa in small strain; p + S of the package's law for a stretch of .99 along the pressing alone, nu = 0.
  const double stretch = 1 - pressing, exact = E / 3 * (stretch - 1) + E / 2 * std::pow(stretch, -5. / 3) * 2. / 3 * (stretch * stretch - 1);
  return {mean / exact - 1, std::sqrt(square) / -exact, worst / -exact, sim.balance_error(), sim.contact_status().crossings};
}

}  // namespace

// Matching meshes carry the exact stress. Where they do not match, the forces of the vertices of either side on the
// other's facets are not quite those of an even pressure: a few per cent in the cells at the contact, none far from it.
TEST(ContactPatch, MatchingAndNonMatchingMeshes) {
  for (int dimension : {2, 3})
    for (const auto& [n, m] : {std::pair{4, 4}, std::pair{4, 6}, std::pair{7, 5}, std::pair{14, 10}}) {
      if (dimension == 3 && n > 10) continue;
      const Patch found = press(dimension, n, m);
      std::printf("  %dD, %d on %d cells: mean %+.2e, rms %.2e, largest %.2e, balance %.1e\n", dimension, m, n, found.mean, found.spread, found.worst, found.balance);
      const bool match = n == m;
      EXPECT_LT(std::abs(found.mean), match ? 1e-4 : 5e-3) << dimension << "D " << n << " " << m;
      EXPECT_LT(found.spread, match ? 1e-4 : 1e-2) << dimension << "D " << n << " " << m;
      EXPECT_LT(found.worst, match ? 1e-3 : 5e-2) << dimension << "D " << n << " " << m;
      EXPECT_EQ(found.crossings, 0);
      EXPECT_LT(found.balance, 1e-3);
    }
}

}  // namespace forming_sim
