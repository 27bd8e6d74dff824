// An axisymmetric scene is a section that is turned about the y axis: what is rigid, and
// what acts on the whole, goes along that axis.
#include "rules.h"

namespace forming_sim {

namespace {

const char* const kAlongY = "give [0, y, 0]: in an axisymmetric scene it acts along the axis y";

class Rules {
 public:
  explicit Rules(FaultList& faults) : faults_(faults) {}

  void along_axis(const Vec3& value, const std::string& path, const char* remedy = kAlongY) {
    if (value.x() != 0 && value.allFinite()) faults_.add(path, given_text(value), remedy);
  }
  void no_turn(const Vec3& value, const std::string& path) {
    if (!value.isZero(0) && value.allFinite()) faults_.add(path, given_text(value), "leave it out: a section that turned would be no ring any more, and nothing spins about the axis y here; what spins takes dimension 3");
  }
  void motion(const MotionConfig& motion, const std::string& path) {
    const char* remedy = "give [0, y, 0]: a rigid ring moves along the axis y only";
    faults_.each(motion.positions, [&](std::size_t i) { along_axis(motion.positions[i], join_path(path + ".positions", i), remedy); });
    faults_.each(motion.velocities, [&](std::size_t i) { along_axis(motion.velocities[i], join_path(path + ".velocities", i), remedy); });
    faults_.each(motion.forces, [&](std::size_t i) { along_axis(motion.forces[i], join_path(path + ".forces", i), remedy); });
    along_axis(motion.initial_velocity, path + ".initial_velocity", remedy);
    along_axis(motion.guide, path + ".guide", remedy);
    no_turn(motion.axle, path + ".axle");
    faults_.each(motion.rotations_deg, [&](std::size_t i) { no_turn(motion.rotations_deg[i], join_path(path + ".rotations_deg", i)); });
    faults_.each(motion.spins_deg_s, [&](std::size_t i) { no_turn(motion.spins_deg_s[i], join_path(path + ".spins_deg_s", i)); });
  }

 private:
  FaultList& faults_;
};

}  // namespace

void check_axisymmetric(const Scene& scene, FaultList& faults) {
  if (!scene.axisymmetric) return;
  if (scene.dimension == 3) faults.add("axisymmetric", "true in dimension 3", "set dimension to 2: the section in the x-y plane is turned about the axis y");
  Rules rules(faults);
  rules.along_axis(scene.gravity, "gravity");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyConfig& body = scene.bodies[i];
    rules.along_axis(body.initial_velocity, body_path(i) + ".initial_velocity");
    rules.no_turn(body.initial_spin_deg_s, body_path(i) + ".initial_spin_deg_s");
    if (body.formed) {
      rules.along_axis(body.formed->shift, body_path(i) + ".formed.shift", "give [0, y, 0]: a ring is shifted along its axis");
      if (!body.formed->turn_deg.isZero(0)) faults.add(body_path(i) + ".formed.turn_deg", given_text(body.formed->turn_deg), "leave it out, and turn the tools over instead: a section stays beside its axis");
    }
    for (std::size_t k = 0; k < body.boundaries.size(); ++k) {
      const auto no_turns = [&](const std::vector<Vec3>& turns, const char* field) {
        faults.each(turns, [&](std::size_t n) { rules.no_turn(turns[n], join_path(join_path(body_path(i) + ".boundaries", k) + field, n)); });
      };
      no_turns(body.boundaries[k].spins_deg_s, ".spins_deg_s");
      no_turns(body.boundaries[k].rotations_deg, ".rotations_deg");
    }
  }
  for (std::size_t i = 0; i < scene.tools.size(); ++i) {
    const ToolConfig& tool = scene.tools[i];
    if (tool.approach) rules.along_axis(tool.approach->along, tool_path(i) + ".approach.along", "give [0, y, 0]: a rigid ring moves along the axis y only");
    if (tool.motion) rules.motion(*tool.motion, tool_path(i) + ".motion");
  }
  for (std::size_t i = 0; i < scene.stages.size(); ++i)
    rules.along_axis(scene.stages[i].displacement, join_path("stages", i) + ".displacement");
  if (scene.contact.method == "geometric")
    faults.add("contact.method", given_text(scene.contact.method), "give implicit or explicit: contact by geometry alone knows no surface that ends on an axis");
}

}  // namespace forming_sim
