#pragma once
// Levels (3.68)-(3.70) from a curve measured in tension: perfectly plastic layers whose
// sum follows straight lines between its points, forth, and back by Masing's rule.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/material/config.h"

namespace forming_sim {

struct CurvePoint {
  double strain;  ///< true strain, elastic part included
  double stress;  ///< true stress, Pa
};

/// Why no layers can follow a curve: the first point (counted from 0) that is wrong.
struct CurveFault {
  std::size_t point;
  std::string sentence;  ///< "slope 2.1e9 Pa to the next point ...; right is ..."
};

/// How far the first point may lie from the elastic line, as a fraction of its strain.
constexpr double kElasticLineTolerance = 0.02;

/// The curve must begin at the elastic limit (strain = stress/E), rise, and bend down at every point.
std::optional<CurveFault> find_curve_fault(double youngs_modulus, double poissons_ratio, const std::vector<CurvePoint>& curve);

/// One perfectly plastic layer a point; after the last point the curve is level.
///   w_k = (E - ET_k) / (E - (1-2nu)/3 ET_k) - sum_{i<k} w_i,   ET_k the slope after point k
///   Y_k = [3 E eps_k - (1-2nu) sigma_k] / (2 (1+nu))
/// Exact in small strain. Throws Error(invalid_scene) with the point where find_curve_fault
/// names one, and for moduli that are none.
std::vector<LayerConfig> calibrate_layers(double youngs_modulus, double poissons_ratio, const std::vector<CurvePoint>& curve);

}  // namespace forming_sim
