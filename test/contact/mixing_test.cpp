// Mixing against what it stands for: the answer of a linear iteration, and nothing lost where there is nothing to gain.
#include "forming_sim/contact/mixing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace forming_sim;

/// x <- x* + rate (x - x*), number by number: `slow` of them slow, each by a rate of its own, the others fast.
struct Iteration {
  Mixing::Numbers x, answer, rate;

  Iteration(int count, int slow) {
    for (int i = 0; i < count; ++i) {
      answer.push_back(std::cos(i));
      rate.push_back(i < slow ? 0.99 + 0.002 * i : 0.2 * std::sin(3. * i) * std::sin(3. * i));
      x.push_back(0);
    }
  }
  void sweep() {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = answer[i] + rate[i] * (x[i] - answer[i]);
  }
  double error() const {
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - answer[i]));
    return most;
  }
};

double error_after(int sweeps, Iteration iteration, bool mixed, Team& team) {
  Mixing mixing(team);
  mixing.begin(iteration.x, Mixing::Numbers(iteration.x.size(), 1.0));
  for (int k = 0; k < sweeps; ++k) {
    iteration.sweep();
    if (mixed) mixing.mix(iteration.x);
  }
  return iteration.error();
}

TEST(Mixing, AFewSlowModesAreGoneSoon) {
  Team one(1);
  for (const int slow : {1, 2, 4}) {
    const Iteration iteration(200, slow);
    EXPECT_GT(error_after(30, iteration, false, one), 0.7);
    EXPECT_LT(error_after(30, iteration, true, one), 1e-3) << slow;
  }
}

// One number: two sweeps tell where it goes.
TEST(Mixing, OfOneNumberTheAnswerIsTheSecant) {
  Team one(1);
  EXPECT_NEAR(error_after(2, Iteration(1, 1), true, one), 0, 1e-12);
}

// Measured by the weights: what has none is taken along.
TEST(Mixing, NumbersWithoutWeightFollow) {
  Team one(1);
  Iteration iteration(2, 1);
  iteration.rate[1] = iteration.rate[0];
  Mixing mixing(one);
  mixing.begin(iteration.x, {1.0, 0.0});
  for (int k = 0; k < 2; ++k) {
    iteration.sweep();
    mixing.mix(iteration.x);
  }
  EXPECT_NEAR(iteration.error(), 0, 1e-12);
}

// All differences are zero, and then all of them alike.
TEST(Mixing, AtTheAnswerItStays) {
  Team one(1);
  Iteration iteration(100, 3);
  iteration.x = iteration.answer;
  EXPECT_EQ(error_after(20, iteration, true, one), 0);
}

TEST(Mixing, ThreadsChangeNoBit) {
  Team one(1), two(2);
  constexpr int kCount = 300000;
  Mixing::Numbers found[2];
  for (const int k : {0, 1}) {
    Iteration iteration(kCount, 4);
    Mixing mixing(k == 0 ? one : two);
    mixing.begin(iteration.x, Mixing::Numbers(kCount, 1.0));
    for (int s = 0; s < 9; ++s) {
      iteration.sweep();
      mixing.mix(iteration.x);
    }
    found[k] = iteration.x;
  }
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
