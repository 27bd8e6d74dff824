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

void sweep_and_mix(int sweeps, int in_a_mixture, const Mixing::Numbers& weight, Team& team, Iteration& iteration) {
  Mixing mixing(team);
  mixing.begin(iteration.x, weight);
  for (int k = 1; k <= sweeps; ++k) {
    iteration.sweep();
    mixing.see(iteration.x);
    if (k % in_a_mixture == 0) mixing.mix(iteration.x);
  }
}

double error_after(int sweeps, int in_a_mixture, Iteration iteration, Team& team) {
  sweep_and_mix(sweeps, in_a_mixture, Mixing::Numbers(iteration.x.size(), 1.0), team, iteration);
  return iteration.error();
}

TEST(Mixing, AFewSlowModesAreGoneSoon) {
  Team one(1);
  for (const int slow : {1, 2, 4}) {
    const Iteration iteration(200, slow);
    Iteration plain = iteration;
    for (int k = 0; k < 30; ++k) plain.sweep();
    EXPECT_GT(plain.error(), 0.7);
    for (const int in_a_mixture : {1, 2, 3}) EXPECT_LT(error_after(30, in_a_mixture, iteration, one), 1e-3) << slow << " " << in_a_mixture;
  }
}

// One number: two sweeps tell where it goes.
TEST(Mixing, OfOneNumberTheAnswerIsTheSecant) {
  Team one(1);
  for (const int in_a_mixture : {1, 2}) EXPECT_NEAR(error_after(2, in_a_mixture, Iteration(1, 1), one), 0, 1e-12);
}

// Measured by the weights: what has none is taken along.
TEST(Mixing, NumbersWithoutWeightFollow) {
  Team one(1);
  Iteration iteration(2, 1);
  iteration.rate[1] = iteration.rate[0];
  sweep_and_mix(2, 2, {1.0, 0.0}, one, iteration);
  EXPECT_NEAR(iteration.error(), 0, 1e-12);
}

// All differences are zero, and then all of them alike.
TEST(Mixing, AtTheAnswerItStays) {
  Team one(1);
  Iteration iteration(100, 3);
  iteration.x = iteration.answer;
  EXPECT_EQ(error_after(20, 1, iteration, one), 0);
}

TEST(Mixing, ThreadsChangeNoBit) {
  Team one(1), two(2);
  constexpr int kCount = 300000;
  Mixing::Numbers found[2];
  for (const int k : {0, 1}) {
    Iteration iteration(kCount, 4);
    sweep_and_mix(9, 2, Mixing::Numbers(kCount, 1.0), k == 0 ? one : two, iteration);
    found[k] = iteration.x;
  }
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
