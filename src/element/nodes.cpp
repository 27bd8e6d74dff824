#include "forming_sim/element/nodes.h"

#include <algorithm>
#include <atomic>

#include "forming_sim/element/cell_group.h"
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
const double* numbers(const NodeField& field) { return field.data()->data(); }
const double* numbers(const NodeField* field) { return field ? numbers(*field) : nullptr; }
double* numbers(NodeField& field) { return field.data()->data(); }

/// v after the kick of the nodes [first, last), body by body; how many go on to rest.
long kick_part(const Kick& kick, const NodeField& v, const NodalForces& forces, const std::vector<double>& mass, long first, long last, NodeField& to) {
  const auto part = [&](long begin, long end, double still) { return kernels().kick(kick.keep, kick.push, still, numbers(v), forces, mass.data(), begin, end, numbers(to)); };
  if (!kick.resting) return part(first, last, 0);
  long resting = 0;
  for (const RestingBody& body : *kick.resting) {
    const long begin = std::max<long>(first, body.first_node), end = std::min<long>(last, body.first_node + body.nodes);
    if (begin < end) resting += part(begin, end, kick.push * body.rounding);
  }
  return resting;
}
}  // namespace

void sum_nodes(const NodeTeam& team, const NodalForces& forces, NodeField& f) {
  team.share([&](long first, long last) { kernels().sum(forces, first, last, numbers(f)); });
}

Node force_on(long node, const NodalForces& forces) {
  const auto sum = [&](auto f) {
    using Record = decltype(f);
    for (int k = forces.start[node]; k < forces.start[node + 1]; ++k) f += Eigen::Map<const Record>(forces.slots + f.size() * static_cast<long>(forces.index[k]));
    return f;
  };
  Node f = Node::Zero();
  if (forces.dimension == 2) f.head<kRecord<2>>() = sum(Eigen::Vector2d(0, 0));
  else f = sum(f);
  if (forces.load) f += Eigen::Map<const Node>(forces.load + 4 * node);
  return f;
}

long kick_nodes(const NodeTeam& team, const Kick& kick, const NodeField& v, const NodalForces& forces, const std::vector<double>& mass, NodeField& to) {
  std::atomic<long> resting{0};
  team.share([&](long first, long last) {
    if (const long here = kick_part(kick, v, forces, mass, first, last, to); here > 0) resting += here;
  });
  return resting;
}

double move_nodes(const NodeTeam& team, double dt, const NodeField& v, const NodeField* then, NodeField& x) {
  return team.largest([&](long first, long last) { return kernels().move(dt, numbers(v), numbers(then), first, last, numbers(x)); });
}

KickedAndMoved kick_and_move_nodes(const NodeTeam& team, const Kick& kick, const NodeField& v_before, const NodalForces& forces, const std::vector<double>& mass,
                                   const std::function<void(long first, long last)>& hold, double dt, const NodeField* then, NodeField& v, NodeField& x) {
  std::atomic<long> resting{0};
  const double apart = team.largest([&](long first, long last) {
    if (const long here = kick_part(kick, v_before, forces, mass, first, last, v); here > 0) resting += here;
    hold(first, last);
    return kernels().move(dt, numbers(v), numbers(then), first, last, numbers(x));
  });
  return {apart, resting};
}

long compare_nodes(const NodeTeam& team, const NodeField& x, NodeField& seen, std::vector<char>& moved) {
  std::atomic<long> count{0};
  team.share([&](long first, long last) { count += kernels().compare(numbers(x), first, last, numbers(seen), moved.data()); });
  return count;
}

}  // namespace forming_sim
