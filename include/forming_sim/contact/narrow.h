#pragma once
// From listed features to the pairs that may carry force in this step.
//
// A vertex meets a facet, an edge or a vertex of the other surface where its
// distance to that surface is a local minimum: a face inside its borders, an
// edge where it is the closest point of all facets at that edge, a vertex
// likewise. So a vertex exactly over a shared edge has one pair, and one in a
// groove has a pair with each wall. Two edges meet where their closest points
// lie inside both and they are not parallel.
#include <limits>
#include <memory>
#include <vector>

#include "forming_sim/contact/constants.h"
#include "forming_sim/contact/layers.h"
#include "forming_sim/contact/list.h"
#include "forming_sim/parallel/team.h"

namespace forming_sim {

/// How far a step looks.
struct Range {
  double reach;    ///< pairs nearer than this are found, m
  double closing;  ///< bound on how much nearer any two features come in the step, m
  double travel;   ///< bound on all relative motion since the list was built, m
  double thickest = std::numeric_limits<double>::infinity();  ///< of all layers, m; while it is not known nothing counts as at rest
  double dt = 0;         ///< of the step, s; 0: no pair is set aside
};

/// A listed vertex-facet or edge-edge pair near enough to be met in this step.
struct ClosePair {
  int entry;        ///< index in NearList::facets or watched
  int group;        ///< index in NearList::groups; -1: edges
  double distance;  ///< now, m

  ClosePair(int entry_of_list, int group_of_list, double now) : entry(entry_of_list), group(group_of_list), distance(now) {}
};

/// A pair that as things stand is out of its layer all the step: it bears nothing, unless what others bear pushes it in.
struct AsidePair : Link {
  Node normal = Node::Zero();  ///< as those of ContactPair
  double gap = 0, layer = 0;

  AsidePair(const Link& link, const Node& along, double h, double h0) : Link(link), normal(along), gap(h), layer(h0) {}
};

struct NarrowRoom;  // what the search fills on its way (src/contact/narrow.cpp)

struct Narrow {
  LargeArray<ContactPair> pairs;   ///< in the order of their keys, each once
  std::vector<long> born;          ///< which of them are new and inside their layer
  std::vector<long> unmovable;     ///< which of them nothing can move
  std::vector<Rub> rubs;           ///< of those that rub
  LargeArray<AsidePair> aside;     ///< beside these
  std::vector<ClosePair> close;    ///< for the continuous check: those that can touch in this step
  std::vector<Narrow> shares;      ///< what the other threads of a team find, before it is joined to the above

  std::shared_ptr<NarrowRoom> room;  ///< used again from step to step

  void clear();
};

/// All pairs nearer than `reach`. Entries that were farther than reach + the
/// distance travelled since they were last looked at are skipped. What is at rest is no pair: where nodes that are held lie at
/// tools that do not move, or at each other, out of their layers, nothing happens. It need not be looked at to know that.
/// Where one of the two features is not the nearest of its own surface (another
/// corner or facet of it lies nearer to the other's point) the layer is half as
/// thick: such a pair pushes askew, and is needed only where nothing else has
/// held. It counts only once it is inside its layer: where a fast step would end
/// along a frozen, askew normal says little. `all`: without this restriction
/// (for a step that met something). Without `all`, and where range.dt is given, pairs that are out of their layers now and will be at the end of the
/// step, as far as Workspace::v tells, go to Narrow::aside: sheets that lie on each other have ten such pairs for one that bears something. The pairs have geometry, key and constants and, where `layers` are given, what
/// these give but for what is handed over.
void narrow_phase(const PairConstants& constants, const Layers* layers, const std::vector<PlanePose>& planes, bool all, const Range& range, Team& team,
                  NearList& list, Narrow& result);

/// Adds the pairs of vertices with the planes that they are nearer to than `reach`, or behind, but for those at rest;
/// geometry and key only.
void add_plane_pairs(const Features& features, const Workspace& work, const std::vector<PlanePose>& planes, const Range& range,
                     const NearList& list, LargeArray<ContactPair>& pairs);

/// In the order of their keys, each once.
void put_in_order(LargeArray<ContactPair>& pairs);

}  // namespace forming_sim
