#pragma once
// Which features are near enough to be watched: built now and then with a
// margin, good until the margin is used up.
#include <limits>
#include <vector>

#include "forming_sim/contact/encounters.h"
#include "forming_sim/contact/pair.h"

namespace forming_sim {

struct NearList {
  struct FacetEntry {
    int facet;
    int node[3];               ///< corners in the workspace
    double wake;               ///< need not be looked at while travel + reach <= wake
  };
  /// A vertex and all facets of one other surface within the radius.
  struct VertexGroup {
    int vertex, node;          ///< feature vertex, place in the workspace
    int surface;
    int first, last;           ///< of `facets`
    int near_first, near_last; ///< of `neighbours`
    double wake;               ///< the least of its facets
    double rest = 0;           ///< least distance when it was last looked at, if all of it stood then, m: need not be looked at while it still stands, out of all layers
  };
  struct EdgePair {
    int first, second;         ///< edges
    int own, surface;          ///< theirs
    int node[8];               ///< ends of the first and of the second; third corners of the first two facets at either, where there is none an end of the edge
    int listed;                ///< index in `edges`
    double wake;               ///< as of facets; counts where the pair is watched
    double rest = 0;           ///< as of groups; counts where the pair is watched
  };
  struct PlanePair {
    int vertex, node, foot;    ///< foot: place in the workspace of the plane's nearest point
    int tool;
  };
  /// A tie between bodies, or with a tool that is present.
  struct TieEntry {
    int tie;
    int node[4];               ///< as the tie's; of one to a tool the second is the foot: the place on the tool
  };
  LargeArray<FacetEntry> facets;
  LargeArray<int> neighbours; ///< of the groups' vertices, in the workspace
  LargeArray<VertexGroup> groups;
  LargeArray<EdgePair> edges;
  LargeArray<double> edge_wake;   ///< of each of them that is not watched, as of facets
  LargeArray<EdgePair> watched;   ///< those of them that can come near while travel + reach <= watched_until, in the same order
  double watched_until = -std::numeric_limits<double>::infinity();
  std::vector<PlanePair> planes;
  std::vector<TieEntry> ties;
  double radius = 0;           ///< every pair of features not in here was farther apart, m

  /// Watches all that `reach` asks for, and as much again.
  void watch(double reach, double travel);

  long size() const { return static_cast<long>(facets.size() + edges.size() + planes.size() + ties.size()); }
};

/// Lists all pairs of features within `radius` of a body and a tool, of two
/// bodies, and of a body and itself where it meets itself and the features share no node;
/// numbers the workspace (vertex, body_entries; the feet of planes, then those of ties, stand last).
NearList build_list(const Features& features, const NodeField& x, const PlacedTools& tools, const std::vector<Tie>& ties, double radius, Workspace& work);

}  // namespace forming_sim
