#pragma once
// What the fields of a scene say of each other. Each rule adds its faults.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/check.h"
#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// Names are there once, and can head a column or name a group of a file.
void check_names(const Scene& scene, FaultList& faults);
/// In dimension 2 vectors lie in the plane and rotations are about z.
void check_section(const Scene& scene, FaultList& faults);
/// What moves rigidly or acts on the whole of an axisymmetric scene goes along its axis.
void check_axisymmetric(const Scene& scene, FaultList& faults);
/// Where a body comes from, its material, what holds and loads it.
void check_bodies(const Scene& scene, FaultList& faults);
/// Where a tool's surface comes from, how it moves.
void check_tools(const Scene& scene, FaultList& faults);
/// Pairs name bodies and tools, each once; what says the same thing of the contact twice.
void check_contact(const Scene& scene, FaultList& faults);
/// Steps that fit each other, and a limit that all materials know.
void check_time_step(const Scene& scene, FaultList& faults);
/// Stages that refer to tools, probes that refer to bodies, frames.
void check_stages(const Scene& scene, FaultList& faults);
void check_output(const Scene& scene, FaultList& faults);

/// One mesh of a body or a tool: url or points, and cells that fit them.
void check_mesh(const MeshConfig& mesh, const std::string& path, int dimension, bool of_a_tool, FaultList& faults);
/// A part of an earlier run.
void check_formed(const FormedConfig& formed, const std::string& path, FaultList& faults);
/// Cells of a generated blank, as simplices.
double simplices_of(const BlankConfig& blank);

/// Times strictly increasing, and values as many as times where there are any.
void check_times(const std::vector<double>& times, const std::string& path, FaultList& faults);
template <class T>
void check_as_many(const std::vector<T>& values, const std::vector<double>& times, const std::string& path, FaultList& faults) {
  if (values.size() == times.size() || values.empty() || times.empty()) return;
  faults.add(path, std::to_string(values.size()) + " entries", "give one for each of the " + std::to_string(times.size()) + " times");
}

/// The name of the stage numbered `least` or of one after it, or empty. stages: named. Returns whether it is.
bool check_stage_name(const std::string& name, const std::vector<StageConfig>& stages, std::size_t least, const std::string& path, FaultList& faults);

/// Sets that a generated blank has.
std::vector<std::string> predefined_sets(const BlankConfig& blank);
/// Names of all sets of a body, where they are known without opening a file.
std::optional<std::vector<std::string>> known_sets(const BodyConfig& body);
/// What to say where a set does not exist.
void add_missing_set(const std::string& set, const std::string& body, const std::vector<std::string>& sets, const std::string& path, FaultList& faults);
/// Body that a probe is on: -1 where it does not exist.
int body_of(const ProbeConfig& probe, const Scene& scene);

/// "strip", "bodies[0]" and so on: paths of the parts of a scene.
inline std::string body_path(std::size_t i) { return join_path("bodies", i); }
inline std::string tool_path(std::size_t i) { return join_path("tools", i); }

}  // namespace forming_sim
