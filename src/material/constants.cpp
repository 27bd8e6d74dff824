#include "forming_sim/material/constants.h"

#include "forming_sim/config/fault.h"

namespace forming_sim {

SolidConstants solid_constants(const MaterialConfig& config, std::vector<double>& strain_table,
                               std::vector<double>& stress_table) {
  SolidConstants solid;
  solid.K = config.bulk_modulus();
  solid.mu = config.shear_modulus();
  solid.paper = config.law == "paper";
  if (!config.hardening) return solid;
  const HardeningConfig& h = *config.hardening;
  HardeningCurve& curve = solid.hardening;
  if (h.curve == "perfect") {
    curve.kind = HardeningCurve::perfect;
    curve.a = h.yield_stress;
  } else if (h.curve == "linear") {
    curve.kind = HardeningCurve::linear;
    curve.a = h.yield_stress;
    curve.b = h.modulus;
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
    strain_table = h.plastic_strains;
    stress_table = h.stresses;
    curve.strain = strain_table.data();
    curve.stress = stress_table.data();
    curve.points = static_cast<int>(strain_table.size());
  } else {
    throw Error(Code::invalid_scene, "hardening.curve: given " + h.curve +
                                         "; right are perfect, linear, voce, swift, table");
  }
  return solid;
}

}  // namespace forming_sim
