// Cook's membrane: a tapered panel clamped at the left, sheared at the right, plane
// strain, elastic-plastic at large strain. How far its upper right corner rises:
// 6.95 +- .1 mm (published). Elements that lock in plastic flow or in bending rise less.
#include <cmath>

#include "speed_error/families.h"
#include "speed_error/peers.h"
#include "speed_error/report.h"
#include "stepped_body.h"
#include "support/cook.h"

namespace forming_sim::bench {

namespace {

/// The traction rises smoothly in `rise` seconds and stays half as long.
Finished sheared(const Family& family, int cells, double rise) {
  const Mesh mesh = membrane(cells, family.pattern);
  const Clock clock;
  SteppedBody body(mesh, cook_material(), family.average);
  for (int n : mesh.sets.at("left")) body.free[n] = Node::Zero();
  // A dead load, the edge's share to each node: half as much at its ends.
  const std::vector<int>& edge = mesh.sets.at("right");
  NodeField full(body.x.size(), Node::Zero());
  for (int n : edge) {
    const bool corner = std::abs(mesh.nodes[n].y() - 44e-3) < 1e-9 || std::abs(mesh.nodes[n].y() - 60e-3) < 1e-9;
    full[n][1] = kCookTraction * 16e-3 / cells * (corner ? 0.5 : 1);
  }
  body.damping = 2.5e4;  // no overshoot, which would stay as plastic strain: the slowest swing takes about .1 ms, longer in plastic flow
  double dt = 0, time = 0;
  long steps = 0;
  while (time < 1.5 * rise) {
    if (steps++ % 50 == 0) dt = 0.8 * body.stable_step();
    const double s = std::min(1.0, (time + dt) / rise), smooth = s * s * s * (10 - 15 * s + 6 * s * s);
    for (int n : edge) body.load[n] = smooth * full[n];
    body.step(dt);
    time += dt;
  }
  const int corner = upper_right(mesh);
  return {family.name, std::to_string(cells) + " x " + std::to_string(cells), size_of(mesh, steps, clock.seconds()),
          {1e3 * (body.x[corner][1] - body.X[corner][1])}};
}

}  // namespace

void cook_problem(Report& report) {
  report.begin("cook", "Cook's membrane, elastic-plastic", {{"rise of the corner, mm", kCookRise, 0.015}});
  constexpr double rise = 2.5e-3;
  for (const Family& family : kFamilies) {
    if (family.dimension != 2) continue;
    for (int cells : {4, 8, 16, 32}) report.add(sheared(family, cells, rise));
  }
  // Slow motion is what makes it quasi-static: how slow need it be?
  for (double times : {0.5, 2., 4.}) {
    Finished run = sheared(kFamilies[0], 16, rise / times);
    run.choice += ", other speeds of loading";
    run.mesh += ", speed x " + std::to_string(times).substr(0, 3);
    report.add(run);
  }
  cook_by_calculix(report);
}

}  // namespace forming_sim::bench
