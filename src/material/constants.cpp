#include "forming_sim/material/constants.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

Law law_of(const std::string& word) {
  if (word == "green_elastic") return Law::green_elastic;
  if (word == "paper") return Law::paper;
  if (word == "hyperelastic") return Law::hyperelastic;
  if (word == "classical") return Law::classical;
  throw Error(Code::invalid_scene, "material.law: given " + word + "; right are green_elastic, paper, hyperelastic, classical");
}

const double* keep(const std::vector<double>& points, CurveTables& tables) {
  tables.push_back(points);
  return tables.back().data();
}

/// sigma_s(0) of a curve that does not fall, the least of a table; 0 where that is not known.
double lowest_of(const HardeningCurve& h) {
  if (h.kind == HardeningCurve::table) return *std::min_element(h.stress, h.stress + h.points);
  const bool rises = h.kind == HardeningCurve::swift ? h.c >= 0 : h.d >= 0 && (h.kind != HardeningCurve::voce || (h.b >= 0 && h.c >= 0));
  return rises ? yield_stress(h, 0.0).value : 0;
}

RateLaw rate_of(const RateDependenceConfig& config) {
  RateLaw rate;
  rate.log_reference = std::log(config.reference_rate) + std::log(config.speed_up);
  if (config.law == "cowper_symonds") {
    rate.kind = RateLaw::cowper_symonds;
    rate.sensitivity = 1 / config.exponent;
  } else if (config.law == "johnson_cook") {
    rate.kind = RateLaw::johnson_cook;
    rate.sensitivity = config.coefficient;
  } else if (config.law == "power") {
    rate.kind = RateLaw::power;
    rate.sensitivity = config.exponent;
  } else {
    throw Error(Code::invalid_scene, "rate_dependence.law: given " + config.law + "; right are cowper_symonds, johnson_cook, power");
  }
  return rate;
}

HardeningCurve curve_of(const HardeningConfig& h, CurveTables& tables) {
  HardeningCurve curve;
  curve.a = h.yield_stress;
  curve.d = h.modulus;
  if (h.curve == "perfect") {
    curve.kind = HardeningCurve::perfect;
  } else if (h.curve == "linear") {
    curve.kind = HardeningCurve::linear;
  } else if (h.curve == "voce") {
    curve.kind = HardeningCurve::voce;
    curve.a = h.saturation_stress;
    curve.b = h.saturation_stress - h.yield_stress;
    curve.c = h.rate;
  } else if (h.curve == "swift") {
    curve.kind = HardeningCurve::swift;
    curve.a = h.strength;
    curve.b = h.prestrain;
    curve.c = h.exponent;
  } else if (h.curve == "table") {
    curve.kind = HardeningCurve::table;
    curve.strain = keep(h.plastic_strains, tables);
    curve.stress = keep(h.stresses, tables);
    curve.points = static_cast<int>(h.plastic_strains.size());
  } else {
    throw Error(Code::invalid_scene, "hardening.curve: given " + h.curve + "; right are perfect, linear, voce, swift, table");
  }
  curve.lowest = lowest_of(curve);
  return curve;
}

}  // namespace

void set_step(SolidConstants& solid, double dt) {
  const double log_step = log_of_share(dt);
  for (int k = 0; k < solid.layers; ++k) solid.layer[k].hardening.rate.log_step = log_step;
}

SolidConstants solid_constants(const MaterialConfig& config, CurveTables& tables) {
  SolidConstants solid;
  solid.law = law_of(config.law);
  solid.K = config.K();
  solid.mu = config.mu();
  solid.h1 = config.h1;
  solid.h2 = config.h2;
  if (config.anisotropy) {
    solid.law = Law::hill;
    solid.orthotropy = orthotropy_of(*config.anisotropy);
  }
  const auto hardening_of = [&](const HardeningConfig& hardening) {
    HardeningCurve curve = curve_of(hardening, tables);
    if (config.rate_dependence) curve.rate = rate_of(*config.rate_dependence);
    return curve;
  };
  if (config.hardening) solid.layer[0].hardening = hardening_of(*config.hardening);
  if (config.layers.empty()) return solid;
  if (config.layers.size() > kMaxLayers)
    throw Error(Code::invalid_scene, "material.layers: given " + std::to_string(config.layers.size()) + "; at most " + std::to_string(kMaxLayers));
  double sum = 0;
  for (const LayerConfig& layer : config.layers) sum += layer.weight;
  solid.layers = 0;
  for (const LayerConfig& layer : config.layers) {
    LayerConstants& to = solid.layer[solid.layers++];
    to.weight = layer.weight / sum;
    if (layer.hardening) to.hardening = hardening_of(*layer.hardening);
  }
  return solid;
}

}  // namespace forming_sim
