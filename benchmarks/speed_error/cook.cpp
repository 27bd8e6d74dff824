// Cook's membrane: a tapered panel clamped at the left, sheared at the right, plane
// strain, elastic-plastic at large strain. How far its upper right corner rises:
// 6.95 +- .1 mm (published). Elements that lock in plastic flow or in bending rise less.
#include <cmath>

#include "speed_error/families.h"
#include "speed_error/peers.h"
#include "speed_error/problems.h"
#include "stepped_body.h"
#include "support/cook.h"

namespace forming_sim::bench {

namespace {

/// Loaded in `loading` seconds, which are followed by a fifth of them.
Finished sheared(const Family& family, int cells, double loading) {
  const Mesh mesh = membrane(cells, family.pattern);
  const Clock clock;
  SteppedBody body(mesh, cook_material(), family.average);
  for (int n : mesh.sets.at("left")) body.free[n] = Node::Zero();
  const NodeField full = cook_load(mesh);
  body.damping = kCookDamping;
  double dt = 0, time = 0;
  long steps = 0;
  while (time < loading * (1 + kCookHold / kCookLoading)) {
    if (steps++ % 50 == 0) dt = 0.8 * body.stable_step();
    const double share = cook_share(time + dt, loading);
    for (int n : mesh.sets.at("right")) body.load[n] = share * full[n];
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
  for (const Family& family : kFamilies) {
    if (family.dimension != 2) continue;
    for (int cells : {4, 8, 16, 32}) report.add(sheared(family, cells, kCookLoading));
  }
  // Slow motion is what makes it quasi-static: how slow need it be?
  for (double times : {0.5, 2., 4.}) {
    Finished run = sheared(kFamilies[0], 16, kCookLoading / times);
    run.choice += ", other speeds of loading";
    run.mesh += ", speed x " + std::to_string(times).substr(0, 3);
    report.add(run);
  }
  cook_by_calculix(report);
}

}  // namespace forming_sim::bench
