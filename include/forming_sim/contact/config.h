#pragma once
// What a user may set of the contact. Nothing has to be set.
#include <string>
#include <vector>

#include "forming_sim/config/field.h"

namespace forming_sim {

/// What two surfaces are to each other, where it is not the usual.
struct PairConfig {
  std::string first, second;            ///< a body; a body or a tool
  std::string kind = "sliding";         ///< sliding | frictionless | sticking | tied | none
  double friction = 0;
  double friction_limit = 0;
  double tie_distance = 0;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(first), Field().required().doc("name of a body or of a tool"));
    visit(FORMING_SIM_FIELD(second), Field().required().doc("name of another body or tool, one of both being a body, or the same name again for a body and itself"));
    visit(FORMING_SIM_FIELD(kind), Field().choices({"sliding", "frictionless", "sticking", "tied", "none"}).doc("sliding: with Coulomb friction; frictionless; sticking: no slip while pressed together, free to part; tied: what touches at the start stays together, the rest slides; none: they do not see each other"));
    visit(FORMING_SIM_FIELD(friction), Field().at_least(0).at_most(10).when("kind", {"sliding", "tied"}).doc("Coulomb friction of the pair, in place of that of the tool or of contact.friction"));
    visit(FORMING_SIM_FIELD(friction_limit), Field().unit("Pa").at_least(0).when("kind", {"sliding", "sticking", "tied"}).computed("no limit").doc("largest shear stress of the pair's friction, in place of that of the tool or of contact.friction_limit; with kind sticking surfaces stay together up to it and slide under it, whatever presses them"));
    visit(FORMING_SIM_FIELD(tie_distance), Field().unit("m").at_least(0).when("kind", {"tied"}).computed("a tenth of the smallest edge of the two surfaces, of a tool's those of the body alone").doc("vertices of one surface up to so far from the other are tied to it; at most half the thickness of a body"));
  }
};

struct ContactConfig {
  std::string method = "implicit";      ///< implicit | explicit | geometric
  double layer = 0;                     ///< h0
  double stiffness = 0;                 ///< kappa per area
  double coefficient = 0;               ///< c of (3.71)
  int exponent = 1;                     ///< n of c (1/h^n - 1/h0^n)
  std::string pairing = "node_side";    ///< node_side | node_node
  double push_speed = 0;                ///< v_push
  double friction = 0;                  ///< of bodies against each other and themselves
  double friction_limit = 0;            ///< likewise
  std::string swing = "damped";         ///< damped | free (shear_waves.h)
  std::vector<PairConfig> pairs;
  int max_sweeps = 100;
  int max_halvings = 30;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(method), Field().choices({"implicit", "explicit", "geometric"}).doc("implicit: mild contact at the end of the step, which never lets a node through; the others are baselines to compare with, and may: explicit: mild contact as printed in (3.71), at the start of the step, stable only for a time step that the summary names and time_step.maximum sets; geometric: a node found inside is put back onto the surface and slides"));
    visit(FORMING_SIM_FIELD(layer), Field().unit("m").at_least(0).computed("min(0.05 smallest surface edge, 1e-3 thickness, 0.2 of the clearance between two bodies that stand close and do not touch), with method implicit a tenth of the first two where bodies of metal can come together that are apart at the start, and raised to 0.1 of the closing motion of a step").doc("thickness h0 of the mild layer in which the repulsion p = E (h0/h - 1) acts. Tools are set back by it; bodies that meet stay this far apart, as if each were thicker by half of it: an interference fit is as much tighter; with method geometric the distance at which surfaces are kept"));
    visit(FORMING_SIM_FIELD(stiffness), Field().unit("Pa").at_least(0).when("method", {"implicit", "explicit"}).computed("Young's modulus of the softer body").doc("modulus E of the mild layer"));
    visit(FORMING_SIM_FIELD(coefficient), Field().unit("N m^n").at_least(0).when("method", {"explicit"}).computed("E A h0^n / n, with E the stiffness and A the area of the node").doc("c of the force c (1/h^n - 1/h0^n), the same for every node; in plane strain per metre of width"));
    visit(FORMING_SIM_FIELD(exponent), Field().at_least(1).at_most(3).when("method", {"explicit"}).doc("n of the force c (1/h^n - 1/h0^n)"));
    visit(FORMING_SIM_FIELD(pairing), Field().choices({"node_side", "node_node"}).when("method", {"explicit"}).doc("what repels a node: node_side: the nearest points of the other surface's sides; node_node: its nearest node, so that meshes have to match"));
    visit(FORMING_SIM_FIELD(push_speed), Field().unit("m/s").at_least(0).when("method", {"implicit"}).computed("the smaller of 0.1 m/s and 1e-3 of the wave speed").doc("speed at which the soft start lets the layer of a pair that is born close grow"));
    visit(FORMING_SIM_FIELD(friction), Field().at_least(0).at_most(10).doc("Coulomb friction of bodies against each other and against themselves; that of tools is theirs"));
    visit(FORMING_SIM_FIELD(friction_limit), Field().unit("Pa").at_least(0).computed("no limit").doc("largest shear stress of that friction"));
    visit(FORMING_SIM_FIELD(swing), Field().choices({"damped", "free"}).when("method", {"implicit"}).doc("of a body that slides under friction: damped: waves of shear leave where it rubs, as into tools of its own material, and friction follows the normal force with a delay of the way of such a wave through the thickness; steady sliding and strikes feel neither; free: rigid tools throw all waves back, so that a body that slides begins to swing, and its friction on the whole is too small"));
    visit(FORMING_SIM_FIELD(pairs), Field().doc("pairs of surfaces that meet in another way than the rest"));
    visit(FORMING_SIM_FIELD(max_sweeps), Field().at_least(1).at_most(1000).when("method", {"implicit"}).doc("most Gauss-Seidel sweeps in a step; most steps need fewer"));
    visit(FORMING_SIM_FIELD(max_halvings), Field().at_least(1).at_most(60).when("method", {"implicit"}).doc("most halvings of a step, with those of the steps before it that it has not risen from again, before the run ends with a named error"));
  }
};

}  // namespace forming_sim
