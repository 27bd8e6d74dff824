#pragma once
// What a user may set of the mild contact. Nothing has to be set.
#include "forming_sim/config/field.h"

namespace forming_sim {

struct ContactConfig {
  double layer = 0;        ///< h0
  double stiffness = 0;    ///< kappa per area
  double push_speed = 0;   ///< v_push
  double friction = 0;     ///< of bodies against each other and themselves
  int max_sweeps = 50;
  int max_halvings = 30;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(layer), Field().unit("m").at_least(0).computed("min(0.05 smallest surface edge, 1e-3 thickness), raised to 0.1 of the closing motion of a step").doc("thickness h0 of the mild layer in which the repulsion p = E (h0/h - 1) acts"));
    visit(FORMING_SIM_FIELD(stiffness), Field().unit("Pa").at_least(0).computed("Young's modulus of the softer body").doc("modulus E of the mild layer"));
    visit(FORMING_SIM_FIELD(push_speed), Field().unit("m/s").at_least(0).computed("the smaller of 0.1 m/s and 1e-3 of the wave speed").doc("speed at which the soft start lets the layer of a pair that is born close grow"));
    visit(FORMING_SIM_FIELD(friction), Field().at_least(0).at_most(10).doc("Coulomb friction of bodies against each other and against themselves; that of tools is theirs"));
    visit(FORMING_SIM_FIELD(max_sweeps), Field().at_least(1).at_most(1000).doc("most Gauss-Seidel sweeps in a step"));
    visit(FORMING_SIM_FIELD(max_halvings), Field().at_least(1).at_most(60).doc("most halvings of one step before the run ends with a named error"));
  }
};

}  // namespace forming_sim
