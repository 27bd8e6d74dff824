// What comes at once: impact at up to 3000 m/s, full pressure from the first step, and
// mass scaling by 1e4.
#include <cmath>

#include "stability/stability.h"

namespace forming_sim::bench {
namespace {

/// A block of aluminium in plane strain flies against the plane x = 0.
OneBody thrown(double speed, const std::string& pattern) {
  BlankConfig blank = strip_of(10e-3, 5e-3, 16, 8);
  blank.origin = Vec3(1e-4, 0, 0);
  blank.pattern = pattern;
  OneBody run(body_of(generate_blank(blank), aluminium(true)), 20e-6);
  run.plan.bodies[0].initial_velocity = Vec3(-speed, 0, 0);
  run.plan.bodies[0].boundaries.push_back(symmetric("bottom", Vec3::UnitY()));
  run.plan.time_step.linear_viscosity = 0.06;
  run.plan.time_step.quadratic_viscosity = 1.2;
  run.model.tools.push_back(wall_at_zero());
  return run;
}

/// The ledger's error is of second order in the step at best, and the global limit's step is up to 1.45 times the element's.
struct Limit {
  const char* name;
  double ledger;  ///< allowance over that of the element's limit
};
constexpr Limit kLimits[] = {{"element", 1}, {"global", 2}};

}  // namespace

std::vector<Row> fast_impact(const Request&) {
  std::vector<Row> rows;
  for (double speed : {100., 300., 1000.})
    for (const char* pattern : {"fine", "coarse"})
      for (const Limit& limit : kLimits) {
        const std::string name = "impact at " + std::to_string(static_cast<int>(speed)) + " m/s, " + pattern + ", " + limit.name;
        OneBody run = thrown(speed, pattern);
        run.plan.time_step.limit = limit.name;
        const auto sim = tried(rows, name, run, 0.01 * limit.ledger);
        rows.push_back(just(name, "steps", static_cast<double>(sim->steps()), sim->wall_time()));
        rows.push_back(at_most(name, "crossings", static_cast<double>(sim->contact_status().crossings), 0, sim->wall_time()));
        const Energies& e = sim->energies();
        rows.push_back(at_most(name, "kinetic + elastic energy / that at the start", (e.kinetic + e.elastic) / e.initial, 1, sim->wall_time()));
      }
  // A cube in space, without viscosity, as a run takes it.
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    const std::string name = std::string("a cube at 1000 m/s, ") + pattern;
    const double side = 10e-3, speed = 1000;
    BlankConfig blank = strip_of(side, side, 6, 6);
    blank.shape = "plate";
    blank.width = side;
    blank.cells_across = 6;
    blank.pattern = pattern;
    OneBody run(body_of(generate_blank(blank), aluminium(true)), 2 * side / speed);
    run.plan.bodies[0].initial_velocity = Vec3(0, 0, -speed);
    run.model.tools = {plane_at("wall", 3, Vec3(0, 0, -1e-5), Vec3::UnitZ())};
    const auto sim = tried(rows, name, run, 0.02);
    rows.push_back(at_most(name, "crossings", static_cast<double>(sim->contact_status().crossings), 0, sim->wall_time()));
  }
  return rows;
}

std::vector<Row> sudden_loads(const Request&) {
  std::vector<Row> rows;
  // An elastic bar in uniaxial strain, all of a pressure at once: the wave comes back
  // from the wall and doubles, the end moves by twice the static way, no more.
  for (const char* pattern : {"fine", "coarse"})
    for (const Limit& limit : kLimits) {
      const std::string name = std::string("full pressure at once, ") + pattern + ", " + limit.name;
      const double length = 0.1, load = 100e6;
      BlankConfig blank = strip_of(length, 0.01, 40, 4);
      blank.pattern = pattern;
      const MaterialConfig material = aluminium();
      const double modulus = material.K() + 4. / 3 * material.mu(), speed = std::sqrt(modulus / material.density);
      OneBody run(body_of(generate_blank(blank), material), 8 * length / speed);
      run.plan.time_step.limit = limit.name;
      BodyLoads& loads = run.plan.bodies[0];
      loads.boundaries = {symmetric("left", Vec3::UnitX()), symmetric("bottom", Vec3::UnitY()), symmetric("top", Vec3::UnitY())};
      PressureConfig pressure;
      pressure.set = "right";
      pressure.times = {0};
      pressure.values = {load};
      loads.pressures.push_back(pressure);
      struct Farthest : Observer {
        int node = 0;
        double way = 0;
        void on_step(const Simulation& sim) override { way = std::max(way, sim.initial_positions()[node][0] - sim.positions()[node][0]); }
      } farthest;
      farthest.node = run.model.bodies[0].mesh.sets.at("right")[0];
      auto sim = run.start();
      sim->add(farthest);
      const std::atomic<bool> cancel{false};
      const Outcome outcome = sim->run(cancel);
      rows.push_back(at_most(name, "failures", outcome.code == Code::success ? 0 : 1, 0, sim->wall_time()));
      rows.back().note = outcome.code == Code::success ? "" : outcome.message;
      rows.push_back(near(name, "largest way of the loaded end / static", farthest.way * modulus / (load * length), 2, 0.03, sim->wall_time()));
      rows.push_back(at_most(name, "ledger error over work", sim->balance_error(), 1e-3 * limit.ledger, sim->wall_time()));
    }
  // A strip pulled to 20 % strain with its mass times 1e4: the ledger must tell the truth about the inertia.
  for (double scaling : {1., 1e4}) {
    const std::string name = scaling > 1 ? "mass scaling by 1e4" : "the same strip without mass scaling";
    const double duration = 1e-3, length = 20e-3;
    OneBody run(body_of(generate_blank(strip_of(length, 2e-3, 20, 4)), aluminium(true)), duration);
    run.plan.time_step.mass_scaling = scaling;
    BoundaryConfig held = symmetric("left", Vec3::UnitX()), pulled;
    pulled.set = "right";
    pulled.kind = "velocity";
    pulled.axes = {"x"};
    pulled.times = {0, duration / 2, duration};
    pulled.velocities = {Vec3::Zero(), Vec3(0.4 * length / duration, 0, 0), Vec3::Zero()};
    run.plan.bodies[0].boundaries = {held, pulled, symmetric("bottom", Vec3::UnitY())};
    const auto sim = tried(rows, name, run, 5e-3);
    const Energies& e = sim->energies();
    rows.push_back(just(name, "kinetic energy / internal, at the end", e.kinetic / (e.elastic + e.plastic), sim->wall_time()));
  }
  return rows;
}

}  // namespace forming_sim::bench
