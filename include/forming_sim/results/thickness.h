#pragma once
// Thickness of the sheets of a model, of the bodies that have two sides (element/sheet_sides.h), here called top and bottom: distance of the nodes of
// `top` from the surface whose facets have all their nodes in `bottom`, through the metal: where a sheet curls up its top meets its own
// bottom, of which what lay farther off at the start counts only straight across the metal.
#include <array>
#include <optional>
#include <vector>

#include "forming_sim/simulation/model.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Whose thickness and surface strain are asked for: rubber only where there is nothing else.
bool is_formed(const Model& model, const BodyModel& body);

/// The smallest of the values that are not NaN, of all or of these nodes; none: nullopt.
std::optional<double> smallest(const std::vector<double>& values);
std::optional<double> smallest(const std::vector<double>& values, const std::vector<int>& nodes);

class Thickness {
 public:
  Thickness() = default;
  explicit Thickness(const Model& model);
  bool any() const { return !sheets_.empty(); }
  /// Nodes of `top` of all sheets that are formed.
  std::vector<int> top() const;

  /// Per node of the model, m: that of a node of `top`, and below it that of the nearest node of `top` at the start.
  /// NaN on bodies that are no sheets, or are lost to numbers that are not finite, and where the bottom has been trimmed away. Positions in the joined numbering.
  std::vector<double> at(const NodeField& positions) const;
  std::optional<double> initial(const std::vector<int>& nodes) const { return smallest(start_, nodes); }  ///< the least at the start, m
  /// 1 - t/t0 of what at() gave, t0 while the body was free of stress: 0.2 where a fifth is gone, below 0 where the sheet is thicker.
  std::vector<double> thinning(const std::vector<double>& thickness) const;

 private:
  struct Sheet {
    int body = 0, first_node = 0;
    bool formed = true;
    std::vector<int> top;
    int corners = 3;                         ///< of a facet
    std::vector<std::array<int, 3>> bottom;  ///< a segment repeats its second node
    std::vector<int> above;                  ///< per node of the body: place in top
    std::vector<int> below;                  ///< per node of top: a facet of bottom that lay near it at the start
    std::vector<Vec3> top_start, bottom_start;  ///< where they were, of facets their first nodes, m
    std::vector<char> stands;                ///< per node of top: some of bottom was below it; else it has no thickness
    std::vector<double> reach;               ///< per node of top: of a facet that counts, from start to start, m
  };
  bool find_overhangs(const Model& model, const NodeField& start, Sheet& sheet) const;
  std::vector<Sheet> sheets_;
  std::vector<double> start_;  ///< at() of the start
};

}  // namespace forming_sim
