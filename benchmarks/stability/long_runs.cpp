// Many steps of small free bodies: what does not change must not drift.
#include <cmath>

#include "stability/stability.h"
#include "stepped_body.h"

namespace forming_sim::bench {
namespace {

Mesh block(const std::string& pattern) {
  BlankConfig blank;
  blank.shape = "plate";
  blank.pattern = pattern;
  blank.origin = Vec3(-0.5, -0.5, -0.25);
  blank.length = blank.width = 1;
  blank.thickness = 0.5;
  blank.cells_along = blank.cells_across = blank.cells_through = 2;
  return generate_blank(blank);
}

/// Turns at 2 pi turns / (steps dt) and swings by strains of some 1e-3.
void kept(std::vector<Row>& rows, const std::string& name, const std::string& pattern, long steps, double turns) {
  const Clock clock;
  SteppedBody body(block(pattern), aluminium());
  const double dt = 0.5 * body.stable_step(), omega = 2 * M_PI * turns / (static_cast<double>(steps) * dt);
  for (std::size_t n = 0; n < body.v.size(); ++n) {
    const Node& X = body.X[n];
    body.v[n] = omega * Node(-X[1], X[0], 0, 0) + Node(8 * X[0], -6 * X[1], 5 * X[2] + 3 * X[0], 0);
  }
  std::string broken;
  double start = 0, off = 0, early = 0, late = 0, momentum = 0, spun = 0, turned = 0, angle = 0;
  try {
    for (long n = 0; n < steps; ++n) {
      body.accelerate(dt);
      if (n % 97 == 1) {
        const double energy = body.energy(), l = body.angular_momentum().z();
        if (n == 1) start = energy, momentum = l;
        off = std::max(off, std::abs(energy / start - 1));
        if (n < steps / 10) early += energy;
        if (n >= steps - steps / 10) late += energy;
        if (turns > 0) spun = std::max(spun, std::abs(l / momentum - 1));
        double sine = 0, cosine = 0;
        for (std::size_t i = 0; i < body.x.size(); ++i) {
          sine += body.mass()[i] * (body.X[i][0] * body.x[i][1] - body.X[i][1] * body.x[i][0]);
          cosine += body.mass()[i] * (body.X[i][0] * body.x[i][0] + body.X[i][1] * body.x[i][1]);
        }
        const double now = std::atan2(sine, cosine);
        turned += std::remainder(now - angle, 2 * M_PI);
        angle = now;
      }
      body.move(dt);
    }
  } catch (const Error& error) {
    broken = error.what();
  }
  const double time = clock.seconds();
  rows.push_back(at_most(name, "false inversions", broken.empty() ? 0 : 1, 0, time));
  rows.back().note = broken;
  // At half the stable step, w dt <= 1, the energy of the half steps swings by up to (w dt)^2 / 8 of that
  // of a mode; what must not be is a drift.
  rows.push_back(at_most(name, "largest change of energy / energy", off, 0.125, time));
  rows.push_back(at_most(name, "drift: mean of the last tenth / of the first, off 1", std::abs(late / early - 1), 1e-3, time));
  if (turns > 0) {
    rows.push_back(at_most(name, "largest change of angular momentum / itself", spun, 1e-9, time));
    rows.push_back(near(name, "turns", turned / (2 * M_PI), turns, 0.01, time));
    rows.back().note = "it starts unstretched, is widened by its spin and turns the slower";
  }
}

void both(std::vector<Row>& rows, const std::string& name, long steps, double turns) {
  for (const char* pattern : {"fine", "coarse"}) kept(rows, name + ", " + pattern, pattern, steps, turns);
}

}  // namespace

std::vector<Row> many_steps(const Request&) {
  std::vector<Row> rows;
  both(rows, "a million steps", 1000000, 0);
  return rows;
}

std::vector<Row> ten_million_steps(const Request&) {
  std::vector<Row> rows;
  both(rows, "ten million steps", 10000000, 0);
  return rows;
}

std::vector<Row> spin(const Request&) {
  std::vector<Row> rows;
  both(rows, "a thousand turns", 1000000, 1000);
  return rows;
}

}  // namespace forming_sim::bench
