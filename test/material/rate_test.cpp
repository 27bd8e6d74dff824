// Yield stresses that a fast flow raises, at a single point: the factor, pulling at a rate, relaxation, long and short steps, work.
#include <gtest/gtest.h>

#include <cmath>

#include "forming_sim/material/law.h"
#include "forming_sim/material/material_point.h"
#include "support/point.h"

namespace forming_sim {
namespace {

constexpr double kE = 210e9, kNu = 0.3, kYield = 300e6;

RateDependenceConfig config_of(const std::string& law) {
  RateDependenceConfig config;
  config.law = law;
  config.reference_rate = law == "cowper_symonds" ? 40 : 1;
  config.exponent = law == "cowper_symonds" ? 5 : 0.03;
  config.coefficient = 0.014;
  return config;
}
const char* const kRateLaws[] = {"cowper_symonds", "johnson_cook", "power"};

/// R of config_of(law), written out.
double factor_of(const std::string& law, double rate) {
  if (law == "cowper_symonds") return 1 + std::pow(rate / 40, 0.2);
  if (rate < 1) return 1;
  return law == "power" ? std::pow(rate, 0.03) : 1 + 0.014 * std::log(rate);
}

MaterialConfig steel(const std::string& law, double modulus = 0) {
  MaterialConfig m;
  m.density = 7800;
  m.youngs_modulus = kE;
  m.poissons_ratio = kNu;
  m.hardening.emplace();
  m.hardening->curve = "linear";
  m.hardening->yield_stress = kYield;
  m.hardening->modulus = modulus;
  m.rate_dependence = config_of(law);
  return m;
}
double mises_of(const Mat3& stress) {
  const Mat3 S = stress - stress.trace() / 3 * Mat3::Identity();
  return std::sqrt(1.5) * S.norm();
}
MaterialConfig without_rate(MaterialConfig m) {
  m.rate_dependence.reset();
  return m;
}
MaterialConfig rolled(MaterialConfig m, double r) {
  m.anisotropy.emplace();
  m.anisotropy->r0 = m.anisotropy->r45 = m.anisotropy->r90 = r;
  return m;
}

TEST(Rate, TheFactorIsItsFormulaAndTheSlopeItsDerivative) {
  const double dt = 1e-6;
  for (const char* law : kRateLaws) {
    CurveTables tables;
    SolidConstants solid = solid_constants(steel(law), tables);
    set_step(solid, dt);
    const RateLaw& rate = solid.layer[0].hardening.rate;
    for (double r : {1e-3, 0.5, 2., 40., 1e3, 1e6}) {
      const double w = std::log(r * dt), h = 1e-6;
      const RateFactor<double> R = rate_factor(rate, w);
      EXPECT_NEAR(R.value, factor_of(law, r), 1e-14 * R.value) << law << " " << r;
      EXPECT_NEAR(R.slope, (rate_factor(rate, w + h).value - rate_factor(rate, w - h).value) / (2 * h), 1e-8) << law << " " << r;
      if (R.value > 1) {
        EXPECT_NEAR(log_strain_of(rate, R.value), w, 1e-11) << law << " " << r;
      }
    }
  }
}

TEST(Rate, ASpeedUpDividesTheRates) {
  MaterialConfig fast = steel("cowper_symonds");
  fast.rate_dependence->speed_up = 1000;
  CurveTables tables;
  const SolidConstants solid = solid_constants(fast, tables);  // steps of 1 s
  EXPECT_NEAR(rate_factor(solid.layer[0].hardening.rate, std::log(5e3)).value, factor_of("cowper_symonds", 5), 1e-14);
}

/// Axial stress after a pull to a logarithmic strain at a rate of it, in n steps.
double pulled(const MaterialConfig& material, double rate, double strain, int n, MaterialPoint* end = nullptr) {
  MaterialPoint point(material);
  point.set_step(strain / rate / n);
  double stress = 0;
  for (int i = 1; i <= n; ++i) stress = point.uniaxial(std::exp(strain * i / n));
  if (end) *end = point;
  return stress;
}

// Without hardening the plastic rate becomes that of the pull, but for what a step of the strain d makes of it: d/2 of it.
TEST(Rate, APullIsBorneAtTheYieldStressOfItsRate) {
  for (const char* law : kRateLaws)
    for (double rate : {1e-2, 3., 200., 1e5}) {
      const double right = kYield * factor_of(law, rate);
      for (int n : {100, 1000}) EXPECT_NEAR(pulled(steel(law), rate, 0.1, n), right, 0.01 / n * right) << law << " at " << rate << ", " << n << " steps";
      EXPECT_NEAR(pulled(rolled(steel(law), 1), rate, 0.1, 300), right, 0.01 / 300 * right) << law << " rolled, at " << rate;
      EXPECT_NEAR(pulled(rolled(steel(law), 1.8), rate, 0.1, 300), right, 0.01 / 300 * right) << law << " rolled, at " << rate;
    }
}

TEST(Rate, OfTheClassicalLawToo) {
  for (const char* law : kRateLaws) {
    MaterialConfig classical = steel(law);
    classical.law = "classical";
    EXPECT_NEAR(pulled(classical, 500, 0.05, 4000), kYield * factor_of(law, 500), 1e-3 * kYield) << law;
  }
}

TEST(Rate, BelowTheReferenceRateNothingIsRaised) {
  for (const char* law : {"johnson_cook", "power"}) {
    const MaterialConfig slow = steel(law, 2e9);
    const double right = pulled(without_rate(slow), 0.5, 0.05, 200);
    EXPECT_NEAR(pulled(slow, 0.5, 0.05, 200), right, 1e-11 * right) << law;
    EXPECT_GT(pulled(slow, 5, 0.05, 200), 1.01 * right) << law;
  }
}

TEST(Rate, HardeningIsRaisedWithTheYieldStress) {
  const double H = 2e9, rate = 800;
  for (const char* law : kRateLaws) {
    MaterialPoint end(steel(law));
    const double stress = pulled(steel(law, H), rate, 0.2, 2000, &end), p = end.plastic_strain(), R = factor_of(law, rate * kE / (kE + H * factor_of(law, rate)));
    EXPECT_NEAR(stress, (kYield + H * p) * R, 2e-3 * kYield) << law;
  }
}

// A table that is level, steep and level again: the flow of a long step ends anywhere about the bends, where what has to be solved is not concave.
TEST(Rate, ATableMayBend) {
  for (const char* law : kRateLaws)
    for (bool hill : {false, true})
      for (double bend = 0.001; bend < 0.2; bend *= 1.1) {
        MaterialConfig table = hill ? rolled(steel(law), 1) : steel(law);
        table.hardening->curve = "table";
        table.hardening->plastic_strains = {0, bend, bend + 0.0005, 0.5};
        table.hardening->stresses = {285e6, 285e6, 655e6, 688e6};
        MaterialPoint point(table);
        point.set_step(1e-4);
        const double strain = 0.12, q = mises_of(point.step(Vec3(std::exp(strain), std::exp(-strain / 2), std::exp(-strain / 2)).asDiagonal().toDenseMatrix()).stress), p = point.plastic_strain();
        const double sigma = p < bend ? 285e6 : p < bend + 0.0005 ? 285e6 + 370e6 * (p - bend) / 0.0005 : 655e6 + 33e6 * (p - bend - 0.0005) / (0.5 - bend - 0.0005);
        EXPECT_NEAR(q, sigma * factor_of(law, p / 1e-4), 1e-8 * q) << law << (hill ? " rolled" : "") << ", bend at " << bend;
      }
}

// Every layer goes by its own rate: all of them flow with the whole, and together they bear the sum.
TEST(Rate, OfLayers) {
  MaterialConfig layered = steel("cowper_symonds");
  layered.layers.resize(2);
  layered.layers[0].weight = 0.4, layered.layers[1].weight = 0.6;
  for (int k = 0; k < 2; ++k) {
    layered.layers[k].hardening = layered.hardening;
    layered.layers[k].hardening->yield_stress = (k + 1) * 200e6;
  }
  layered.hardening.reset();
  const double right = (0.4 * 200e6 + 0.6 * 400e6) * factor_of("cowper_symonds", 100);
  EXPECT_NEAR(pulled(layered, 100, 0.1, 1000), right, 1e-4 * right);
}

Mat3 sheared(double gamma) {
  Mat3 F = Mat3::Identity();
  F(0, 1) = gamma;
  return F;
}

// q' = -3 mu D (q/Y - 1)^P in a body that is held: with s = q/Y - 1, s^(1-P) = s_0^(1-P) + (P - 1) 3 mu D t/Y.
TEST(Rate, StressRelaxesWhereTheBodyIsHeld) {
  const double mu = kE / (2 * (1 + kNu)), P = 5, c = 3 * mu * 40 / kYield;
  const auto held = [&](int n, double time, bool hill) {
    MaterialPoint point(hill ? rolled(steel("cowper_symonds"), 1) : steel("cowper_symonds"));
    point.set_step(0);  // no time to flow: elastic
    const double start = mises_of(point.step(sheared(0.004)).stress) / kYield - 1;
    EXPECT_LT(point.plastic_strain(), 1e-200);
    point.set_step(time / n);
    double q = 0;
    for (int i = 0; i < n; ++i) q = mises_of(point.step(sheared(0.004)).stress);
    const double right = std::pow(std::pow(start, 1 - P) + (P - 1) * c * time, 1 / (1 - P));
    return q / kYield - 1 - right;
  };
  for (double time : {1e-7, 1e-5, 1e-2}) {
    EXPECT_NEAR(held(2000, time, false), 0, 2e-3) << time;
    EXPECT_NEAR(held(2000, time, true), 0, 2e-3) << time;
    EXPECT_NEAR(held(1000, time, false) / held(2000, time, false), 2, 0.1) << "of first order, at " << time;
  }
}

TEST(Rate, OneStepHoweverLongEndsAtTheYieldStress) {
  for (const char* law : kRateLaws) {
    MaterialPoint point(steel(law, 1e9));
    point.set_step(1e9);
    const double q = mises_of(point.step(sheared(0.2)).stress);
    EXPECT_NEAR(q, (kYield + 1e9 * point.plastic_strain()) * factor_of(law, point.plastic_strain() / 1e9), 1e-6 * kYield) << law;
    EXPECT_GT(point.plastic_strain(), 0.1);
  }
}

// Steps that have no time flow by nothing, and so give the same stress when they are asked for again.
TEST(Rate, AskedAgainInNoTimeThePointAnswersTheSame) {
  for (const char* law : kRateLaws)
    for (bool hill : {false, true}) {
      MaterialPoint point(hill ? rolled(steel(law), 1.6) : steel(law));
      point.set_step(1e-7);
      const Mat3 stress = point.step(sheared(0.01)).stress;
      point.set_step(0);
      EXPECT_LT((point.step(sheared(0.01)).stress - stress).norm(), 1e-11 * stress.norm()) << law;
    }
}

TEST(Rate, WorkIsStoredOrDissipated) {
  for (const char* law : kRateLaws)
    for (bool hill : {false, true}) {
      MaterialPoint point(hill ? rolled(steel(law), 0.6) : steel(law));
      const int n = 20000;
      point.set_step(1e-3 / n);
      double work = 0, tau = 0, energy = 0, before = 0;
      for (int i = 1; i <= n; ++i) {
        const double gamma = 0.05 * std::sin(2 * M_PI * i / n);
        const MaterialPoint::Answer answer = point.step(sheared(gamma));
        work += 0.5 * (answer.stress(0, 1) + tau) * (gamma - before);
        tau = answer.stress(0, 1), before = gamma, energy = answer.energy;
      }
      EXPECT_GT(point.plastic_strain(), 0.05);
      EXPECT_NEAR(point.dissipated() + energy, work, 1e-3 * work) << law << (hill ? " rolled" : "");
    }
}

}  // namespace
}  // namespace forming_sim
