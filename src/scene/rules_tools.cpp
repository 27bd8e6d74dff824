#include <algorithm>
#include <cmath>

#include "forming_sim/loads/course.h"
#include "forming_sim/loads/drive.h"
#include "forming_sim/simulation/release.h"
#include "rules.h"

namespace forming_sim {

namespace {

void check_source(const ToolConfig& tool, const std::string& path, int dimension, FaultList& faults) {
  const bool plane = !tool.normal.isZero(0);
  std::vector<std::string> given;
  if (tool.mesh) given.push_back("mesh");
  if (tool.profile) given.push_back("profile");
  if (plane) given.push_back("normal");
  if (given.size() != 1) {
    faults.add(path, given.empty() ? "none of mesh, profile and normal (a normal of length 0 is none)" : one_of(given, " and "),
               "give exactly one: mesh (the surface of a tool in 3D), profile (its section, in 3D swept), or normal (a rigid plane)");
  }
  if (!plane && !tool.point.isZero(0) && !given.empty()) faults.add(path + ".point", given_text(tool.point), "leave it out: it belongs to a rigid plane, which has a normal; position moves a mesh or profile");
  if (tool.mesh) {
    if (dimension == 2) faults.add(path + ".mesh", "a mesh in dimension 2", "give a profile or a normal, or set dimension to 3");
    check_mesh(*tool.mesh, path + ".mesh", dimension, true, faults);
  }
  if (tool.profile && dimension == 3 && tool.profile->sweep.empty())
    faults.add(path + ".profile.sweep", "none, for a profile in dimension 3", "give turned (about the axis z) or straight (along y)");
  if (tool.profile && dimension == 2 && !tool.profile->sweep.empty())
    faults.add(path + ".profile.sweep", given_text(tool.profile->sweep), "leave it out: in dimension 2 a profile is all of the tool. Or set dimension to 3");
}

void check_motion(const MotionConfig& motion, const std::string& path, FaultList& faults) {
  check_times(motion.times, path + ".times", faults);
  const bool trajectory = motion.kind == "trajectory";
  if (trajectory && motion.positions.empty() && motion.rotations_deg.empty()) {
    faults.add(path, "a trajectory without positions and rotations_deg", "give at least one of them, an entry for each time");
  }
  if (trajectory && motion.times.size() == 1) {
    faults.add(path + ".times", "one time", "give at least two: a trajectory goes from one to the next");
  }
  const bool turns_freely = motion.turns_freely();
  if (motion.kind == "velocity" && motion.velocities.empty() && motion.spins_deg_s.empty() && !turns_freely) {
    faults.add(path, "a velocity without velocities and spins_deg_s", "give at least one of them, an entry for each time, or an axle about which it turns freely");
  }
  if (motion.by_force() && motion.by_places() && (!motion.velocities.empty() || !motion.spins_deg_s.empty()))
    faults.add(path, "positions or rotations_deg beside velocities or spins_deg_s", "give one of both: places and orientations, or velocities and spins");
  if (motion.kind != "trajectory" && motion.profile == "spline") {
    faults.add(path + ".profile", given_text(motion.profile), "give smooth or linear: a spline is for trajectories");
  }
  check_as_many(motion.positions, motion.times, path + ".positions", faults);
  check_as_many(motion.rotations_deg, motion.times, path + ".rotations_deg", faults);
  check_as_many(motion.velocities, motion.times, path + ".velocities", faults);
  check_as_many(motion.spins_deg_s, motion.times, path + ".spins_deg_s", faults);
  check_as_many(motion.forces, motion.times, path + ".forces", faults);
  check_as_many(motion.torques, motion.times, path + ".torques", faults);
  if (turns_freely) {
    // What is told takes the axle along. All of it about the axle would be for nothing.
    const auto about_it = [&](const std::vector<Vec3>& turns, const char* field) {
      const Vec3 axle = motion.axle.stableNormalized();
      const auto turned = std::find_if(turns.begin(), turns.end(), [](const Vec3& turn) { return !turn.isZero(0); });
      if (turned == turns.end() || !axle.allFinite()) return;
      if (std::any_of(turns.begin(), turns.end(), [&](const Vec3& turn) { return !turn.allFinite() || !goes_along(turn, axle); })) return;
      faults.add(join_path(path + "." + field, static_cast<std::size_t>(turned - turns.begin())), given_text(*turned) + ", about the axle, about which the tool turns freely", "leave out the axle of a tool that is turned, and what turns about the axle of an idle one");
    };
    if (motion.stop_force > 0 && !goes(motion) && motion.rotations_deg.empty() && motion.spins_deg_s.empty())
      faults.add(path + ".stop_force", given_text(motion.stop_force) + " of a tool that goes nowhere", "leave it out: what turns freely is stopped by nothing but what touches it");
    about_it(motion.rotations_deg, "rotations_deg");
    about_it(motion.spins_deg_s, "spins_deg_s");
    if (!motion.torques.empty() && trajectory && motion.profile == "spline") faults.add(path + ".profile", given_text(motion.profile), "give smooth or linear: with torques there is no spline");
  } else {
    const auto without = [&](bool given, const char* field, const std::string& value) {
      if (given) faults.add(path + "." + field, value + " without an axle", "give the axle about which the tool turns freely, or leave this out");
    };
    without(!motion.torques.empty(), "torques", given_text(static_cast<double>(motion.torques.size())) + " values");
    without(motion.initial_spin_deg_s != 0, "initial_spin_deg_s", given_text(motion.initial_spin_deg_s));
    without(motion.inertia != 0, "inertia", given_text(motion.inertia));
    without(motion.spin_damping != 0, "spin_damping", given_text(motion.spin_damping));
  }
  const Vec3 guide = guide_of(motion);
  if (!motion.forces.empty() && guide.isZero(0))
    faults.add(path + ".forces", "no force other than 0, no guide and no initial_velocity", "give one of them; a tool without any rests, and needs no motion");
  if (guide.allFinite() && motion.initial_velocity.allFinite() && !goes_along(motion.initial_velocity, guide))
    faults.add(path + ".initial_velocity", given_text(motion.initial_velocity), "give it along the guide, which goes along the forces where none is given");
  constexpr double kAlong = 1e-6;  // of the longest: paths of robots are rounded
  if (motion.stiffness > 0 && guide.allFinite() && !motion.positions.empty() && std::abs(motion.positions.front().dot(guide)) > kAlong * motion.positions.front().norm())
    faults.add(path + ".positions[0]", given_text(motion.positions.front()) + ", in part along the guide", "give 0 along the guide at first, where the tool stands and its spring is slack: what it is pressed with there is told in forces");
  if (motion.by_force() && motion.stiffness == 0 && guide.allFinite() && !guide.isZero(0)) {
    const auto across = [&](const std::vector<Vec3>& values, const char* field) {
      double longest = 0;
      for (const Vec3& value : values) longest = std::max(longest, value.norm());
      faults.each(values, [&](std::size_t i) {
        if (std::abs(values[i].dot(guide)) > kAlong * longest)
          faults.add(join_path(path + "." + field, i), given_text(values[i]) + ", in part along the guide of the tool", "give what goes across that alone, or a stiffness: along it the tool goes where its forces and the bodies push it");
      });
    };
    across(motion.positions, "positions");
    across(motion.velocities, "velocities");
  }
  faults.each(motion.forces, [&](std::size_t i) {
    if (motion.forces[i].allFinite() && guide.allFinite() && !goes_along(motion.forces[i], guide))
      faults.add(join_path(path + ".forces", i), given_text(motion.forces[i]), "give all forces along one line, the guide, if one is given");
  });
}

void check_approach(const Scene& scene, std::size_t i, FaultList& faults) {
  const ApproachConfig& approach = *scene.tools[i].approach;
  std::vector<std::string> names;
  for (const BodyConfig& body : scene.bodies) names.push_back(body.name);
  for (std::size_t k = 0; k < i; ++k) names.push_back(scene.tools[k].name);
  faults.each(approach.to, [&](std::size_t k) {
    if (std::find(names.begin(), names.end(), approach.to[k]) == names.end())
      faults.add(join_path(tool_path(i) + ".approach.to", k), given_text(approach.to[k]), "give a body, or a tool before this one in the list: " + one_of(names, ", ") + did_you_mean(approach.to[k], names));
  });
}

}  // namespace

void check_tools(const Scene& scene, FaultList& faults) {
  const std::vector<StageConfig> stages = named(scene.stages);
  for (std::size_t i = 0; i < scene.tools.size(); ++i) {
    const ToolConfig& tool = scene.tools[i];
    check_source(tool, tool_path(i), scene.dimension, faults);
    if (tool.motion && tool.motion->by_force() && scene.contact.method != "implicit")
      faults.add(tool_path(i) + ".motion.kind", "force, with contact.method " + given_text(scene.contact.method), "set contact.method to implicit: only that finds how fast the tool goes together with what presses on it");
    if (tool.approach) check_approach(scene, i, faults);
    if (!tool.motion) continue;
    const std::string axle = tool_path(i) + ".motion.axle";
    const Vec3& along = tool.motion->axle;
    if (!along.isZero(0)) {
      if (scene.contact.method != "implicit")
        faults.add(axle, given_text(along) + ", with contact.method " + given_text(scene.contact.method), "set contact.method to implicit: only that finds how fast the tool turns together with what presses on it");
      if (!tool.normal.isZero(0)) faults.add(axle, given_text(along) + " of a plane", "give the tool a mesh or a profile: what turns freely has a shape about its axle");
      if (scene.dimension == 2 && !scene.axisymmetric && (along.x() != 0 || along.y() != 0)) faults.add(axle, given_text(along), "in dimension 2 give [0, 0, 1]");
    }
    check_motion(*tool.motion, tool_path(i) + ".motion", faults);
    const std::string since = tool_path(i) + ".motion.since";
    if (tool.motion->since.empty() || !check_stage_name(tool.motion->since, stages, 0, since, faults)) continue;
    for (int k = 0; k <= first_stage(tool.motion->since, stages); ++k)
      if (takes_away(stages[k], tool.name)) faults.add(since, given_text(tool.motion->since), "name a stage before " + stages[k].name + ", which takes the tool away");
  }
}

}  // namespace forming_sim
