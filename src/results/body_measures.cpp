#include "forming_sim/results/body_measures.h"

namespace forming_sim {

BodyMeasures measure_body(int first, int count, bool axisymmetric, const std::vector<double>& nodal_mass, const NodeField& positions,
                          const NodeField& velocities) {
  BodyMeasures body;
  for (int i = first; i < first + count; ++i) {
    const Vec3 x = vec3(positions[i]), p = nodal_mass[i] * vec3(velocities[i]);
    body.mass += nodal_mass[i];
    body.centre += nodal_mass[i] * x;
    body.momentum += p;
    body.angular_momentum += x.cross(p);
    body.box.extend(x);
  }
  if (body.mass > 0) body.centre /= body.mass;
  if (axisymmetric) {
    body.centre.x() = body.momentum.x() = 0;
    body.angular_momentum.setZero();
  }
  return body;
}

}  // namespace forming_sim
