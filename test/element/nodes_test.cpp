// The passes over the nodes: what is summed on the way is what would have been summed first, to the last bit.
#include "forming_sim/element/nodes.h"

#include <gtest/gtest.h>

#include <random>

#include "support/bodies.h"

namespace forming_sim {
namespace {

/// A block of more nodes than one thread and one part of a pass have, moved at random, with loads.
struct Moved {
  Elements elements;
  NodeField x, v, load;

  Moved(CellKind kind, int threads) : Moved(body_of(block_of(kind, kind == CellKind::hex24 ? 13 : 72), aluminium()), threads) {}
  Moved(const BodyModel& body, int threads) : elements({body}, body.mesh.dimension, positions_of(body.mesh), {}, threads), x(positions_of(body.mesh)), v(x), load(x) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    for (std::size_t n = 0; n < x.size(); ++n)
      for (int i = 0; i < body.mesh.dimension; ++i) {
        x[n][i] *= 1 + 1e-4 * any(random);
        v[n][i] = any(random);
        load[n][i] = 1e6 * any(random);
      }
    elements.find_forces(x, v, 1e-8, 1e-8);
  }
  NodalForces forces(bool loaded) const {
    NodalForces f = elements.nodal_forces();
    if (loaded) f.load = load.data()->data();
    return f;
  }
};

class Nodes : public testing::TestWithParam<CellKind> {};

TEST_P(Nodes, forces_are_those_of_the_elements_and_the_loads) {
  Moved block(GetParam(), 2), again(GetParam(), 1);
  const std::size_t nodes = block.x.size();
  NodeField internal(nodes), f(nodes);
  again.elements.forces(block.x, block.v, 1e-8, 1e-8, internal);
  for (bool loaded : {false, true}) {
    sum_nodes(block.elements.node_team(), block.forces(loaded), f);
    for (std::size_t n = 0; n < nodes; ++n) {
      const Node whole = loaded ? Node(internal[n] + block.load[n]) : internal[n];
      ASSERT_EQ(f[n], whole) << n;
      ASSERT_EQ(force_on(static_cast<long>(n), block.forces(loaded)), whole) << n;
    }
  }
  EXPECT_GT(internal[nodes / 2].norm(), 0);
}

TEST_P(Nodes, a_kick_is_that_of_the_force) {
  Moved block(GetParam(), 2);
  const Kick kick(3e-8, 2e6);
  EXPECT_DOUBLE_EQ(kick.keep, 0.97 / 1.03);  // a = .03
  EXPECT_DOUBLE_EQ(kick.push, 3e-8 / 1.03);
  NodeField to(block.x.size());
  kick_nodes(block.elements.node_team(), kick, block.v, block.forces(true), block.elements.nodal_mass(), to);
  double least = 1e300;
  for (std::size_t n = 0; n < to.size(); ++n) {
    const Node push = kick.push / block.elements.nodal_mass()[n] * force_on(static_cast<long>(n), block.forces(true));
    ASSERT_LT((to[n] - kick.keep * block.v[n] - push).norm(), 1e-14 * (block.v[n].norm() + push.norm())) << n;
    least = std::min(least, push.norm());
  }
  EXPECT_GT(least, 0);
}

TEST_P(Nodes, kick_and_move_in_one_pass_are_both_one_after_the_other) {
  for (int threads : {1, 2}) {
    Moved block(GetParam(), threads);
    const NodeTeam& team = block.elements.node_team();
    const std::vector<double>& mass = block.elements.nodal_mass();
    const Kick kick(1e-8, 1e6);
    const double dt = 2e-8;
    const auto held = [](long n) { return n % 7 == 0; };
    const NodeField then(block.x.size(), Node(1, 2, 0, 0));
    for (bool looks_back : {false, true}) {
      NodeField x = block.x, v(x.size()), x2 = x, v2 = v;
      kick_nodes(team, kick, block.v, block.forces(false), mass, v);
      for (std::size_t n = 0; n < v.size(); ++n)
        if (held(static_cast<long>(n))) v[n] = x[n];  // as it is before the move
      const double apart = move_nodes(team, dt, v, looks_back ? &then : nullptr, x);
      const auto hold = [&](long first, long last) {
        for (long n = first; n < last; ++n)
          if (held(n)) v2[n] = x2[n];
      };
      EXPECT_EQ(kick_and_move_nodes(team, kick, block.v, block.forces(false), mass, hold, dt, looks_back ? &then : nullptr, v2, x2).apart, apart);
      EXPECT_EQ(v2, v);
      EXPECT_EQ(x2, x);
      double most = 0;
      for (std::size_t n = 0; n < v.size(); ++n) {
        ASSERT_LE((x[n] - block.x[n] - dt * v[n]).norm(), 3e-16 * x[n].norm()) << n;
        most = std::max(most, (v[n] - then[n]).squaredNorm());
      }
      EXPECT_DOUBLE_EQ(apart, looks_back ? most : 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InBothDimensions, Nodes, testing::Values(CellKind::crossed, CellKind::hex24));

}  // namespace
}  // namespace forming_sim
