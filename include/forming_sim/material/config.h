#pragma once
// What a user says of a material.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Isotropic hardening sigma_s(p), p the equivalent plastic strain.
struct HardeningConfig {
  std::string curve;                 ///< perfect | linear | voce | swift | table
  double yield_stress = 0;           ///< sigma_s(0)
  double modulus = 0;                ///< linear, voce: the part of d sigma_s / d p that stays
  double saturation_stress = 0;      ///< voce: sigma_s(infinity)
  double rate = 0;                   ///< voce: exponent per unit p
  double strength = 0;               ///< swift: K of K (e0 + p)^n
  double prestrain = 0;              ///< swift: e0
  double exponent = 0;               ///< swift: n
  std::vector<double> plastic_strains;  ///< table
  std::vector<double> stresses;         ///< table

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(curve), Field().required().choices({"perfect", "linear", "voce", "swift", "table"})
          .doc("shape of the hardening curve sigma_s(p): perfect: Y; linear: Y + modulus p; voce: saturation - (saturation - Y) exp(-rate p) + modulus p; swift: strength (prestrain + p)^exponent; table: straight lines between points, level after the last"));
    visit(FORMING_SIM_FIELD(yield_stress), Field().unit("Pa").above(0).required().when("curve", {"perfect", "linear", "voce"}).doc("yield stress Y of the virgin material"));
    visit(FORMING_SIM_FIELD(modulus), Field().unit("Pa").at_least(0).when("curve", {"linear", "voce"}).doc("plastic hardening modulus d sigma_s / d p; of voce the part that stays when the exponential has died away"));
    visit(FORMING_SIM_FIELD(saturation_stress), Field().unit("Pa").above(0).required().when("curve", {"voce"}).doc("stress that the Voce curve approaches"));
    visit(FORMING_SIM_FIELD(rate), Field().unit("1").above(0).required().when("curve", {"voce"}).doc("exponent of the Voce curve per unit plastic strain"));
    visit(FORMING_SIM_FIELD(strength), Field().unit("Pa").above(0).required().when("curve", {"swift"}).doc("K of K (e0 + p)^n"));
    visit(FORMING_SIM_FIELD(prestrain), Field().unit("1").above(0).required().when("curve", {"swift"}).doc("e0 of K (e0 + p)^n"));
    visit(FORMING_SIM_FIELD(exponent), Field().unit("1").at_least(0).at_most(1).when("curve", {"swift"}).doc("n of K (e0 + p)^n"));
    visit(FORMING_SIM_FIELD(plastic_strains), Field().unit("1").at_least(0).required().when("curve", {"table"}).doc("plastic strains of the table, from 0, strictly increasing"));
    visit(FORMING_SIM_FIELD(stresses), Field().unit("Pa").above(0).required().when("curve", {"table"}).doc("yield stresses of the table, one per plastic strain, not decreasing"));
  }
};

/// One of the levels (3.68)-(3.70): all deform together, each has its own memory and yields by itself.
struct LayerConfig {
  double weight = 0;
  std::optional<HardeningConfig> hardening;  ///< absent: the layer stays elastic

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(weight), Field().above(0).at_most(1).required().doc("share of the shear modulus, mu_i / mu (3.68); the weights of all layers sum to 1"));
    visit(FORMING_SIM_FIELD(hardening), Field().doc("yield stress of the layer, as if the whole body were made of it, over the layer's own plastic strain; absent: the layer stays elastic"));
  }
};

/// How yield depends on the direction in a rolled sheet (material/orthotropy.h).
struct AnisotropyConfig {
  double r0 = 0, r45 = 0, r90 = 0;  ///< r45, r90 = 0: r0
  Vec3 rolling_direction = Vec3::Zero(), sheet_normal = Vec3::Zero();  ///< at the start

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(r0), Field().above(0).at_most(100).required().doc("r value in tension along the rolling direction: plastic strain across the width over that through the thickness; 1 in all directions: none. The hardening curve is that of this tension"));
    visit(FORMING_SIM_FIELD(r45), Field().at_least(0).at_most(100).computed("r0").doc("r value at 45 degrees to it; 0 is that of r0"));
    visit(FORMING_SIM_FIELD(r90), Field().at_least(0).at_most(100).computed("r0").doc("r value across it; 0 is that of r0"));
    visit(FORMING_SIM_FIELD(rolling_direction), Field().computed("x").doc("rolling direction at the start, of any length; it turns with the sheet. Dimension 2: in the plane, or along z"));
    visit(FORMING_SIM_FIELD(sheet_normal), Field().computed("z; y in dimension 2").doc("direction through the thickness at the start, at right angles to it; it turns with the sheet. Dimension 2: in the plane, or along z"));
  }
};

/// How fast flow raises the yield stress (material/rate.h).
struct RateDependenceConfig {
  std::string law;                 ///< cowper_symonds | johnson_cook | power
  double reference_rate = 0;
  double exponent = 0;             ///< cowper_symonds: P; power: m
  double coefficient = 0;          ///< johnson_cook: C
  double speed_up = 1;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(law), Field().required().choices({"cowper_symonds", "johnson_cook", "power"})
          .doc("factor of the yield stress at the plastic strain rate r: cowper_symonds: 1 + (r/reference_rate)^(1/exponent); johnson_cook: 1 + coefficient ln(r/reference_rate); power: (r/reference_rate)^exponent; of the last two 1 below the reference_rate"));
    visit(FORMING_SIM_FIELD(reference_rate), Field().unit("1/s").above(0).required().doc("plastic strain rate to which others are compared: that of a static test in johnson_cook and power, D of cowper_symonds"));
    visit(FORMING_SIM_FIELD(exponent), Field().unit("1").above(0).required().when("law", {"cowper_symonds", "power"}).doc("P of cowper_symonds, at least 1; m of power, at most 1"));
    visit(FORMING_SIM_FIELD(coefficient), Field().unit("1").above(0).at_most(1).required().when("law", {"johnson_cook"}).doc("C of Johnson and Cook"));
    visit(FORMING_SIM_FIELD(speed_up), Field().above(0).doc("how many times faster the scene moves than what it stands for: its rates are divided by that"));
  }
};

/// How near to a crack flow brings the metal (material/damage.h).
struct DamageConfig {
  std::string criterion = "normalized_cockcroft_latham";
  double critical = 0;             ///< 0: not known

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(criterion), Field().choices({"normalized_cockcroft_latham", "cockcroft_latham", "rice_tracey"})
          .doc("what damage D sums over the plastic strain: normalized_cockcroft_latham: max(largest principal stress, 0) over von Mises' stress; cockcroft_latham: max(largest principal stress, 0), in Pa; rice_tracey: exp(3/2 mean stress over von Mises' stress)"));
    visit(FORMING_SIM_FIELD(critical), Field().at_least(0).computed("not known").doc("D at which the metal cracks, of cockcroft_latham in Pa: a run that reaches it says so, and where. Nothing parts; of normalized_cockcroft_latham about the true strain of fracture in tension"));
  }
};

/// How far a sheet may be stretched before it necks (material/forming_limit.h).
struct FormingLimitConfig {
  std::vector<double> minor_strains, major_strains;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(minor_strains), Field().unit("1").at_least(-3).at_most(3).required().doc("the smaller principal strains of the points of the curve, true (logarithmic), strictly increasing: from uniaxial tension, below 0, over plane strain, 0, to stretching in all directions"));
    visit(FORMING_SIM_FIELD(major_strains), Field().unit("1").above(0).at_most(3).required().doc("the larger principal strain at which the sheet begins to neck, one for each minor strain, true; straight lines between the points, level beyond them"));
  }
};

/// An elastic, elastic-plastic or hyperelastic solid.
struct MaterialConfig {
  double density = 0;
  double youngs_modulus = 0;
  double poissons_ratio = 0;
  std::string law = "green_elastic";
  std::optional<HardeningConfig> hardening;  ///< absent, and no layers: elastic
  std::vector<LayerConfig> layers;
  std::optional<AnisotropyConfig> anisotropy;  ///< absent: none
  std::optional<RateDependenceConfig> rate_dependence;  ///< absent: none
  std::optional<DamageConfig> damage;        ///< absent: none is summed
  std::optional<FormingLimitConfig> forming_limit;  ///< absent: not known
  double h1 = 0, h2 = 0, bulk_modulus = 0;   ///< hyperelastic

  double mu() const { return law == "hyperelastic" ? h1 + 2 * h2 : youngs_modulus / (2 * (1 + poissons_ratio)); }
  double K() const { return law == "hyperelastic" ? bulk_modulus : youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
  /// It, or a layer of it, has a yield stress.
  bool yields() const {
    return hardening || std::any_of(layers.begin(), layers.end(), [](const LayerConfig& layer) { return layer.hardening.has_value(); });
  }
  double E() const { return law == "hyperelastic" ? 9 * K() * mu() / (3 * K() + mu()) : youngs_modulus; }

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(density), Field().unit("kg/m3").above(0).at_most(1e5).required().doc("mass density"));
    visit(FORMING_SIM_FIELD(youngs_modulus), Field().unit("Pa").above(0).required().when("law", {"green_elastic", "paper", "classical"}).doc("Young's modulus E"));
    visit(FORMING_SIM_FIELD(poissons_ratio), Field().unit("1").above(-1).below(0.5).when("law", {"green_elastic", "paper", "classical"}).doc("Poisson's ratio nu"));
    visit(FORMING_SIM_FIELD(law), Field().choices({"green_elastic", "paper", "hyperelastic", "classical"})
          .doc("stress beside the pressure: green_elastic: mu J^(-5/3) dev B, which has a stored energy; paper: mu dev B as printed in (3.5); hyperelastic: dev(h1 Bbar + h2 Bbar.Bbar)/J (3.74); classical: Wilkins' rate law (2.10) with Jaumann's rotation and radial return, which drifts: the baseline for comparisons"));
    visit(FORMING_SIM_FIELD(hardening), Field().when("law", {"green_elastic", "paper", "classical"}).doc("von Mises plasticity with this isotropic hardening; absent: elastic"));
    visit(FORMING_SIM_FIELD(layers), Field().when("law", {"green_elastic", "paper"}).doc("several levels of plasticity instead of hardening: together they follow a measured curve and its reversal (Bauschinger effect)"));
    visit(FORMING_SIM_FIELD(anisotropy), Field().when("law", {"green_elastic"}).doc("Hill's quadratic yield stress of 1948 in place of von Mises', with this hardening or these layers; absent: all directions yield alike"));
    visit(FORMING_SIM_FIELD(rate_dependence), Field().when("law", {"green_elastic", "paper", "classical"}).doc("fast flow raises the yield stress, that of every layer by its own rate; absent: it does not"));
    visit(FORMING_SIM_FIELD(damage), Field().when("law", {"green_elastic", "paper", "classical"}).doc("tells how near to a crack flow brings the metal, and changes nothing of it; absent: not summed"));
    visit(FORMING_SIM_FIELD(forming_limit), Field().when("law", {"green_elastic", "paper", "classical"}).doc("the forming limit curve of the sheet: a run tells how near to it the strains of the middle of the sheet come, and where; absent: not known"));
    visit(FORMING_SIM_FIELD(h1), Field().unit("Pa").above(0).required().when("law", {"hyperelastic"}).doc("h1 of (3.74); the shear modulus at rest is h1 + 2 h2"));
    visit(FORMING_SIM_FIELD(h2), Field().unit("Pa").at_least(0).when("law", {"hyperelastic"}).doc("h2 of (3.74)"));
    visit(FORMING_SIM_FIELD(bulk_modulus), Field().unit("Pa").above(0).required().when("law", {"hyperelastic"}).doc("bulk modulus K"));
  }
};

}  // namespace forming_sim
