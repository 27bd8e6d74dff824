#pragma once
// A bar in uniaxial strain meets a rigid plane, or another bar: p = rho c_p v for 2 L / c_p.
#include <cmath>

#include "forming_sim/mesh/axis.h"
#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim {

constexpr double kBarPressure = 83.85e6, kBarDuration = 1.336e-3;  // Pa, s

struct Impact {
  double pressure, duration, restitution, balance;
  long crossings;
  RunSize run;
  double taken;  ///< energy that contact took over the kinetic energy at the start
};

/// What a bar is made of: crossed triangles in plane strain or, along the axis, turned about it; 24 tetrahedra a
/// hexahedron, two of these across.
enum class BarKind { plane, axisymmetric, space };

/// A bar along `axis`, its sides held in uniaxial strain.
struct Bar {
  OneBody run;
  int axis;
  double section;  ///< m2; plane: m
};

inline Bar bar_before_wall(BarKind kind, int cells, double length, double gap, double duration) {
  const bool space = kind == BarKind::space, plane = kind == BarKind::plane;
  const double side = space ? 2 * length / cells : 0.1 * length;
  const int across = space ? 2 : std::max(1, cells / 10);
  BlankConfig blank = kind == BarKind::axisymmetric ? strip_of(side, length, across, cells) : strip_of(length, side, cells, across);
  if (space) {
    blank.shape = "plate";
    blank.width = side;
    blank.cells_across = across;
  }
  const int axis = kind == BarKind::axisymmetric ? 1 : 0;
  blank.origin[axis] = gap;
  Mesh mesh = generate_blank(blank);
  if (kind == BarKind::axisymmetric) close_at_axis(mesh);
  Bar bar{OneBody(body_of(std::move(mesh), impact_material()), duration), axis, plane ? side : space ? side * side : M_PI * side * side};
  bar.run.model.axisymmetric = kind == BarKind::axisymmetric;
  const auto hold = [&](const char* set, const Vec3& normal) { bar.run.plan.bodies[0].boundaries.push_back(symmetric(set, normal)); };
  if (kind == BarKind::axisymmetric) hold("right", Vec3::UnitX());
  else
    for (const char* set : {"bottom", "top"}) hold(set, space ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitY()));
  if (space)
    for (const char* set : {"front", "back"}) hold(set, Vec3::UnitY());
  ToolModel wall = wall_at_zero();
  wall.normal = Vec3::Unit(axis);
  wall.mesh.dimension = bar.run.model.dimension;
  bar.run.model.tools.push_back(wall);
  return bar;
}

inline Impact hit_wall(int cells, double safety, const ContactConfig& contact = {}, BarKind kind = BarKind::plane) {
  const double rho = 2800, v = 5, L = 4, gap = 1e-3;
  Bar bar = bar_before_wall(kind, cells, L, gap, 2.2e-3);
  OneBody& run = bar.run;
  run.plan.bodies[0].initial_velocity = -v * Vec3::Unit(bar.axis);
  run.plan.time_step.safety = safety;
  run.plan.contact = contact;
  auto sim = run.start();
  const double start = gap / v;
  double early = 0, late = 0, t_early = 0, t_late = 0, first = 0, last = 0, before = 0;
  while (sim->step()) {
    const double t = sim->time() - start, impulse = -sim->tools()[0].felt.impulse[bar.axis];
    if (impulse > before) {
      if (first == 0) first = sim->time();
      last = sim->time();
    }
    before = impulse;
    if (t < 0.3e-3) early = impulse, t_early = t;
    if (t < 1.0e-3) late = impulse, t_late = t;
  }
  const double momentum = 2 * rho * L * bar.section * v;  // for restitution 1
  return {(late - early) / (t_late - t_early) / bar.section, last - first, sim->tools()[0].felt.impulse.norm() / momentum * 2 - 1,
          sim->balance_error(), sim->contact_status().crossings, size_of(*sim), sim->energies().contact / sim->energies().initial};
}

/// The same wave without contact: the end is held from the start, and what counts is the push until it would be a pull.
inline Impact hold_end(int cells, double safety, BarKind kind = BarKind::plane) {
  const double rho = 2800, v = 5, L = 4;
  Bar bar = bar_before_wall(kind, cells, L, 0, 2.2e-3);
  bar.run.model.tools.clear();
  BoundaryConfig end;
  end.set = kind == BarKind::axisymmetric ? "bottom" : "left";
  end.kind = "fixed";
  end.axes = {kind == BarKind::axisymmetric ? "y" : "x"};
  bar.run.plan.bodies[0].boundaries.push_back(end);
  bar.run.plan.bodies[0].initial_velocity = -v * Vec3::Unit(bar.axis);
  bar.run.plan.time_step.safety = safety;
  auto sim = bar.run.start();
  const double whole = rho * L * bar.section * v;
  double early = 0, late = 0, t_early = 0, t_late = 0, most = -whole, last = 0;
  while (sim->step()) {
    double p = 0;
    for (std::size_t i = 0; i < sim->velocities().size(); ++i) p += sim->nodal_mass()[i] * sim->velocities()[i][bar.axis];
    if (p > most) most = p, last = sim->time();
    if (sim->time() < 0.3e-3) early = p, t_early = sim->time();
    if (sim->time() < 1.0e-3) late = p, t_late = sim->time();
  }
  return {(late - early) / (t_late - t_early) / bar.section, last, most / whole, sim->balance_error(), 0, size_of(*sim), 0};
}

// Two bars, whose meshes need not match, do to each other what the plane does.
struct Meeting {
  double pressure, duration, restitution, balance, momentum;
  long crossings;
  RunSize run;
};

inline Meeting hit_each_other(int cells, int other_cells, const ContactConfig& contact = {}) {
  const double rho = 2800, v = 5, L = 4, height = 0.4, gap = 2e-3;
  const MaterialConfig m = impact_material();
  Model model;
  RunPlan plan;
  model.dimension = 2;
  plan.stages.push_back(form_for(2.2e-3));
  plan.contact = contact;
  for (int side = 0; side < 2; ++side) {
    const int n = side == 0 ? cells : other_cells;
    BlankConfig blank = strip_of(L, height, n, std::max(1, n / 10) + side);
    blank.origin = Vec3(side == 0 ? -L - gap / 2 : gap / 2, 0, 0);
    BodyModel body = body_of(generate_blank(blank), m);
    add_flying(model, plan, std::move(body), side == 0 ? "left" : "right", Vec3(side == 0 ? v : -v, 0, 0));
    for (const char* edge : {"bottom", "top"}) plan.bodies.back().boundaries.push_back(symmetric(edge, Vec3::UnitY()));
  }
  Simulation sim(plan, model, 1);
  const auto momentum = [&](std::size_t body) {
    double p = 0;
    for (int i = 0; i < model.bodies[body].node_count; ++i) {
      const int n = model.bodies[body].first_node + i;
      p += sim.nodal_mass()[n] * sim.velocities()[n][0];
    }
    return p;
  };
  const double start = gap / (2 * v), whole = rho * L * height * v;
  double early = 0, late = 0, t_early = 0, t_late = 0, first = 0, last = 0, before = 0, drift = 0;
  while (sim.step()) {
    const double t = sim.time() - start, p = momentum(1), impulse = p + whole;
    drift = std::max(drift, std::fabs(p + momentum(0)) / whole);
    if (impulse > before + 1e-9 * whole) {
      if (first == 0) first = sim.time();
      last = sim.time();
    }
    before = std::max(before, impulse);
    if (t < 0.3e-3) early = impulse, t_early = t;
    if (t < 1.0e-3) late = impulse, t_late = t;
  }
  return {(late - early) / (t_late - t_early) / height, last - first, momentum(1) / whole, sim.balance_error(), drift,
          sim.contact_status().crossings, size_of(sim)};
}

}  // namespace forming_sim
