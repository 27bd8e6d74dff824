#pragma once
// The rigid tools as contact sees them: set back by h0 so that the layer ends
// on the surface the user gave, and backed off where a body touches at the start.
#include <string>
#include <vector>

#include "forming_sim/contact/encounters.h"
#include "forming_sim/contact/features.h"
#include "forming_sim/contact/flush.h"

namespace forming_sim {

struct ToolSet {
  std::vector<bool> is_plane;
  std::vector<Vec3> point, normal;   ///< of planes, in the tool's frame, set back
  std::vector<std::string> names;
  std::vector<bool> touching;        ///< a body at the start (check_start)

  /// Places of all tool vertices with the tools at position0, rotation0.
  void place_all(const Features& features, const std::vector<ToolMotion>& motion, NodeField& place) const;
  std::vector<PlanePose> planes(const std::vector<ToolMotion>& motion) const;
  /// The same in the memory of others.
  void place_planes(const std::vector<ToolMotion>& motion, std::vector<PlanePose>& planes) const;
  static std::vector<bool> present(const std::vector<ToolMotion>& motion);
};

/// Where the bodies are, found from their places for patches of facets that hang together without
/// forks and folds. Nodes nearer to a tool than 3 layers are not asked.
struct Sides {
  std::vector<int> of_facet;  ///< +1 the side of the normal (corners in rising order; 2D: to the right of rising), -1 the other, 0 both or unknown
  std::vector<bool> unknown;  ///< per tool: bodies see a patch of it that has no side
};
Sides find_sides(double layer, const Features& features, const NodeField& x, const std::vector<ToolMotion>& at_start);

/// Unit normal of the triangle abc (2D: of the segment ab, to its right); zero for one without area.
Node facet_normal(int dimension, const Node& a, const Node& b, const Node& c);

/// Of h0: how far apart is put what touches. On the edge of a layer rounding would decide what is in it.
constexpr double kOutside = 1 + 1e-6;

/// Moves the tools' vertices (features.place) and planes by `layer` away from
/// the bodies, so that every facet moves by `layer` along its normal.
/// Warns of patches with bodies on both sides, which stay where they are but for their rim. What faces the other tool of a joint stays there.
void set_back(double layer, const Sides& sides, const Flush& flush, const ContactSetup& setup, Features& features, ToolSet& tools,
              std::vector<std::string>& warnings);

/// How the bodies stand to each other at the start.
struct BodiesAtStart {
  double clearance = 0;     ///< smallest distance of two that stand within some layers of each other and do not touch, m; 0 where there are none
  bool in_one_pack = true;  ///< each touches another, or is tied to it, and all hang together so
};
BodiesAtStart look_at_bodies(double layer, const ContactSetup& setup, const Features& features, const NodeField& x);

/// Moves bodies apart (x, by so much a body, reported in warnings) that touch each
/// other or overlap by no more than a layer, until none is nearer than the layer.
std::vector<Vec3> part_bodies(double layer, const ContactSetup& setup, const Features& features, NodeField& x,
                              std::vector<std::string>& warnings);

/// Backs off tools that overlap a body by no more than 2 layers (before they
/// were set back), those that hang together as one where there is a way, reported in warnings; else they have no joints any more.
/// Throws Error(initial_penetration) with the deeper ones.
void check_start(double layer, const std::vector<int>& sides, Flush& flush, const ContactSetup& setup, const NodeField& x,
                 const std::vector<ToolMotion>& at_start, Features& features, ToolSet& tools, std::vector<std::string>& warnings);

}  // namespace forming_sim
