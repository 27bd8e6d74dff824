// Bodies of every kind of cell whose yield stress a fast flow raises: stretched evenly they bear what a point does, work is stored or
// dissipated, and a bent one-point cell bears what its own rate of flow raises.
#include <gtest/gtest.h>

#include <cmath>

#include "forming_sim/material/material_point.h"
#include "support/moved.h"

namespace forming_sim {
namespace {

MaterialConfig at_rates(MaterialConfig m, const char* law) {
  m.rate_dependence.emplace();
  m.rate_dependence->law = law;
  m.rate_dependence->reference_rate = 40;
  m.rate_dependence->exponent = *law == 'c' ? 5 : 0.05;
  m.rate_dependence->coefficient = 0.02;
  return m;
}
const char* const kRateLaws[] = {"cowper_symonds", "johnson_cook", "power"};
constexpr CellKind kKinds[] = {CellKind::triangle, CellKind::quad2, CellKind::crossed, CellKind::quad1, CellKind::tetrahedron, CellKind::hex6, CellKind::hex24, CellKind::hex1, CellKind::wedge14};

TEST(RateOfElements, AnEvenStretchIsThatOfAPoint) {
  for (CellKind kind : kKinds)
    for (int layers : {1, 2})
      for (double r : {0., 1.5}) {
        MaterialConfig material = at_rates(aluminium(true), kRateLaws[layers]);
        if (r > 0) {
          material.anisotropy.emplace();
          material.anisotropy->r0 = material.anisotropy->r45 = material.anisotropy->r90 = r;
          material.anisotropy->sheet_normal = Vec3::UnitZ();
        }
        if (layers == 2) {
          material.layers.resize(2);
          material.layers[0].weight = 0.3, material.layers[1].weight = 0.7;
          for (LayerConfig& layer : material.layers) layer.hardening = material.hardening;
          material.layers[1].hardening->yield_stress *= 2;
          material.hardening.reset();
        }
        Moved body(block_of(kind, 2), material);
        MaterialPoint point(material);
        body.dt = 1e-6;
        point.set_step(1e-6);
        Mat3 stress;
        for (int step = 1; step <= 50; ++step) {
          const Mat3 F = Vec3(1 + 0.001 * step, 1 - 0.0009 * step, 1).asDiagonal();
          body.place([&](const Vec3& X) { return Vec3(F * X); });
          body.forces();
          stress = point.step(F).stress;
        }
        const double p = point.plastic_strain();
        for (double each : body.elements.plastic_strain()) ASSERT_NEAR(each, p, 1e-9 * p) << shape_of(kind).name << ", " << layers << " layers, r " << r;
        double pull = 0, height = 0, width = shape_of(kind).dimension == 2 ? 1 : 0;
        for (std::size_t n = 0; n < body.X.size(); ++n) {
          if (body.X[n][0] > 0.99) pull -= body.f[n][0];
          height = std::max(height, body.x[n][1]);
          if (shape_of(kind).dimension == 3) width = std::max(width, body.x[n][2]);
        }
        ASSERT_NEAR(pull, stress(0, 0) * height * width, 1e-9 * stress.norm()) << shape_of(kind).name << ", " << layers << " layers, r " << r;
      }
}

// What is looked at where the forces have just been found flows no more; behind a step of dt it flows as the next forces will have it.
TEST(RateOfElements, StressIsThatOfTheForces) {
  for (CellKind kind : kKinds) {
    Moved body(block_of(kind, 2), at_rates(aluminium(true), "cowper_symonds"));
    body.dt = 1e-6;
    const auto stretch = [&](double s) { body.place([&](const Vec3& X) { return Vec3((1 + s) * X.x(), (1 - 0.9 * s) * X.y(), X.z()); }); };
    for (int step = 1; step <= 30; ++step) {
      stretch(0.001 * step);
      body.forces();
    }
    const auto pull = [&] { double sum = 0; for (std::size_t n = 0; n < body.X.size(); ++n) if (body.X[n][0] > 0.99) sum -= body.f[n][0]; return sum; };
    const double area = pull() / body.elements.observe(body.x).stress[0][0];
    stretch(0.031);
    const double ahead = body.elements.observe(body.x, body.dt).stress[0][0], held = body.elements.observe(body.x).stress[0][0];
    EXPECT_EQ(body.elements.stress_of({0}, body.x, body.dt)[0][0], ahead);
    body.forces();
    EXPECT_NEAR(ahead * area * (1 - 0.9 * 0.031) / (1 - 0.9 * 0.03), pull(), 2e-3 * pull()) << shape_of(kind).name;
    EXPECT_GT(held, 1.05 * ahead) << "without time to flow";
  }
}

TEST(RateOfElements, WorkIsStoredOrDissipated) {
  for (CellKind kind : kKinds)
    for (const char* law : kRateLaws) {
      const int D = shape_of(kind).dimension;
      Moved body(block_of(kind, 2), at_rates(aluminium(true), law));
      NodeField end = body.X;
      shake(end, D, 0.03, 11);
      body.dt = 1e-7;
      const double work = body.work_along(8000, [&](double t) {
        NodeField x = body.X;
        const double s = 1 - std::abs(2 * t - 1);
        for (std::size_t n = 0; n < x.size(); ++n) x[n] += s * (end[n] - x[n]);
        return x;
      });
      EXPECT_GT(body.elements.plastic_work(), 0.5 * work);
      EXPECT_NEAR(body.energy() + body.elements.plastic_work(), work, 2e-3 * work) << shape_of(kind).name << ", " << law;
    }
}

// Perfectly plastic, bent on: M = M_0 R(r), r the rate of p of the cell. sigma_s R dp is what it dissipates, so that r = 2/sqrt 3 k' h/4 with
// the curvature's rate k' of a section of height h.
TEST(RateOfElements, ABentOnePointCellBearsThePlasticMomentOfItsRate) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1})
    for (const char* law : kRateLaws)
      for (double dt : {1e-7, 1e-5}) {
        const bool flat = kind == CellKind::quad1;
        const int t = flat ? 1 : 2;
        const auto moment_of = [&](const MaterialConfig& material) {
          Moved body(cell_of(kind, flat ? Vec3(2, 1, 0) : Vec3(2, 1.5, 1)), material);
          body.dt = dt;
          double moment = 0;
          for (int step = 1; step <= 400; ++step) moment = body.bend(0.05 * step / 400, t);
          return std::abs(moment);
        };
        MaterialConfig rolled = perfectly_plastic(), layered = perfectly_plastic();
        rolled.anisotropy.emplace();
        rolled.anisotropy->r0 = rolled.anisotropy->r45 = rolled.anisotropy->r90 = 1;
        rolled.anisotropy->sheet_normal = Vec3::Unit(t);
        layered.layers.resize(2);
        layered.layers[0].weight = 0.4, layered.layers[1].weight = 0.6;
        for (LayerConfig& layer : layered.layers) layer.hardening = layered.hardening;
        layered.layers[0].hardening->yield_stress *= 0.6;
        layered.hardening.reset();
        const double r = 2 / std::sqrt(3.) * (0.05 / 400 / dt) / 4;
        const double R = *law == 'c' ? 1 + std::pow(r / 40, 0.2) : r < 40 ? 1 : *law == 'j' ? 1 + 0.02 * std::log(r / 40) : std::pow(r / 40, 0.05);
        for (const MaterialConfig& material : {perfectly_plastic(), rolled, layered})
          EXPECT_NEAR(moment_of(at_rates(material, law)) / moment_of(material), R, 3e-3 * R)
              << shape_of(kind).name << ", " << law << ", " << dt << (material.anisotropy ? ", r values" : material.hardening ? "" : ", two layers");
      }
}

}  // namespace
}  // namespace forming_sim
