#include "forming_sim/config/words.h"
#include "rules.h"

namespace forming_sim {

void check_time_step(const Scene& scene, FaultList& faults) {
  const TimeStepConfig& step = scene.time_step;
  if (step.maximum > 0 && step.raise_to > step.maximum)
    faults.add("time_step.raise_to", given_text(step.raise_to), "give at most time_step.maximum, " + number_text(step.maximum) + " s: no step is longer than that");
  if (step.limit != "global") return;
  for (const BodyConfig& body : scene.bodies)
    if (body.material.law == "classical")
      faults.add("time_step.limit", given_text(step.limit), "give element or node: the law of body " + body.name + " is classical, which has no tangent of its own to iterate with");
}

}  // namespace forming_sim
