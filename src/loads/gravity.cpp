#include "forming_sim/loads/gravity.h"

namespace forming_sim {

void add_gravity(const Vec3& gravity, const std::vector<double>& mass, NodeField& f) {
  const Node g = node(gravity);
  for (size_t i = 0; i < mass.size(); ++i) f[i] += mass[i] * g;
}

double gravity_work(const Vec3& gravity, const std::vector<double>& mass, const NodeField& v_before,
                    const NodeField& v_after, double dt) {
  const Node g = node(gravity);
  double work = 0;
  for (size_t i = 0; i < mass.size(); ++i) work += mass[i] * g.dot(v_before[i] + v_after[i]);
  return 0.5 * dt * work;
}

}  // namespace forming_sim
