#include "forming_sim/element/nodes.h"

#include "forming_sim/element/node_kernels.h"

namespace forming_sim {

const NodeKernels& node_kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::node_kernels() : isa == Isa::avx2 ? avx2::node_kernels() : sse2::node_kernels();
}

namespace {
/// Of this processor, asked for once.
const NodeKernels& kernels() {
  static const NodeKernels& widest = node_kernels_of(choose_isa());
  return widest;
}
}  // namespace

void kick_nodes(Team& team, const NodeField& v, const NodeField& f, const std::vector<double>& mass, double kick, double damping, NodeField& to) {
  const double a = 0.5 * damping * kick, keep = (1 - a) / (1 + a), push = kick / (1 + a);
  team.share(static_cast<long>(v.size()), kNodesOfAThread, [&](long first, long last) {
    kernels().kick(keep, push, v.data()->data(), f.data()->data(), mass.data(), first, last, to.data()->data());
  });
}

void move_nodes(Team& team, double dt, const NodeField& v, NodeField& x) {
  team.share(static_cast<long>(x.size()), kNodesOfAThread, [&](long first, long last) { kernels().move(dt, v.data()->data(), first, last, x.data()->data()); });
}

}  // namespace forming_sim
