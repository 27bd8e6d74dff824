#pragma once
// How far the sheets of a model are on their way to the forming limit of their material (material/forming_limit.h), by the strains of their middle.
#include <vector>

#include "forming_sim/results/membrane.h"
#include "forming_sim/results/run_record.h"

namespace forming_sim {

/// The bodies whose material has a forming limit, in their order. Each has two sides (element/sheet_sides.h) with facets: a scene in which one has not is refused.
std::vector<const BodyModel*> with_forming_limit(const Model& model);

class FormingLimits {
 public:
  FormingLimits() = default;
  /// Throws Error(invalid_scene) where a body with a limit has no two sides.
  explicit FormingLimits(const Model& model);
  bool any() const { return !bodies_.empty(); }

  /// What the sheets have come to.
  struct State {
    std::vector<SurfaceStrain> strain;  ///< of the middle, per facet of the surface of all bodies; NaN where it is no side of such a sheet
    std::vector<double> ratio;          ///< of the limit, per node: the largest of the facets around it; between the sides that of the nearest of their nodes while it was free of stress; NaN on other bodies
    std::vector<Peak> greatest;         ///< ratio of each body, without time
    std::vector<double> beyond;         ///< of each body, the part of the area of its sides, free of stress, whose ratio is above 1
  };
  State at(const NodeField& positions) const;

 private:
  struct Body {
    FormingLimitConfig curve;
    int index = 0, first_node = 0;
    std::vector<int> nearest;  ///< per node of the body: of the sides, joined numbering
  };
  Membrane middle_;
  std::vector<Body> bodies_;
  std::vector<int> element_of_facet_;  ///< of the surface of all bodies
  int dimension_ = 3, node_count_ = 0;
};

}  // namespace forming_sim
