#pragma once
// The meshes of a scene, and the faults that only they can tell.
#include <string>
#include <vector>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/model.h"

namespace forming_sim {

struct Geometry {
  Model model;  ///< complete only without faults
  std::vector<Fault> faults;
};

/// Meshes every body and tool whose own fields are not among the `known` faults.
Geometry make_geometry(const Scene& scene, const std::vector<Fault>& known);

/// Refuses bodies and tools of sizes that betray a wrong unit scale; notes: bodies and tools whose sizes are odd. Only those
/// of the scene's bodies and tools that are meshed are looked at.
void check_sizes(const Scene& scene, const std::vector<Mesh>& bodies, const std::vector<Mesh>& tools, std::vector<Fault>& faults, std::vector<std::string>& notes);

/// Adds to the model's notes what a mesh of a body does not do that its author may expect of it.
void tell_odd_body(const BodyConfig& config, const BodyModel& body, Model& model);

/// Notes: values that are taken but look like wrong units or slips, and what of the scene lies behind the end of its stages.
void tell_odd_values(const Scene& scene, std::vector<std::string>& notes);

}  // namespace forming_sim
