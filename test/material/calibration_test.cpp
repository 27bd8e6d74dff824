// Layers from a measured curve: the weights and yields of VERIFICATION 3, the layers of
// 6111-T4, the way forth and back, and curves that no layers can follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/material/calibration.h"

namespace forming_sim {
namespace {

/// Points from plastic strains and stresses in MPa.
std::vector<CurvePoint> curve_of(double E, const std::vector<double>& plastic, const std::vector<double>& megapascals) {
  std::vector<CurvePoint> curve;
  for (std::size_t k = 0; k < plastic.size(); ++k) curve.push_back({plastic[k] + 1e6 * megapascals[k] / E, 1e6 * megapascals[k]});
  return curve;
}
const std::vector<double> kPlastic{0, .002, .01, .03, .08, .20}, kStress{160, 180, 210, 250, 300, 340};

/// Small-strain layers in tension with free sides: each follows 2 mu g within its yield
/// (src/material/calibration.cpp).
class SmallStrainLayers {
 public:
  SmallStrainLayers(double E, double nu, std::vector<LayerConfig> layers) : E_(E), nu_(nu), layers_(std::move(layers)), at_(layers_.size(), 0.0) {}

  /// Moves to a strain, in one step as every layer is perfectly plastic; the stress, Pa.
  double move(double strain) {
    double low = -1e12, high = 1e12;  // of the change of 2 mu g: the strain grows with it
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (strain_after(middle) < strain ? low : high) = middle;
    }
    const double sigma = stress_after(low);
    for (std::size_t k = 0; k < at_.size(); ++k) at_[k] = layer_after(k, low);
    from_ += low;
    return sigma;
  }

 private:
  double layer_after(std::size_t k, double change) const {
    const double Y = layers_[k].hardening->yield_stress;
    return std::clamp(at_[k] + change, -Y, Y);
  }
  double stress_after(double change) const {
    double sum = 0;
    for (std::size_t k = 0; k < at_.size(); ++k) sum += layers_[k].weight * layer_after(k, change);
    return sum;
  }
  double strain_after(double change) const { return (2 * (1 + nu_) * (from_ + change) + (1 - 2 * nu_) * stress_after(change)) / (3 * E_); }

  double E_, nu_, from_ = 0;
  std::vector<LayerConfig> layers_;
  std::vector<double> at_;
};

TEST(Calibration, WeightsAndYieldsOfTheVerifiedCurve) {
  const auto layers = calibrate_layers(70500e6, .34, curve_of(70500e6, kPlastic, kStress));
  const double weight[] = {.88753672, .06710106, .02064581, .01220357, .00830681, .00420603};
  const double yield[] = {160, 337.83582, 999.17910, 2617.53731, 6613.43284, 16123.58209};
  ASSERT_EQ(layers.size(), 6u);
  double sum = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(layers[k].weight, weight[k], 5.1e-9) << k;
    EXPECT_NEAR(layers[k].hardening->yield_stress / 1e6, yield[k], 5.1e-6) << k;
    EXPECT_EQ(layers[k].hardening->curve, "perfect");
    sum += layers[k].weight;
  }
  EXPECT_NEAR(sum, 1, 1e-15);
}

TEST(Calibration, LayersPassThroughThePointsAndUnloadByMasing) {
  const double E = 70500e6;
  const auto curve = curve_of(E, kPlastic, kStress);
  const auto layers = calibrate_layers(E, .34, curve);
  SmallStrainLayers there(E, .34, layers);
  for (const CurvePoint& p : curve) EXPECT_NEAR(there.move(p.strain), p.stress, 1e-9 * p.stress);

  SmallStrainLayers forth(E, .34, layers);
  EXPECT_NEAR(forth.move(.05) / 1e6, 266.2237762, 5.1e-8);
  const double back[] = {.003, .006, .02, .05, .1}, expected[] = {54.72378, -66.57125, -132.56410, -200.53484, -266.22378};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(forth.move(.05 - back[k]) / 1e6, expected[k], 5.1e-6) << back[k];
}

// From an independent program, for 429.8 - 237.7 exp(-8.504 p) MPa; its stresses are
// rounded to 1e-6 MPa, hence the bound on the weights.
TEST(Calibration, FourteenLayersOfVoce6111) {
  const std::vector<double> plastic{0, .001, .003, .006, .01, .02, .04, .07, .11, .16, .23, .32, .45, .65};
  const double weight[] = {.9751289794, .0003072799, .0005039274, .0006885930, .0013154021, .0025727182, .0036489747,
                           .0040034805, .0037095469, .0031945396, .0024014127, .0015064799, .0007506151, .0002680507};
  const double yield[] = {192.100000,   273.030741,   434.841232,    677.431644,    1000.657468,   1807.635125,   3417.355680,
                          5822.984014, 9017.493540, 12995.696438, 18547.300471, 25667.892944, 35937.682786, 51725.496810};
  std::vector<double> stress;
  for (double p : plastic) stress.push_back(429.8 - 237.7 * std::exp(-8.504 * p));
  const auto layers = calibrate_layers(70500e6, .34, curve_of(70500e6, plastic, stress));
  ASSERT_EQ(layers.size(), 14u);
  for (std::size_t k = 0; k < 14; ++k) {
    EXPECT_NEAR(layers[k].weight, weight[k], 5.1e-11) << k;
    EXPECT_NEAR(layers[k].hardening->yield_stress / 1e6, yield[k], 5.1e-7) << k;
  }
}

TEST(Calibration, OnePointIsPerfectPlasticity) {
  const auto layers = calibrate_layers(100e9, .45, {{.01, 1e9}});
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_DOUBLE_EQ(layers[0].weight, 1);
  EXPECT_NEAR(layers[0].hardening->yield_stress, 1e9, 1e-6);
}

// ---------------------------------------------------------------- what is wrong, and where

std::size_t wrong_point(std::vector<CurvePoint> curve, double E = 70500e6, double nu = .34) {
  const auto fault = find_curve_fault(E, nu, curve);
  EXPECT_TRUE(fault.has_value());
  EXPECT_THROW(calibrate_layers(E, nu, curve), Error);
  return fault ? fault->point : 999;
}

TEST(Calibration, NamesThePointThatIsWrong) {
  const double E = 70500e6;
  const auto good = curve_of(E, kPlastic, kStress);
  EXPECT_FALSE(find_curve_fault(E, .34, good));

  auto convex = good;
  convex[3].stress = 215e6;  // below the chord of points 2 and 4: the slope grows there
  EXPECT_EQ(wrong_point(convex), 3u);
  auto straight = good;
  straight[4] = {.5 * (good[3].strain + good[5].strain), .5 * (good[3].stress + good[5].stress)};
  EXPECT_EQ(wrong_point(straight), 4u);
  auto falling = good;
  falling[5].stress = 299e6;
  EXPECT_EQ(wrong_point(falling), 5u);
  auto backwards = good;
  backwards[2].strain = backwards[1].strain;
  EXPECT_EQ(wrong_point(backwards), 2u);
  auto late = good;
  late.erase(late.begin());  // begins at a plastic strain of .002
  EXPECT_EQ(wrong_point(late), 0u);
  auto origin = good;
  origin.insert(origin.begin(), {0, 0});
  EXPECT_EQ(wrong_point(origin), 0u);
  auto gap = good;
  gap[1].stress = std::nan("");
  EXPECT_EQ(wrong_point(gap), 1u);
  EXPECT_EQ(wrong_point({}), 0u);
  EXPECT_EQ(wrong_point(good, -1), 0u);
  EXPECT_EQ(wrong_point(good, E, .5), 0u);

  std::vector<CurvePoint> many{{1e6 / E, 1e6}};
  for (int k = 1; k <= 24; ++k) many.push_back({many.back().strain + .001, many.back().stress + 1e6 * (30 - k)});
  EXPECT_EQ(wrong_point(many), 24u);
}

TEST(Calibration, SaysWhatIsRight) {
  auto curve = curve_of(70500e6, kPlastic, kStress);
  curve[3].stress = 215e6;
  try {
    calibrate_layers(70500e6, .34, curve);
    FAIL();
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("point 4 of the curve"), std::string::npos) << what;
    EXPECT_NE(what.find("right is that the slope falls"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace forming_sim
