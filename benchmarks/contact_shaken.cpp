// A sheet between two tools that shake, for a million steps: held, and with play. Nothing
// crosses, and nothing drifts. forming_bench contact shaken.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/profile.h"
#include "rows.h"
#include "shaken.h"
#include "support/runs.h"

namespace forming_sim::bench {
namespace {

constexpr long kSteps = 1000000;
constexpr int kTurns = 24;            // of the upper tool; the lower one turns 5/4 as often
constexpr double mm = 1e-3, thickness = 1 * mm;
constexpr double kSway = 0.5 * mm, kLift = 0.05 * mm;  // amplitudes along and across the sheet

struct Case {
  const char* name;
  double play;     ///< between the upper tool and the sheet, m; less than 0: pressed together by so much
  double tremble;  ///< amplitude of the upper tool against the lower one, m
};

/// From one side to the other at y, the body on its right hand.
Mesh face(double from, double to, double y) {
  ProfileConfig profile;
  profile.start = Vec3(from, y, 0);
  profile.pieces.emplace_back();
  profile.pieces.back().to = Vec3(to, y, 0);
  return mesh_profile(profile);
}

/// Begins at rest, closes by `down`, and swings from a tenth of the time to nine tenths:
/// x = sway sin(2 pi turns s), y = lift sin(2 pi s kTurns / 2) + tremble sin(2 pi s kTurns).
MotionConfig shaking(double time, double turns, double down, double tremble) {
  MotionConfig motion;
  motion.kind = "trajectory";
  motion.profile = "spline";
  const int knots = 16 * kTurns;
  motion.times.push_back(0);
  motion.positions.push_back(Vec3::Zero());
  for (int k = 0; k <= knots; ++k) {
    const double s = static_cast<double>(k) / knots, begin = std::min(1.0, 2.0 * k / 16), end = std::min(1.0, 2.0 * (knots - k) / 16);
    const double fade = begin * begin * (3 - 2 * begin) * end * end * (3 - 2 * end);
    motion.times.push_back(time * (0.1 + 0.8 * s));
    motion.positions.push_back(fade * Vec3(kSway * std::sin(2 * M_PI * turns * s), kLift * std::sin(M_PI * kTurns * s) + tremble * std::sin(2 * M_PI * kTurns * s), 0) -
                               down * Vec3::UnitY());
  }
  return motion;
}

ToolModel tool(const char* name, Mesh mesh, MotionConfig motion) {
  ToolModel tool;
  tool.name = name;
  tool.mesh = std::move(mesh);
  tool.friction = 0.2;
  tool.motion = std::move(motion);
  return tool;
}

/// What is seen of the run in a part of it.
struct Watched {
  double kinetic = 0, most_kinetic = 0, elastic = 0;  ///< J/m: means, and the largest
  long looks = 0;
};

}  // namespace

std::vector<Row> shaken() {
  std::vector<Row> rows;
  for (const Case& what : {Case{"shaken, held at 40 MPa", -0.5e-3 * mm, 0.2e-3 * mm}, Case{"shaken, with 0.02 mm of play", 0.02 * mm, 0}}) {
    const Clock clock;
    OneBody run(body_of(generate_blank(strip_of(10 * mm, thickness, 20, 2)), aluminium(true)), 1);
    const double dt = run.start()->dt(), time = dt * kSteps;
    run.plan.stages[0].duration = time;
    run.plan.time_step.maximum = dt;
    run.model.tools.push_back(tool("lower", face(20 * mm, -10 * mm, 0), shaking(time, 1.25 * kTurns, 0, 0)));
    run.model.tools.push_back(tool("upper", face(-10 * mm, 20 * mm, thickness + std::max(0.0, what.play)), shaking(time, kTurns, std::max(0.0, -what.play), what.tremble)));
    const auto sim = run.start();
    const double mass = std::accumulate(sim->nodal_mass().begin(), sim->nodal_mass().end(), 0.0);
    double speed = 0;  // of the tools, the greatest
    Watched part[3];  // the first half of the shaking, the second, and after it
    std::string error;
    try {
      while (sim->step()) {
        const double s = sim->progress();
        if (sim->steps() % 37 != 0 || s < 0.1) continue;
        Watched& now = part[s < 0.5 ? 0 : s < 0.9 ? 1 : 2];
        const Energies& e = sim->energies();
        now.kinetic += e.kinetic;
        now.elastic += e.elastic;
        now.most_kinetic = std::max(now.most_kinetic, e.kinetic);
        ++now.looks;
        for (const ToolStatus& t : sim->tools()) speed = std::max(speed, t.velocity.norm());
      }
    } catch (const Error& e) {
      error = e.what();
    }
    const double wall = clock.seconds();
    Row end = just(what.name, "steps", static_cast<double>(sim->steps()), wall);
    end.expected = kSteps;
    end.error = end.found / kSteps - 1;
    end.holds = error.empty() && sim->steps() >= kSteps;
    end.note = error;
    rows.push_back(end);
    for (Watched& p : part) p.kinetic /= std::max(1L, p.looks), p.elastic /= std::max(1L, p.looks);
    const Energies& e = sim->energies();
    const ContactStatus status = sim->contact_status();
    double plastic = 0;
    for (double p : sim->plastic_strain()) plastic = std::max(plastic, p);
    rows.push_back(at_most(what.name, "crossings", static_cast<double>(status.crossings), 0, wall));
    rows.push_back(just(what.name, "halvings", static_cast<double>(status.halvings), wall));
    rows.push_back(just(what.name, "least gap / h0", status.min_gap_over_layer, wall));
    // Held, the sheet does the same turn after turn; where its tools slide against each other it squeals: friction
    // drives waves in it, as fast as the tools are, on top of its way with them. With play it flies from tool to tool,
    // no two turns are the same, and it gets no faster than the tools.
    const bool held = what.play < 0;
    const auto judged = [&](bool holds, const char* quantity, double found, double most) {
      return holds ? at_most(what.name, quantity, found, most, wall) : just(what.name, quantity, found, wall);
    };
    const double most = std::max({part[0].most_kinetic, part[1].most_kinetic, part[2].most_kinetic});
    rows.push_back(just(what.name, "greatest speed of the tools, m/s", speed, wall));
    rows.push_back(judged(!held, "kinetic energy / of the sheet at that speed", most / (0.5 * mass * speed * speed), 1));
    rows.push_back(judged(held, "kinetic energy, second half / first", part[1].kinetic / part[0].kinetic, 1.1));
    rows.push_back(judged(held, "elastic energy, second half / first", part[1].elastic / part[0].elastic, 1.1));
    rows.push_back(just(what.name, "kinetic energy, tools at rest / shaken", part[2].kinetic / part[0].kinetic, wall));
    rows.push_back(just(what.name, "friction over work", e.friction / e.work, wall));
    rows.push_back(just(what.name, "plastic strain", plastic, wall));
    rows.push_back(at_most(what.name, "error of the ledger", sim->balance_error(), 0.01, wall));
  }
  return rows;
}

}  // namespace forming_sim::bench
