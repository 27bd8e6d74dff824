// One to ten layers of plasticity in a bent sheet: perfectly plastic layers calibrated
// from the same Voce curve, bent to k t = .4 and let go. What they approach is the sheet
// whose curve reverses by Masing's rule: its moment is that of the curve, its
// springback is larger than with isotropic hardening.
#include "forming_sim/material/calibration.h"
#include "speed_error/families.h"
#include "speed_error/problems.h"
#include "support/column.h"

namespace forming_sim::bench {

void layers_problem(Report& report) {
  // k_after/k of the curve as 14 layers (exact); the moment is that of kVoceBends.
  report.begin("layers", "Layers of plasticity in a sheet bent to k t = 0.4", {{"moment, N", kVoceBends[2].moment, 0.02}, {"springback, 1 - k_after/k", 1 - 0.94583, 0.05}});
  constexpr double strained = 0.3;  // plastic strain that the points of the curve reach
  for (int count : {1, 2, 3, 4, 5, 7, 10}) {
    MaterialConfig material = aluminium(true);
    const HardeningConfig voce = *material.hardening;
    std::vector<CurvePoint> curve;
    for (int k = 0; k < count; ++k) {
      const double part = count == 1 ? 0 : static_cast<double>(k) / (count - 1), p = strained * part * part;
      const double stress = voce.saturation_stress - (voce.saturation_stress - voce.yield_stress) * std::exp(-voce.rate * p);
      curve.push_back({p + stress / material.youngs_modulus, stress});
    }
    material.layers = calibrate_layers(material.youngs_modulus, material.poissons_ratio, curve);
    material.hardening.reset();
    const Family& family = kFamilies[0];
    const Clock clock;
    const Bend b = bend(family.dimension, kVoceBends[2].kt, 8, 1, material, family.pattern, family.average);
    report.add({family.name, std::to_string(count) + (count == 1 ? " layer" : " layers"), size_of(b.mesh, b.steps, clock.seconds()), {b.moment, 1 - b.after}});
  }
}

}  // namespace forming_sim::bench
