// The sweeps over pairs in lanes and colours: what they leave is the law of every
// pair at the end of the step, and does not depend on threads or vector width.
#include <gtest/gtest.h>

#include <random>

#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/law.h"
#include "forming_sim/contact/sweeps.h"

namespace {
using namespace forming_sim;

constexpr double kDt = 1e-3;

/// Pairs between random nodes, half of which rub; some nodes held, some of a tool.
struct Heap {
  Workspace work;
  LargeArray<ContactPair> pairs;
  std::vector<Rub> rubs;
  Mat3 held = Vec3(1, 0, 1).asDiagonal();

  Heap(int nodes, int count, bool hub, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(0, 1);
    work.body_entries = nodes - nodes / 4;
    for (int i = 0; i < nodes; ++i) {
      const bool tool = i >= work.body_entries;
      work.vertex.push_back(i);
      work.v.push_back(Node(number(random) - 0.5, number(random) - 0.5, number(random) - 0.5, 0));
      work.projector.push_back(!tool && i % 7 == 3 ? &held : nullptr);
      work.share.push_back({tool ? 0 : 1 / (0.5 + number(random)), 0, tool ? 0. : 1., work.projector.back() ? 1. : 0.});
    }
    for (int i = 0; i < count; ++i) {
      ContactPair pair;
      pair.nodes = 2 + static_cast<int>(3 * number(random));
      const int first = hub ? 0 : static_cast<int>(number(random) * work.body_entries);
      double left = 1;
      for (int k = 0; k < pair.nodes; ++k) {
        do pair.node[k] = k == 0 ? first : static_cast<int>(number(random) * nodes);
        while (std::count(pair.node, pair.node + k, pair.node[k]) > 0);
        pair.weight[k] = k == 0 ? 1 : k + 1 == pair.nodes ? -left : -left * number(random);
        if (k > 0) left += pair.weight[k];
      }
      pair.normal = node(Vec3(number(random) - 0.5, number(random) - 0.5, number(random) - 0.5).normalized());
      pair.layer = 1e-4;
      pair.gap = pair.layer * (0.2 + 2 * number(random));
      pair.stiffness = 1e-3;
      double any = 0;
      for (int k = 0; k < pair.nodes; ++k) {
        const int n = pair.node[k];
        const Share& share = work.share[n];
        const double b2m = pair.weight[k] * pair.weight[k] * share.inverse_mass;
        any += b2m;
        pair.w += work.projector[n] ? b2m * pair.normal.dot(project(*work.projector[n], pair.normal)) : b2m;
        if (share.inverse_mass > 0) pair.movers |= 1 << k;
        pair.held = pair.held || work.projector[n];
      }
      if (i % 2) {
        pair.rub = static_cast<int>(rubs.size());
        rubs.push_back({Node::Zero(), 0.3, any});
      }
      pairs.push_back(pair);
    }
  }
  SweepResult solve(Team* team, const char* kernels, double tolerance, int most) {
    std::vector<TiePair> ties;
    Team one(1);
    Sweeps sweeps(team ? *team : one, kernels);
    std::vector<DrivenTool> none_driven;
    const SweepResult result = sweeps.solve(kDt, tolerance, most, work, ties, pairs, rubs, none_driven);
    sweeps.take_back(0, static_cast<long>(pairs.size()), pairs, rubs);
    return result;
  }
};

void expect_law_at_the_end(const Heap& heap) {
  long pressed = 0, sliding = 0, sticking = 0;
  for (const ContactPair& pair : heap.pairs) {
    const Node u = relative(pair, heap.work.v);
    const double h = pair.gap + kDt * pair.normal.dot(u);
    EXPECT_NEAR(pair.end_gap, h, 1e-13);
    ASSERT_GT(h, 0);
    const double p = kDt * mild_force(h, pair.layer, pair.stiffness);
    EXPECT_NEAR(pair.impulse, p, 1e-6 * p + 1e-9);
    pressed += p > 0;
    if (pair.rub < 0 || p == 0) continue;
    const Rub& rub = heap.rubs[pair.rub];
    const Vec3 slip = vec3(u - pair.normal.dot(u) * pair.normal), q = vec3(rub.slip);
    ASSERT_LE(q.norm(), rub.friction * pair.impulse * (1 + 1e-9));
    if (slip.norm() > 1e-5) {  // sliding: at the cone's edge, against the slip
      ++sliding;
      EXPECT_NEAR(q.norm(), rub.friction * pair.impulse, 1e-9);
      EXPECT_NEAR(q.dot(slip), -q.norm() * slip.norm(), 1e-3 * q.norm() * slip.norm() + 1e-12);
    } else {
      ++sticking;
    }
  }
  EXPECT_GT(pressed, 10);
  EXPECT_GT(sliding, 0);
  EXPECT_GT(sticking, 0);
}

TEST(ContactSweeps, EveryPairEndsOnItsLaw) {
  for (const char* kernels : {"sse2", static_cast<const char*>(nullptr)}) {
    Heap heap(400, 150, false, 5);
    EXPECT_TRUE(heap.solve(nullptr, kernels, 1e-13, 20000).open);
    expect_law_at_the_end(heap);
  }
}

void expect_impulses_made_the_velocities(Heap& heap, int sweeps) {
  NodeField expected = heap.work.v;
  EXPECT_EQ(heap.solve(nullptr, nullptr, 0, sweeps).sweeps, sweeps);
  long pressed = 0;
  for (const ContactPair& pair : heap.pairs) {
    pressed += pair.impulse > 0;
    push(pair, pair.impulse * pair.normal, heap.work, expected);
    if (pair.rub >= 0) push(pair, heap.rubs[pair.rub].slip, heap.work, expected);
  }
  EXPECT_GT(pressed, 10);
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR((expected[i] - heap.work.v[i]).norm(), 0, 1e-9);
    EXPECT_EQ(heap.work.v[i][3], 0);
  }
}

TEST(ContactSweeps, ImpulsesAreWhatTheVelocitiesGot) {
  for (const int sweeps : {3, 12, 13}) {  // before any are mixed, and after some were
    Heap heap(400, 150, false, 7);
    expect_impulses_made_the_velocities(heap, sweeps);
  }
}

// Nor are there as many colours as tiles that share it.
TEST(ContactSweeps, ANodeInMorePairsThanATileHasPacks) {
  Heap heap(4000, 30000, true, 6);
  expect_impulses_made_the_velocities(heap, 3);
}

// Started from its own answer, a second solution is there at once.
TEST(ContactSweeps, StartsFromTheImpulsesThatItIsGiven) {
  Heap first(400, 150, false, 5), again(400, 150, false, 5);
  const int cold = first.solve(nullptr, nullptr, 1e-10, 20000).sweeps;
  for (size_t i = 0; i < first.pairs.size(); ++i) {
    again.pairs[i].impulse = first.pairs[i].impulse;
    if (first.pairs[i].rub >= 0) again.rubs[first.pairs[i].rub].slip = first.rubs[first.pairs[i].rub].slip;
  }
  const int warm = again.solve(nullptr, nullptr, 1e-10, 20000).sweeps;
  EXPECT_GT(cold, 5);
  EXPECT_LE(warm, 2);
  for (size_t i = 0; i < again.pairs.size(); ++i) EXPECT_NEAR(again.pairs[i].end_gap, first.pairs[i].end_gap, 1e-9);
}

// A row of nodes on a ridge: two edges from each node cross it near that node, so that what one of the pair loses the other gains.
TEST(ContactSweeps, PairsThatHoldTheSameNodeShareSoon) {
  Heap heap(41, 0, false, 1);
  heap.work.body_entries = 40;
  for (Node& v : heap.work.v) v = Node(0, 0, -0.05, 0);
  heap.work.v[40].setZero();
  for (int i = 0; i < 41; ++i) {
    heap.work.share[i] = {i < 40 ? 1. : 0., 0, i < 40 ? 1. : 0., 0};
    heap.work.projector[i] = nullptr;
  }
  for (int i = 1; i < 39; ++i)
    for (const int neighbour : {i - 1, i + 1}) {
      ContactPair pair;
      pair.link({i, neighbour, 40}, 0.94, 0.06, -1);
      pair.normal = Node(0, 0, 1, 0);
      pair.layer = 1e-4;
      pair.gap = 0.9 * pair.layer * (1 + 1e-3 * (neighbour - i));
      pair.stiffness = 1e-1;
      pair.w = 0.94 * 0.94 + 0.06 * 0.06;
      pair.movers = 3;
      heap.pairs.push_back(pair);
    }
  constexpr double kTolerance = 1e-9;
  const SweepResult result = heap.solve(nullptr, nullptr, kTolerance, 1000);
  EXPECT_TRUE(result.open);
  EXPECT_LT(result.sweeps, 15);  // without being mixed: 47
  for (const ContactPair& pair : heap.pairs) {
    const double h = pair.gap + kDt * pair.normal.dot(relative(pair, heap.work.v)), p = kDt * mild_force(h, pair.layer, pair.stiffness);
    EXPECT_GT(pair.impulse, 0);
    EXPECT_NEAR(pair.impulse, p, 1e-3 * p);
  }
}

// They bear nothing, are told where they end, and leave the others alone.
TEST(ContactSweeps, PairsThatNothingMoves) {
  Heap heap(400, 150, false, 5);
  const long count = static_cast<long>(heap.pairs.size());
  const int tool = heap.work.body_entries;
  for (int i = 0; i < 20; ++i) {
    ContactPair still = heap.pairs[0];
    still.link({tool + i, tool + i + 1}, 1, -1);
    still.w = 0;
    still.movers = 0;
    still.held = 0;
    still.rub = -1;
    still.impulse = 1;
    heap.pairs.push_back(still);
  }
  EXPECT_TRUE(heap.solve(nullptr, nullptr, 1e-13, 20000).open);
  for (long i = count; i < static_cast<long>(heap.pairs.size()); ++i) {
    const ContactPair& still = heap.pairs[i];
    EXPECT_EQ(still.impulse, 0);
    EXPECT_NEAR(still.end_gap, still.gap + kDt * still.normal.dot(relative(still, heap.work.v)), 1e-15);
  }
  heap.pairs.resize(count);
  expect_law_at_the_end(heap);
}

TEST(ContactSweeps, ThreadsChangeNoBit) {
  Team two(2);
  Heap a(60000, 40000, false, 8), b(60000, 40000, false, 8);
  a.solve(nullptr, nullptr, 0, 14);  // mixed from the fourth on
  b.solve(&two, nullptr, 0, 14);
  for (size_t i = 0; i < a.pairs.size(); ++i) {
    ASSERT_EQ(a.pairs[i].impulse, b.pairs[i].impulse) << "pair " << i;
    ASSERT_EQ(a.pairs[i].end_gap, b.pairs[i].end_gap) << "pair " << i;
  }
  for (size_t i = 0; i < a.work.v.size(); ++i) ASSERT_EQ(a.work.v[i], b.work.v[i]) << "node " << i;
}

TEST(ContactSweeps, VectorWidthsAgreeToRounding) {
  Heap narrow(400, 150, false, 9), wide(400, 150, false, 9);
  narrow.solve(nullptr, "sse2", 0, 5);
  wide.solve(nullptr, nullptr, 0, 5);
  for (size_t i = 0; i < narrow.pairs.size(); ++i)
    EXPECT_NEAR(narrow.pairs[i].impulse, wide.pairs[i].impulse, 1e-9 * narrow.pairs[i].impulse + 1e-15);
}

}  // namespace
