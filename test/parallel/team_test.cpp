#include "forming_sim/parallel/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>
#include <vector>

namespace forming_sim {
namespace {

TEST(Team, EveryItemOnceInEveryLoop) {
  for (int threads : {1, 2, 3, 7}) {
    Team team(threads);
    EXPECT_EQ(team.size(), threads);
    std::vector<int> times(1001, 0);
    for (int loop = 0; loop < 2000; ++loop)
      team.share(static_cast<long>(times.size()), 1, [&](long first, long last) {
        for (long i = first; i < last; ++i) ++times[i];
      });
    for (int t : times) ASSERT_EQ(t, 2000);
  }
}

TEST(Team, SleepersWake) {
  Team team(3);
  for (int loop = 0; loop < 20; ++loop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(loop % 3));
    std::atomic<long> sum{0};
    team.share(300, 1, [&](long first, long last) { sum += last - first; });
    ASSERT_EQ(sum, 300);
  }
}

/// A thread that stands still in a part of its own is waited for, but what it has not begun is done by the other.
TEST(Team, WhatOneDoesNotGetToTheOtherDoes) {
  Team team(2);
  const std::thread::id caller = std::this_thread::get_id();
  for (int loop = 0; loop < 5; ++loop) {
    std::atomic<int> of_caller{0}, of_other{0};
    team.share(8, 1, [&](long, long) {
      const bool mine = std::this_thread::get_id() == caller;
      ++(mine ? of_caller : of_other);
      const auto given_up = std::chrono::steady_clock::now() + std::chrono::seconds(10);
      while (!mine && of_caller < 7 && std::chrono::steady_clock::now() < given_up) std::this_thread::yield();
    });
    EXPECT_EQ(of_caller + of_other, 8);
    EXPECT_GE(of_caller, 7);
  }
}

/// Of no thread's work, and of nobody's but that: what calls keeps its own way to reckon.
TEST(Team, DenormalsAreZeroInItsLoops) {
  volatile double least = std::numeric_limits<double>::min(), half = 0.5;
  const auto denormal = [&] { return least * half != 0; };
  Team team(3);
  for (const long count : {1, 3000}) {
    std::atomic<int> kept{0};
    team.share(count, 1, [&](long, long) { kept += denormal(); });
    EXPECT_EQ(kept, 0);
    EXPECT_TRUE(denormal());
  }
}

TEST(Team, SmallLoopsStayWhole) {
  Team team(4);
  std::atomic<int> pieces{0};
  team.share(99, 50, [&](long first, long last) { ++pieces; EXPECT_EQ(last - first, 99); });
  EXPECT_EQ(pieces, 1);
  pieces = 0;
  team.share(100, 50, [&](long first, long last) { ++pieces; EXPECT_EQ(last - first, 50); });
  EXPECT_EQ(pieces, 2);
  pieces = 0;
  team.share(12, 1, [&](long first, long last) { ++pieces; EXPECT_EQ(last - first, 1); });
  EXPECT_EQ(pieces, 12);
  team.share(0, 1, [&](long, long) { FAIL(); });
}

}  // namespace
}  // namespace forming_sim
