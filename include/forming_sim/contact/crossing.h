#pragma once
// The independent check: what pierces what, whatever the contact believes.
#include <vector>

#include "forming_sim/contact/features.h"
#include "forming_sim/contact/list.h"

namespace forming_sim {

/// An edge of one surface that goes through a facet of another (2D: two
/// segments that cross), or, where facet < 0, a vertex behind a plane
/// (edge[1] = -1) or a part wholly inside a closed one (edge[0] a vertex of it).
/// surface, other: of a body, and of a tool or another body (or the same one).
struct Crossing {
  int surface = -1, other = -1;
  int edge[2] = {-1, -1};  ///< feature vertices
  int facet = -1;
};

/// present, is_plane, planes: per tool; place as for build_list.
std::vector<Crossing> find_crossings(const Features& features, const NodeField& x, const NodeField& place, const std::vector<bool>& present,
                                     const std::vector<bool>& is_plane, const std::vector<PlanePose>& planes);

/// A vertex of an edge of a body's surface that goes through a facet of the same surface; -1: none does.
int crossing_with_itself(const Features& features, int body, const NodeField& x);

/// Does segment pq go through the triangle abc (2D: cross the segment ab)? Its
/// border belongs to it where `border` is set; pq must pass, not only touch.
bool pierces(const Node& p, const Node& q, const Node& a, const Node& b, const Node& c, bool border);
bool segments_cross(const Node& p, const Node& q, const Node& a, const Node& b, bool border);

/// Of every facet of a tool (index: facet - first_facet): does it go through another one of the same tool?
std::vector<bool> facets_through_others(const Features& features, int surface);

/// The connected part of each facet of a surface, numbered from 0, and whether
/// the part is closed (no border).
struct Parts {
  std::vector<int> of_facet;  ///< index: facet - first_facet
  std::vector<bool> closed;
};
Parts find_parts(const Features& features, int surface);

}  // namespace forming_sim
