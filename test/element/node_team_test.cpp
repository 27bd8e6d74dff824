// Loops over nodes that threads share: every node once, in the order of where their cells lie.
#include <gtest/gtest.h>

#include <mutex>
#include <vector>

#include "forming_sim/element/node_team.h"

using namespace forming_sim;

TEST(NodeTeam, GoesThroughEveryNodeOnce) {
  for (int threads : {1, 2, 3})
    for (long nodes : {0L, 1L, 127L, 128L, 129L, 5000L, 20001L})
      for (bool cells_are_shared : {false, true}) {
        Team team(threads);
        std::vector<long> place(nodes);
        for (long n = 0; n < nodes; ++n) place[n] = (n * 7919) % (nodes + 1);
        const NodeTeam by_place(team, place, cells_are_shared), by_number(team, nodes);
        for (const NodeTeam* loop : {&by_place, &by_number}) {
          std::vector<int> seen(nodes, 0);
          loop->share([&](long first, long last) {
            ASSERT_LE(last - first, NodeTeam::kPart);
            for (long n = first; n < last; ++n) ++seen[n];
          });
          EXPECT_EQ(seen, std::vector<int>(nodes, 1)) << threads << " threads, " << nodes;
          EXPECT_EQ(loop->largest([&](long, long last) { return static_cast<double>(last); }), static_cast<double>(nodes));
          EXPECT_EQ(loop->largest([](long, long) { return -1.0; }), 0);
        }
      }
}

// Corners first and then the middles of the cells, as blocks number them: a share of the cells has some of both.
TEST(NodeTeam, TakesThemInTheOrderOfTheirCells) {
  Team team(1);
  constexpr long kHalf = 4 * NodeTeam::kPart;
  std::vector<long> place;
  for (int kind = 0; kind < 2; ++kind)
    for (long n = 0; n < kHalf; ++n) place.push_back(2 * n + kind);
  std::vector<long> firsts;
  NodeTeam(team, place, true).share([&](long first, long) { firsts.push_back(first); });
  const long p = NodeTeam::kPart;
  EXPECT_EQ(firsts, (std::vector<long>{0, kHalf, p, kHalf + p, 2 * p, kHalf + 2 * p, 3 * p, kHalf + 3 * p}));
}
