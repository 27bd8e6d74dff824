#pragma once
// The numbers of a law, as the kernels of every vector width read them, and how
// they follow from what a user says of a material.
#include <vector>

#include "forming_sim/material/config.h"
#include "forming_sim/material/hardening.h"
#include "forming_sim/material/orthotropy.h"

namespace forming_sim {

enum class Law {
  green_elastic,  ///< material/von_mises.h: S = mu J^(-5/3) B_D, with layers
  hill,           ///< material/hill.h: the same with an anisotropic yield stress
  paper,          ///< the first with S = mu B_D (3.5) as printed
  hyperelastic,   ///< material/hyperelastic.h
  classical       ///< material/classical.h
};

constexpr int kMaxLayers = 24;

struct LayerConstants {
  double weight = 1;        ///< mu_i / mu
  HardeningCurve hardening;
};

struct SolidConstants {
  Law law = Law::green_elastic;
  double K = 0;             ///< bulk modulus, Pa
  double mu = 0;            ///< shear modulus, Pa
  double h1 = 0, h2 = 0;    ///< hyperelastic, Pa
  int layers = 1;
  LayerConstants layer[kMaxLayers];
  Orthotropy orthotropy;    ///< Law::hill
};

/// Points of tabulated curves; they must outlive the constants made with them.
using CurveTables = std::vector<std::vector<double>>;

/// Steps from now on take dt, s: what raises the yield stress by its rate asks for it. 0: no time, in which nothing flows that is raised so.
void set_step(SolidConstants& solid, double dt);

/// Weights are divided by their sum. Throws Error(invalid_scene) for an unknown word
/// or more than kMaxLayers layers.
SolidConstants solid_constants(const MaterialConfig& config, CurveTables& tables);

}  // namespace forming_sim
