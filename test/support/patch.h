#pragma once
// The patch test of contact: two blocks whose meshes need not match, pressed together. The stress is the same everywhere.
#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/axis.h"
#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim::patch {

/// Blocks of 1 x .5 m (3D: 1 x 1 x .5; axisymmetric: discs of 1 m radius), E 1 MPa, nu 0, pressed by .01 m.
struct Blocks {
  int dimension = 2;
  bool axisymmetric = false;
  int lower = 4, upper = 4;   ///< cells along 1 m
  double layer = 1e-5;        ///< h0, m
  int max_sweeps = 100;       ///< contact.max_sweeps
};

struct Found {
  double mean, spread;        ///< stress along the pressing over the exact one, of all elements: mean, rms about the mean
  double worst;               ///< largest departure of an element from the mean
  double balance;
  long crossings;
  RunSize run;
};

inline Found press(const Blocks& blocks) {
  const double E = 1e6, rho = 1000, pressing = 0.01, time = 0.6, h0 = blocks.layer;
  const int dimension = blocks.dimension, up = dimension - 1;
  Model model;
  RunPlan plan;
  model.dimension = dimension;
  model.axisymmetric = blocks.axisymmetric;
  MaterialConfig material;
  material.density = rho;
  material.youngs_modulus = E;
  material.poissons_ratio = 0;
  for (int side = 0; side < 2; ++side) {
    BlankConfig blank;
    blank.shape = dimension == 2 ? "strip" : "plate";
    blank.pattern = dimension == 2 ? "fine" : "coarse";
    blank.length = blank.width = 1;
    blank.thickness = 0.5;
    blank.cells_along = blank.cells_across = side == 0 ? blocks.lower : blocks.upper;
    blank.cells_through = (blank.cells_along + 1) / 2;
    blank.origin[up] = side == 0 ? -0.5 - h0 : 0;
    Mesh mesh = generate_blank(blank);
    if (blocks.axisymmetric) close_at_axis(mesh);
    BodyLoads& loads = add_flying(model, plan, body_of(std::move(mesh), material), side == 0 ? "lower" : "upper", Vec3::Zero());
    BoundaryConfig b;
    if (side == 0) {
      b = symmetric("bottom", Vec3::Unit(up));
    } else {
      b.set = "top";
      b.kind = "velocity";
      b.axes = {dimension == 2 ? "y" : "z"};
      b.times = {0, 0.5 * time, time};
      b.velocities = {Vec3::Zero(), -Vec3::Unit(up) * pressing / (0.5 * time), Vec3::Zero()};
      b.profile = "smooth";
    }
    loads.boundaries.push_back(b);
    for (int axis = 0; axis < up && !blocks.axisymmetric; ++axis)  // nothing moves sideways: nu is 0
      loads.boundaries.push_back(symmetric(axis == 0 ? "left" : "front", Vec3::Unit(axis)));
  }
  plan.contact.layer = h0;
  plan.contact.max_sweeps = blocks.max_sweeps;
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
  return {mean / exact, std::sqrt(square) / -exact, worst / -exact, sim.balance_error(), sim.contact_status().crossings, size_of(sim)};
}

}  // namespace forming_sim::patch
