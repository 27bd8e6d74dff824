#pragma once
// What a scene compiles into for the time loop: its stages, loads and
// parameters, with the meshes already in the Model.
#include <string>
#include <vector>

#include "forming_sim/contact/config.h"
#include "forming_sim/loads/config.h"
#include "forming_sim/simulation/config.h"

namespace forming_sim {

/// Boundaries, pressures, dead loads and initial motion of one body (same order as Model::bodies).
struct BodyLoads {
  Vec3 initial_velocity = Vec3::Zero(), initial_spin_deg_s = Vec3::Zero(), spin_centre = Vec3::Zero();
  std::vector<std::string> initial_velocity_field;  ///< formulas, config/formula_field.h
  std::vector<BoundaryConfig> boundaries;
  std::vector<PressureConfig> pressures;
  std::vector<LoadConfig> loads;
  bool moves_at_first() const { return !initial_velocity.isZero() || !initial_spin_deg_s.isZero() || !initial_velocity_field.empty(); }
};

struct RunPlan {
  std::vector<BodyLoads> bodies;
  Vec3 gravity = Vec3::Zero();
  ContactConfig contact;
  TimeStepConfig time_step;
  std::vector<StageConfig> stages;
};

}  // namespace forming_sim
