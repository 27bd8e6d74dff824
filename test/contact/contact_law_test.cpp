// The law of one pair: force and potential, the end-of-step root, the bounce.
#include "forming_sim/contact/law.h"

#include <gtest/gtest.h>

#include <random>

#include "contact/point_bodies.h"

using namespace forming_sim;
using contact_test::World;

TEST(ContactLaw, ForceIsMinusTheGradientOfThePotential) {
  for (double h : {1e-3, .05, .3, .7, .95}) {
    const double c = 3, h0 = 1, e = 1e-5 * h;
    const double slope = (mild_potential(h + e, h0, c) - mild_potential(h - e, h0, c)) / (2 * e);
    EXPECT_NEAR(mild_force(h, h0, c), -slope, 1e-8 * mild_force(h, h0, c));
  }
  EXPECT_EQ(mild_force(1, 1, 3), 0);
  EXPECT_EQ(mild_potential(1.1, 1, 3), 0);
}

// Against bisection of h = g + dt^2 w f(h), for parameters over many decades.
TEST(ContactLaw, EndGapSolvesTheImplicitStepAndIsPositive) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decade(-9, 9), part(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double h0 = std::pow(10, decade(random) / 3), c = std::pow(10, decade(random)), w = std::pow(10, decade(random) / 2),
                 dt = std::pow(10, decade(random) / 2 - 3);
    const double g = h0 * (1 - std::pow(10, 6 * part(random) - 3));
    double h;
    const double p = end_impulse(g, h0, c, w, dt, h);
    ASSERT_GT(h, 0);
    ASSERT_LE(h, h0 * (1 + 1e-14));
    ASSERT_GE(p, 0);
    // The quadratic has one sign below the root, the other above.
    const auto q = [&](long double y) { return y * y - (static_cast<long double>(g) - static_cast<long double>(c) * w * dt * dt / h0) * y - static_cast<long double>(c) * w * dt * dt; };
    long double low = 0, high = h0;
    for (int k = 0; k < 200; ++k) (q((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
    ASSERT_NEAR(h, static_cast<double>(high), 1e-7 * static_cast<double>(high)) << g << " " << h0;
  }
  double h;
  EXPECT_EQ(end_impulse(2.0, 1.0, 5.0, 1.0, 1, h), 0);
}

// A body of one row of nodes thrown on a plane: phi = m_A v^2 / (2 E h0) per
// area; closed-form closest approach, contact time and rebound.
TEST(ContactLaw, BounceReachesTheExactValuesInTheLimit) {
  const double phi[] = {.1, .5, 1, 2}, h_min[] = {.616817, .301710, .158594, .052469}, duration[] = {1.150815, 1.959688, 2.227655, 2.303254};
  for (int k = 0; k < 4; ++k) {
    double error[2][3];
    for (int fine = 0; fine < 2; ++fine) {
      World world;
      world.add_strip(Vec3(0, 2.2e-3, 0), 4, 1, 1, 1, 1, 0);
      for (double& m : world.mass) m = 1;
      world.mass[0] = world.mass[4] = 1;  // the end nodes stand for half a cell and half an end face: length 1 each
      world.config.layer = 1e-3;
      const double speed = 2;
      world.config.stiffness = speed * speed / (2 * phi[k] * 1e-3);
      world.config.push_speed = 0.1;
      for (auto& v : world.v) v = Node(0, -speed, 0, 0);
      world.add_plane("plane", Vec3(0, 0, 0), Vec3(0, 1, 0), 0, [](double) { return Vec3(0, 0, 0); });
      Contact contact = world.make();
      const double dt = (fine ? 1e-4 : 2e-4) * 1e-3 / speed;
      double least = 1, touched = 0;
      while (world.v[2][1] < 0 || world.last.active > 0) {
        world.step(contact, dt, false);
        least = std::min(least, world.last.min_gap_over_layer);
        if (world.last.active > 0) touched += dt;
        ASSERT_LT(world.time, 1);
      }
      error[fine][0] = std::abs(least - h_min[k]) / h_min[k];
      error[fine][1] = std::abs(touched * speed / 1e-3 - duration[k]) / duration[k];
      error[fine][2] = std::abs(world.v[2][1] / speed - 1);
      EXPECT_LE(world.v[2][1], speed);  // never gains
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(error[1][i], 4e-3) << "phi " << phi[k] << " value " << i;
      EXPECT_LT(error[1][i], .7 * error[0][i] + 2e-4) << "does not converge: phi " << phi[k] << " value " << i;
    }
  }
}
