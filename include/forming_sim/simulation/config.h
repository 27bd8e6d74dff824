#pragma once
// What a user says of time: the step, damping, mass scaling, and the stages.
#include <string>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

constexpr int kLongestBoundInterval = 64;  ///< steps after which the elements' stable step is found again at the latest

struct TimeStepConfig {
  double safety = 0.9;
  double maximum = 0;
  std::string limit;  ///< element | node | global; empty: what suits the scene (default_limit in src/simulation/setup.cpp)
  double raise_to = 0;
  double raise_limit = 0.05;
  double linear_viscosity = 0;
  double quadratic_viscosity = 0;
  double damping = 0;
  double mass_scaling = 1;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(safety), Field().above(0).at_most(1).doc("fraction of the stable time step to take"));
    visit(FORMING_SIM_FIELD(maximum), Field().unit("s").at_least(0).computed("no limit but the stable step").doc("largest time step"));
    visit(FORMING_SIM_FIELD(limit), Field().choices({"element", "node", "global"}).computed("global; element where a body starts with a velocity, node where a body's law is classical")
          .doc("what the stable step is taken from. element: the fastest cell as if it stood alone, proven; node: the cells around each node together, proven too, longer where small cells lie among large ones; global: the fastest swing of the whole mesh, found by a random Lanczos run now and then and guarded by the cells in between, 1.2 to 2 times element on even meshes; not with the classical law. Its limit, and with it the last digits of a result, change a little with rounding, and so with how a scene is turned"));
    visit(FORMING_SIM_FIELD(raise_to), Field().unit("s").at_least(0).computed("no mass is added")
          .doc("step that the run is to take at least: nodes around which the stable step at the start, times safety, is shorter get as much mass as that asks for. Gravity does not act on it. Cells that are squeezed later shorten the step again; with it, limit: element works as node"));
    visit(FORMING_SIM_FIELD(raise_limit), Field().above(0).at_most(100).doc("largest mass that raise_to may add, over the mass of all bodies; a scene that needs more is refused"));
    visit(FORMING_SIM_FIELD(linear_viscosity), Field().at_least(0).at_most(2).doc("coefficient b1 of the bulk viscosity q = rho b1 c l D in compression and tension, D the volume rate; 0.06 is usual for impacts, 0: none"));
    visit(FORMING_SIM_FIELD(quadratic_viscosity), Field().at_least(0).at_most(10).doc("coefficient b2 of the bulk viscosity q = rho (b2 l D)^2 in compression; 1.2 is usual for shocks, 0: none"));
    visit(FORMING_SIM_FIELD(damping), Field().unit("1/s").at_least(0).doc("mass-proportional damping alpha: dv/dt = f/m - alpha v; 0: none"));
    visit(FORMING_SIM_FIELD(mass_scaling), Field().above(0).at_most(1e6).doc("factor on all masses: the step grows with its square root, inertia with the factor, weight not at all; judge it by kinetic over internal energy"));
  }
};

struct StageConfig {
  std::string name;
  std::string kind;             ///< form | withdraw | settle
  double duration = 0;
  std::string until_stopped;
  std::vector<std::string> tools;
  Vec3 displacement = Vec3::Zero();
  double kinetic_fraction = 1e-5;
  double limit = 0;
  std::string ends = "rest";
  std::string release = "gradual";
  double release_time = 0;

  /// As it is called in feedback and files.
  const std::string& title() const { return name.empty() ? kind : name; }

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(name), Field().computed("the kind; of the second of a kind with _2, and so on").doc("name of the stage in feedback and files, and by which since and until mean it"));
    visit(FORMING_SIM_FIELD(kind), Field().required().choices({"form", "withdraw", "settle"})
          .doc("form: run for a duration; withdraw: the tools move away from where they stand, then they are gone; settle: damping adapted to the body's own slowest swing until it rests"));
    visit(FORMING_SIM_FIELD(duration), Field().unit("s").above(0).required().when("kind", {"form", "withdraw"}).doc("length of the stage in simulated time"));
    visit(FORMING_SIM_FIELD(until_stopped), Field().when("kind", {"form"}).computed("the stage lasts for its duration").doc("name of a tool whose motion has a stop_force: the stage ends when the tool has stopped, and after its duration at the latest; a tool that has stopped before ends it at once. What is to begin with a later stage says so with since: times without it count from the start of the run"));
    visit(FORMING_SIM_FIELD(tools), Field().when("kind", {"withdraw"}).computed("all tools").doc("tools that leave"));
    visit(FORMING_SIM_FIELD(displacement), Field().unit("m").when("kind", {"withdraw"}).doc("how far the tools move from where they stand, smoothly; [0, 0, 0]: they are gone at once"));
    visit(FORMING_SIM_FIELD(kinetic_fraction), Field().above(0).below(1).when("kind", {"settle"}).doc("the bodies rest when the kinetic energy of each, and the energy that forces out of balance could still set free in it, stay below this fraction of its elastic energy, or of a millionth of the largest energy that it has had in the stage where that is more"));
    visit(FORMING_SIM_FIELD(limit), Field().unit("s").above(0).required().when("kind", {"settle"}).doc("longest time of the stage; when it is reached before the bodies rest, the outcome is limit_reached"));
    visit(FORMING_SIM_FIELD(ends), Field().choices({"rest", "limit"}).when("kind", {"settle"}).doc("rest: when the bodies rest; limit: at limit, also where they rest before it, so that it is known when later stages begin (what has since needs no such); that the bodies do not rest then is a warning, and of the last stage the outcome limit_reached"));
    visit(FORMING_SIM_FIELD(release), Field().choices({"gradual", "sudden"})
          .doc("how tools that are gone, and boundaries whose until it is, let go of the bodies when the stage begins: gradual: tools that squeeze a body recede until they do so no more, in a third of release_time, and the forces that then still hold it fade (where bodies give way and they would drive them on they are gone at once, which is told); sudden: they are gone in one step, and the wave that this sends out may make a body flow that springs back"));
    visit(FORMING_SIM_FIELD(release_time), Field().unit("s").at_least(0).when("release", {"gradual"}).computed("the period of the slowest swing of the largest body that is let go, if it were held at one end, 6.2 L^2/(t c), and no more than a quarter of the time until the end of the next settle stage, or until the next form stage begins; of boundaries that end in a stage in which tools that press on the body move away, no more than a twentieth of that stage; where they end while what tools bore still fades, with that; none where no body is plastic, or one flies or gathers speed").doc("time in which these forces fade; 0: as by default"));
  }
};

}  // namespace forming_sim
