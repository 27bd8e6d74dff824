#include "forming_sim/loads/gravity.h"

namespace forming_sim {

void add_gravity(const Vec3& gravity, const std::vector<double>& mass, NodeField& f) {
  const Node g = node(gravity);
  for (size_t i = 0; i < mass.size(); ++i) f[i] += mass[i] * g;
}

}  // namespace forming_sim
