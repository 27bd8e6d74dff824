// Curves and profiles: values, slopes against finite differences, integrals
// against quadrature, smoothness at the knots, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/curve.h"
#include "forming_sim/loads/profile.h"

namespace forming_sim {
namespace {

const std::vector<double> kTimes{0.5e-3, 1e-3, 2.5e-3, 3e-3};
const std::vector<Vec3> kValues{{1, 0, -1}, {4, 2, 0}, {-2, 5, 1}, {0, 5, 1}};

using Builder = Curve (*)(const std::vector<double>&, const std::vector<Vec3>&);
struct Shape {
  const char* name;
  Builder build;
};
const Shape kShapes[] = {{"linear", Curve::linear},
                         {"cubic", Curve::cubic},
                         {"quintic", Curve::quintic},
                         {"spline", Curve::spline}};

TEST(Curve, meets_its_knots_and_is_level_outside) {
  for (const Shape& shape : kShapes) {
    const Curve curve = shape.build(kTimes, kValues);
    for (size_t k = 0; k < kTimes.size(); ++k)
      EXPECT_LT((curve.at(kTimes[k]) - kValues[k]).norm(), 1e-14) << shape.name << " knot " << k;
    EXPECT_EQ(curve.at(0), kValues.front()) << shape.name;
    EXPECT_EQ(curve.at(1), kValues.back()) << shape.name;
    EXPECT_EQ(curve.slope(0), Vec3::Zero()) << shape.name;
    EXPECT_EQ(curve.slope(1), Vec3::Zero()) << shape.name;
  }
}

TEST(Curve, slope_is_the_derivative) {
  const double h = 1e-9;
  for (const Shape& shape : kShapes) {
    const Curve curve = shape.build(kTimes, kValues);
    for (double t = 0.51e-3; t < 3e-3; t += 0.083e-3) {
      const Vec3 difference = (curve.at(t + h) - curve.at(t - h)) / (2 * h);
      EXPECT_LT((curve.slope(t) - difference).norm(), 1e-5 * (difference.norm() + 1e3))
          << shape.name << " t " << t;
    }
  }
}

TEST(Curve, linear_and_quintic_have_their_closed_forms_in_the_middle) {
  // Half way: half the rise; the quintic is then 15/8 times as fast as the mean.
  const Vec3 rise = kValues[1] - kValues[0];
  const double middle = 0.75e-3, span = 0.5e-3;
  for (Builder build : {Curve::linear, Curve::cubic, Curve::quintic})
    EXPECT_LT((build(kTimes, kValues).at(middle) - kValues[0] - 0.5 * rise).norm(), 1e-14);
  EXPECT_LT((Curve::quintic(kTimes, kValues).slope(middle) - 15.0 / 8 * rise / span).norm(),
            1e-9 * rise.norm() / span);
  EXPECT_LT((Curve::cubic(kTimes, kValues).slope(middle) - 1.5 * rise / span).norm(),
            1e-9 * rise.norm() / span);
}

TEST(Curve, smooth_shapes_rest_at_every_knot) {
  const double e = 1e-10;
  for (size_t k = 0; k < kTimes.size(); ++k)
    for (double side : {-e, e}) {
      // A cubic's slope grows like 6 rise e/T^2, a quintic's like 30 rise e^2/T^3.
      EXPECT_LT(Curve::cubic(kTimes, kValues).slope(kTimes[k] + side).norm(), 0.05);
      EXPECT_LT(Curve::quintic(kTimes, kValues).slope(kTimes[k] + side).norm(), 1e-6);
    }
}

TEST(Curve, spline_keeps_slope_and_curvature_and_does_not_stop) {
  const Curve curve = Curve::spline(kTimes, kValues);
  const double e = 1e-9;
  for (size_t k = 1; k + 1 < kTimes.size(); ++k) {
    const double t = kTimes[k];
    const Vec3 left = curve.slope(t - e), right = curve.slope(t + e);
    EXPECT_GT(right.norm(), 100);
    EXPECT_LT((left - right).norm(), 1e-3 * right.norm());
    const Vec3 bend_left = (left - curve.slope(t - 2 * e)) / e,
               bend_right = (curve.slope(t + 2 * e) - right) / e;
    EXPECT_LT((bend_left - bend_right).norm(), 1e-3 * bend_right.norm() + 1e3);
  }
  EXPECT_LT(curve.slope(kTimes.front()).norm(), 1e-9);
  EXPECT_LT(curve.slope(kTimes.back() - 1e-12).norm(), 1e-2);
}

TEST(Curve, spline_through_a_cubic_at_rest_at_its_ends_is_that_cubic) {
  std::vector<Vec3> values;
  for (double t : kTimes) {
    const double u = (t - kTimes.front()) / (kTimes.back() - kTimes.front());
    values.push_back(Vec3(1, -2, 0.5) * (3 - 2 * u) * u * u);
  }
  const Curve curve = Curve::spline(kTimes, values);
  for (double u = 0; u <= 1; u += 0.05) {
    const double t = kTimes.front() + u * (kTimes.back() - kTimes.front());
    EXPECT_LT((curve.at(t) - Vec3(1, -2, 0.5) * (3 - 2 * u) * u * u).norm(), 1e-13);
  }
}

TEST(Curve, integral_is_exact_inside_and_outside) {
  for (Builder build : {Curve::linear, Curve::cubic, Curve::spline}) {
    const Curve curve = build(kTimes, kValues);
    const Curve sum = curve.integral(0);
    EXPECT_LT(sum.at(0).norm(), 1e-18);
    // Simpson over pieces no longer than a piece of the curve is exact for cubics.
    Vec3 expected = kTimes.front() * kValues.front();
    for (size_t k = 0; k + 1 < kTimes.size(); ++k) {
      const double a = kTimes[k], b = kTimes[k + 1];
      expected += (b - a) / 6 * (curve.at(a) + 4 * curve.at(0.5 * (a + b)) + curve.at(b));
      EXPECT_LT((sum.at(b) - expected).norm(), 1e-17 + 1e-13 * expected.norm());
    }
    EXPECT_LT((sum.at(5e-3) - expected - 2e-3 * kValues.back()).norm(), 1e-15);
    EXPECT_EQ(sum.slope(0.1e-3), kValues.front());
    EXPECT_EQ(sum.slope(9e-3), kValues.back());
    for (double t : {0.7e-3, 1.9e-3, 2.6e-3}) EXPECT_LT((sum.slope(t) - curve.at(t)).norm(), 1e-12);
  }
  EXPECT_THROW(Curve::quintic(kTimes, kValues).integral(0), Error);
}

TEST(Curve, no_knot_is_zero_and_one_knot_is_constant) {
  EXPECT_EQ(Curve().at(3), Vec3::Zero());
  for (const Shape& shape : kShapes) {
    const Curve curve = shape.build({2}, {Vec3(1, 2, 3)});
    for (double t : {0.0, 2.0, 4.0}) EXPECT_EQ(curve.at(t), Vec3(1, 2, 3)) << shape.name;
  }
  EXPECT_LT((Curve::linear({2}, {Vec3(1, 2, 3)}).integral(0).at(5) - Vec3(5, 10, 15)).norm(), 1e-14);
}

TEST(Curve, refuses_knots_that_mean_nothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Curve::linear({0, 0}, {Vec3::Zero(), Vec3::Ones()}), Error);
  EXPECT_THROW(Curve::linear({1, 0}, {Vec3::Zero(), Vec3::Ones()}), Error);
  EXPECT_THROW(Curve::linear({0, nan}, {Vec3::Zero(), Vec3::Ones()}), Error);
  EXPECT_THROW(Curve::linear({0, 1}, {Vec3::Zero(), Vec3(0, nan, 0)}), Error);
  try {
    Curve::linear({0, 1, 2}, {Vec3::Zero()});
    FAIL() << "three times with one value were taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::invalid_scene);
    EXPECT_NE(std::string(error.what()).find("3 knots with 1 values"), std::string::npos) << error.what();
  }
}

TEST(ScalarProfile, is_piecewise_linear_and_level_outside) {
  const ScalarProfile pulse({1, 2, 4}, {0, 10, 6});
  EXPECT_DOUBLE_EQ(pulse.at(0), 0);
  EXPECT_DOUBLE_EQ(pulse.at(1.25), 2.5);
  EXPECT_DOUBLE_EQ(pulse.at(3), 8);
  EXPECT_DOUBLE_EQ(pulse.at(9), 6);
}

TEST(VelocityProfile, displacement_is_the_integral_of_the_velocity) {
  for (const char* shape : {"linear", "smooth"}) {
    const VelocityProfile profile(kTimes, kValues, shape);
    const double a = 0.2e-3, b = 3.7e-3;
    const int n = 200000;
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < n; ++k) sum += (b - a) / n * profile.at(a + (b - a) * (k + 0.5) / n);
    EXPECT_LT((profile.displacement(a, b) - sum).norm(), 1e-9 * sum.norm()) << shape;
    EXPECT_LT((profile.displacement(b, a) + sum).norm(), 1e-9 * sum.norm()) << shape;
  }
  EXPECT_THROW(VelocityProfile(kTimes, kValues, "spline"), Error);
}

}  // namespace
}  // namespace forming_sim
