// What a tie of surfaces that do not touch asks of its nodes: the gradient of what it keeps, and so no moment and no energy.
#include "forming_sim/contact/ties.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "contact/point_bodies.h"

namespace contact_test {
namespace {

struct Kind {
  const char* name;
  int nodes;
  double weight[4];
};
constexpr Kind kKinds[] = {{"a vertex on an edge, in the plane", 3, {1, -.3, -.7}}, {"a vertex on a facet", 4, {1, -.2, -.5, -.3}}, {"an edge on an edge", 4, {.4, .6, -.7, -.3}}};

/// A tie of nodes anywhere, apart by some tenth of their distances.
struct Apart {
  Tie tie;
  TiePair pair;
  Workspace work;
  std::vector<ToolMotion> no_tools;

  Apart(const Kind& kind, std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const bool flat = kind.nodes == 3;
    const auto vector = [&] { return Vec3(any(random), any(random), flat ? 0 : any(random)); };
    tie.nodes = kind.nodes;
    std::copy(kind.weight, kind.weight + 4, tie.weight);
    tie.kept = .1 * vector();
    const int entries[4] = {0, 1, 2, 3};
    for (int k = 0; k < 4; ++k) {
      work.x.push_back(node(vector()));
      work.v.push_back(node(vector()));
      Share share;
      share.inverse_mass = 1.5 + any(random);
      work.share.push_back(share);
      work.projector.push_back(nullptr);
    }
    pair = link_tie(tie, 0, entries);
    prepare_tie(work, pair);
    aim();
  }
  void aim() { aim_tie(tie, work, no_tools, pair); }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < tie.nodes; ++k) sum += vec3(work.v[k]) / work.share[k].inverse_mass;
    return sum;
  }
  double energy() const {
    double sum = 0;
    for (int k = 0; k < tie.nodes; ++k) sum += vec3(work.v[k]).squaredNorm() / (2 * work.share[k].inverse_mass);
    return sum;
  }
  Vec3 moment_of_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < tie.nodes; ++k) sum += vec3(work.x[k]).cross(vec3(work.v[k])) / work.share[k].inverse_mass;
    return sum;
  }
};

}  // namespace

TEST(Ties, SeeTheMotionOfWhatTheyKeep) {
  std::mt19937 random(5);
  for (const Kind& kind : kKinds)
    for (int trial = 0; trial < 20; ++trial) {
      Apart tie(kind, random);
      ASSERT_TRUE(tie.pair.apart);
      const Vec3 seen = vec3(relative(tie.pair, tie.work.v));
      constexpr double kStep = 1e-6;
      const auto missing_after = [&](double dt) {
        Apart moved = tie;
        for (int k = 0; k < 4; ++k) moved.work.x[k] += dt * moved.work.v[k];
        moved.aim();
        return vec3(moved.pair.missing);
      };
      const Vec3 found = (missing_after(-kStep) - missing_after(kStep)) / (2 * kStep);
      EXPECT_LT((seen - found).norm(), 1e-6 * (1 + seen.norm())) << kind.name;
    }
}

// A visit ends the motion of what is kept, leaves momentum and its moment, and gives no energy.
TEST(Ties, PushWithoutAMoment) {
  std::mt19937 random(6);
  for (const Kind& kind : kKinds)
    for (int trial = 0; trial < 20; ++trial) {
      Apart tie(kind, random);
      for (int k = 0; k < 100; ++k) {
        tie.work.x[0] += tie.pair.missing / tie.tie.weight[0];  // to where it is kept
        tie.aim();
      }
      ASSERT_LT(tie.pair.missing.norm(), 1e-12);
      const Vec3 momentum = tie.momentum(), moment = tie.moment_of_momentum();
      const double energy = tie.energy();
      sweep_tie(1, tie.work, tie.pair);
      EXPECT_LT(vec3(relative(tie.pair, tie.work.v)).norm(), 1e-9) << kind.name;
      EXPECT_LT((tie.momentum() - momentum).norm(), 1e-12) << kind.name;
      EXPECT_LT((tie.moment_of_momentum() - moment).norm(), 1e-10) << kind.name;
      EXPECT_LT(tie.energy(), energy) << kind.name;
    }
}

// Two strips, and two plates, a tenth of a cell apart. By the weights of the ties alone the plates had 2e5 times their energy after as many steps.
TEST(Ties, OfSurfacesThatDoNotTouchGiveNoEnergy) {
  for (const int dimension : {2, 3}) {
    World world;
    world.dimension = dimension;
    world.config.layer = 1e-4;
    if (dimension == 2) {
      world.add_strip(Vec3(0, 0, 0), 10, 4, .1, .1, 2800, 2e9);
      world.add_strip(Vec3(.15, .41, 0), 10, 3, .07, .1, 2800, 2e9);
    } else {
      world.add_box(Vec3(0, 0, 0), 6, 5, 1, .12, 2700, 2e9);
      world.add_box(Vec3(.05, .05, .13), 6, 5, 1, .1, 2700, 2e9);
    }
    PairConfig together;
    together.first = "body0", together.second = "body1", together.kind = "tied";
    together.tie_distance = .02;
    world.config.pairs = {together};
    Contact contact = world.make();
    for (size_t i = 0; i < world.x.size(); ++i) {
      const double x = world.x[i][0], y = world.x[i][1];
      world.v[i] = Node(-2 * y, 2 * x + std::sin(7 * x), dimension == 3 ? std::cos(5 * x + 3 * y) : 0, 0);
    }
    const double given = world.kinetic();
    const Vec3 turned = world.angular_momentum();
    double most = 0;
    for (int i = 0; i < 5000; ++i) {
      world.step(contact, 1e-5, i % 500 == 0);
      most = std::max(most, world.kinetic());
    }
    std::printf("  %dD: at most %.4f of the energy, moment of momentum off by %.1e\n", dimension, most / given, (world.angular_momentum() - turned).norm() / turned.norm());
    EXPECT_LT(most, 1.01 * given);
    EXPECT_LT((world.angular_momentum() - turned).norm(), 1e-8 * turned.norm());
  }
}

/// A workspace of so many nodes of bodies, then of tools, and ties between them.
struct Doubled {
  Workspace work;
  std::vector<TiePair> ties;
  std::vector<bool> told;

  Doubled(int of_bodies, std::vector<bool> of_tools) : told(std::move(of_tools)) {
    work.body_entries = of_bodies;
    Share free;
    free.inverse_mass = 1;
    work.share.assign(of_bodies + told.size(), free);
    work.projector.assign(work.share.size(), nullptr);
  }
  /// Node a on a tool, at entry b.
  void to_tool(int a, int b) {
    tie({a, b}, {1, -1});
    ties.back().to_tool = true;
  }
  void tie(const std::vector<int>& nodes, const std::vector<double>& weights) {
    TiePair pair;
    pair.nodes = static_cast<int>(nodes.size());
    std::copy(nodes.begin(), nodes.end(), pair.node);
    std::copy(weights.begin(), weights.end(), pair.weight);
    pair.tie = static_cast<int>(ties.size());
    ties.push_back(pair);
  }
  std::vector<int> taken_out() {
    std::vector<int> numbers;
    for (const TiePair& pair : take_out_doubled(work, told, ties)) numbers.push_back(pair.tie);
    return numbers;
  }
};

TEST(ties, of_a_node_on_two_tools_the_second_is_left_out) {
  Doubled two(3, {true, true});
  two.to_tool(0, 3);
  two.to_tool(1, 3);
  two.to_tool(0, 4);
  EXPECT_EQ(two.taken_out(), std::vector<int>{2});
  EXPECT_EQ(two.ties.size(), 2u);
}

TEST(ties, to_a_tool_that_a_force_drives_all_hold) {
  Doubled driven(2, {true, false});
  driven.to_tool(0, 2);
  driven.to_tool(0, 3);
  EXPECT_TRUE(driven.taken_out().empty());
}

TEST(ties, what_boundaries_hold_is_held) {
  Doubled held(3, {true});
  held.work.fixed = {0, 1};
  held.to_tool(0, 3);               // on a tool what a boundary holds
  held.tie({2, 0, 1}, {1, -.5, -.5});  // holds node 2
  held.to_tool(2, 3);               // comes first all the same
  EXPECT_EQ(held.taken_out(), (std::vector<int>{0, 1}));
}

TEST(ties, a_chain_is_followed_to_its_end) {
  Doubled chain(4, {true, true});
  chain.tie({4, 0, 1}, {1, -.5, -.5});  // a tool's vertex on the edge of 0 and 1: open until 0 is told
  chain.tie({2, 1}, {1, -1});
  chain.tie({3, 2}, {1, -1});
  chain.tie({5, 3, 2}, {1, -.5, -.5});  // by then 2 and 3 follow
  chain.to_tool(0, 4);
  EXPECT_EQ(chain.taken_out(), std::vector<int>{3});
}

TEST(ties, a_node_of_next_to_no_weight_does_not_count) {
  Doubled grazing(2, {true});
  grazing.work.fixed = {0};
  grazing.tie({2, 0, 1}, {1, -(1 - 1e-6), -1e-6});
  EXPECT_EQ(grazing.taken_out(), std::vector<int>{0});
}

}  // namespace contact_test
