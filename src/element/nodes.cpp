#include "forming_sim/element/nodes.h"

namespace forming_sim {

void kick_nodes(Team& team, const NodeField& v, const NodeField& f, const std::vector<double>& mass, double kick, double damping, NodeField& to) {
  const double a = 0.5 * damping * kick, keep = (1 - a) / (1 + a), push = kick / (1 + a);
  team.share(static_cast<long>(v.size()), kNodesOfAThread, [&](long first, long last) {
    for (long i = first; i < last; ++i) to[i] = keep * v[i] + push / mass[i] * f[i];
  });
}

void move_nodes(Team& team, double dt, const NodeField& v, NodeField& x) {
  team.share(static_cast<long>(x.size()), kNodesOfAThread, [&](long first, long last) {
    for (long i = first; i < last; ++i) x[i] += dt * v[i];
  });
}

}  // namespace forming_sim
