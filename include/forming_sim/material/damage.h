#pragma once
// How near to a crack flow has brought the metal: D = integral of w dp, p the equivalent plastic strain, w by a criterion of the largest principal
// stress sigma_1, the mean stress sigma_m and von Mises' stress sigma_e. Flow does not feel it, and nothing parts.
//   cockcroft_latham             w = max(sigma_1, 0)               Cockcroft and Latham 1968, Pa
//   normalized_cockcroft_latham  w = max(sigma_1, 0) / sigma_e     Oh, Chen and Kobayashi 1979
//   rice_tracey                  w = exp(3/2 sigma_m / sigma_e)    Rice and Tracey 1969: ln of the radius of a void, over .283
// In a tension before necking sigma_1 = sigma_e = 3 sigma_m: w = sigma_s(p), 1 and exp(1/2). What is asked of an element that does not flow just then is
// divided by the sigma_e at which it does; sigma_m / sigma_e counts up to 5, more than necks and the tips of cracks have.
#include <string>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

enum class DamageCriterion { cockcroft_latham, normalized_cockcroft_latham, rice_tracey };

/// Of DamageConfig::criterion, one of its words.
DamageCriterion damage_criterion(const std::string& word);
/// "Pa" or "1".
const char* damage_unit(const std::string& criterion);

/// What the criteria ask of a Cauchy stress, Pa.
struct DamageStress {
  double sigma_1 = 0, sigma_m = 0, sigma_e = 0;
};
DamageStress damage_stress(const Mat3& sigma);

/// w = dD/dp; flow: sigma_e where the element flows, Pa. Of no stress at all 0.
double damage_per_strain(DamageCriterion criterion, const DamageStress& stress, double flow);

}  // namespace forming_sim
