// In small strain the layers share the deviatoric strain. In tension with free sides it
// is g = eps_x - eps_y, and a layer carries 2 mu g until it yields: at Y_k = 2 mu g_k.
//   sigma = sum_k w_k min(2 mu g, Y_k)                 as the lateral stresses sum to zero
//   eps_x + 2 eps_y = (1-2nu) sigma / E                the volume is elastic
// so 3 E eps_x = 2 (1+nu) 2 mu g + (1-2nu) sigma: at a kink that is Y_k. Between kinks,
// with f the weight that still is elastic, d sigma = f 2 mu dg, and the slope ET follows:
//   1 - f = (E - ET) / (E - (1-2nu)/3 ET).
#include "forming_sim/material/calibration.h"

#include <cmath>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/material/constants.h"

namespace forming_sim {
namespace {

double slope_after(const std::vector<CurvePoint>& curve, std::size_t k) {
  if (k + 1 == curve.size()) return 0;
  return (curve[k + 1].stress - curve[k].stress) / (curve[k + 1].strain - curve[k].strain);
}

}  // namespace

std::optional<CurveFault> find_curve_fault(double E, double nu, const std::vector<CurvePoint>& curve) {
  std::ostringstream say;
  const auto fault = [&](std::size_t point) { return CurveFault{point, say.str()}; };
  if (!(E > 0 && std::isfinite(E)) || !(nu > -1 && nu < 0.5)) {
    say << "Young's modulus " << E << " Pa and Poisson's ratio " << nu << "; right are a positive modulus and a ratio above -1 and below .5";
    return fault(0);
  }
  if (curve.empty()) {
    say << "the curve has no point; right is one or more from the elastic limit on";
    return fault(0);
  }
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const CurvePoint& p = curve[k];
    if (std::isfinite(p.strain) && std::isfinite(p.stress) && p.strain > 0 && p.stress > 0) continue;
    say << "strain " << p.strain << ", stress " << p.stress << " Pa; right are finite numbers above 0, from the elastic limit on";
    return fault(k);
  }
  const double off = curve[0].strain - curve[0].stress / E;
  if (std::fabs(off) > kElasticLineTolerance * curve[0].strain) {
    say << "strain " << curve[0].strain << " at stress " << curve[0].stress << " Pa is " << off << " from the elastic line; right for the first point is strain = stress/E = "
        << curve[0].stress / E << " within " << 100 * kElasticLineTolerance << " %";
    return fault(0);
  }
  double before = E;
  for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
    if (!(curve[k + 1].strain > curve[k].strain) || !(curve[k + 1].stress > curve[k].stress)) {
      say << "strain " << curve[k + 1].strain << ", stress " << curve[k + 1].stress << " Pa after strain " << curve[k].strain << ", stress "
          << curve[k].stress << " Pa; right is that both grow";
      return fault(k + 1);
    }
    const double slope = slope_after(curve, k);
    if (!(slope < before * (1 - 1e-12))) {
      say << "slope " << slope << " Pa to the next point, " << before << (k == 0 ? " Pa of the elastic line before" : " Pa from the one before")
          << "; right is that the slope falls: leave out the points that lie below the chord of their neighbours, or on it";
      return fault(k);
    }
    before = slope;
  }
  if (curve.size() > kMaxLayers) {
    say << curve.size() << " points; right are at most " << kMaxLayers << ", one for each layer";
    return fault(kMaxLayers);
  }
  return std::nullopt;
}

std::vector<LayerConfig> calibrate_layers(double E, double nu, const std::vector<CurvePoint>& curve) {
  if (const auto fault = find_curve_fault(E, nu, curve))
    throw Error(Code::invalid_scene, "point " + std::to_string(fault->point + 1) + " of the curve: given " + fault->sentence);
  std::vector<LayerConfig> layers;
  double sum = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double ET = slope_after(curve, k), yielding = (E - ET) / (E - (1 - 2 * nu) / 3 * ET);
    LayerConfig layer;
    layer.weight = yielding - sum;
    sum = yielding;
    layer.hardening.emplace();
    layer.hardening->curve = "perfect";
    layer.hardening->yield_stress = (3 * E * curve[k].strain - (1 - 2 * nu) * curve[k].stress) / (2 * (1 + nu));
    layers.push_back(layer);
  }
  return layers;
}

}  // namespace forming_sim
