#pragma once
// What a user wants to see of a run.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A point or a set whose motion and stress go into history.csv.
struct ProbeConfig {
  std::string name;
  std::string body;
  Vec3 point = Vec3::Zero();
  std::string set;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(name), Field().required().doc("name of the probe; it heads its columns in history.csv"));
    visit(FORMING_SIM_FIELD(body), Field().computed("the first body").doc("body the probe is on"));
    visit(FORMING_SIM_FIELD(point), Field().unit("m").doc("the node nearest to this initial position is followed, unless a set is given"));
    visit(FORMING_SIM_FIELD(set), Field().doc("the mean over this set is followed"));
  }
};

/// Angle of the line through two probes, formed and released.
struct SpringbackConfig {
  std::string from, to, reference_from, reference_to;
  Vec3 normal = Vec3::Zero();
  bool has_reference() const { return !reference_from.empty() && !reference_to.empty(); }

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(from), Field().required().doc("probe at which the line starts"));
    visit(FORMING_SIM_FIELD(to), Field().required().doc("probe through which it goes; the angle is that of the line against the x axis in the x-y plane (dimension 2), in the x-z plane (3D) or in that of normal"));
    visit(FORMING_SIM_FIELD(reference_from), Field().computed("the x axis").doc("probe at which a second line starts, against which the angle counts: one on another leg of the part, which may turn as a whole"));
    visit(FORMING_SIM_FIELD(reference_to), Field().computed("the x axis").doc("probe through which the second line goes"));
    visit(FORMING_SIM_FIELD(normal), Field().computed("[0, -1, 0]: the x-z plane").doc("dimension 3: normal of the plane in which the angle is seen, that of a bend about [0, 0, 1] say; it counts in the right-hand sense about it, from the x axis, or from the y axis in a plane across x"));
  }
};

struct OutputConfig {
  double interval = 0;
  int frames = 50;
  double history_interval = 0;
  double checkpoint_interval = 0;
  bool formed = false;
  std::vector<ProbeConfig> probes;
  std::optional<SpringbackConfig> springback;

  template <class Visitor> static void declare(Visitor&& visit) {
    visit(FORMING_SIM_FIELD(interval), Field().unit("s").at_least(0).computed("time of the stages / frames; settle stages count for no more than the others together").doc("simulated time between frames of result.h5"));
    visit(FORMING_SIM_FIELD(frames), Field().at_least(1).at_most(1e5).doc("frames over the run, where interval is not given"));
    visit(FORMING_SIM_FIELD(history_interval), Field().unit("s").at_least(0).computed("a tenth of interval").doc("simulated time between rows of history.csv"));
    visit(FORMING_SIM_FIELD(checkpoint_interval), Field().unit("s").at_least(0).computed("only on cancel").doc("simulated time between checkpoints"));
    visit(FORMING_SIM_FIELD(formed), Field().doc("true: the bodies as the run leaves them go into formed.h5, from which a next scene goes on (bodies[].formed): let the tools go and the parts settle first"));
    visit(FORMING_SIM_FIELD(probes), Field().doc("points and sets to follow"));
    visit(FORMING_SIM_FIELD(springback), Field().doc("two probes whose line's angle is reported as formed and as released"));
  }
};

}  // namespace forming_sim
