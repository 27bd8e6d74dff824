#pragma once
// What does not change while a scene runs: the joined mesh of all bodies, their
// materials, the tools in their own frames. Built by scene/build.h.
#include <string>
#include <vector>

#include "forming_sim/element/body.h"
#include "forming_sim/loads/tool.h"

namespace forming_sim {

struct Model {
  int dimension = 3;
  bool axisymmetric = false;       ///< dimension 2: the section is turned about the y axis; its meshes are closed at the axis (mesh/axis.h)
  std::vector<BodyModel> bodies;
  std::vector<ToolModel> tools;
  std::vector<std::string> notes;  ///< what was mended or looks odd in the meshes; said with the warnings of a run

  /// Forces, masses and energies count per metre of width: plane strain.
  bool per_width() const { return dimension == 2 && !axisymmetric; }
  /// The first body of the classical law, which has no elastic tangent to iterate with
  /// (simulation/fastest_swing.h); null: there is none.
  const BodyModel* without_tangent() const {
    for (const BodyModel& body : bodies)
      if (body.material.law == "classical") return &body;
    return nullptr;
  }
  int node_count() const { return bodies.empty() ? 0 : bodies.back().first_node + bodies.back().node_count; }
  int element_count() const { return bodies.empty() ? 0 : bodies.back().first_element + bodies.back().element_count; }
};

}  // namespace forming_sim
