#pragma once
// Listed pairs in lanes, kLanes beside each other: their closest points (inside.h). Compiled once per vector width.
#include "forming_sim/tensor/isa.h"
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

/// PairShares of pairs.
struct alignas(64) SharesPack {
  double w[kLanes], area[kLanes], movers[kLanes], held[kLanes];  ///< area: the mean
};

/// Points and triangles; in the plane, points and segments.
struct alignas(64) FacePack {
  const int* corner[kLanes];                    ///< three nodes of each triangle, where the list has them
  double beta[kLanes], gamma[kLanes];           ///< found: weights of the second and third corner; of a segment the first alone
  double side[kLanes], s[kLanes];               ///< found: where on the border, if it is there; of triangles
  double apart[3][kLanes], squared[kLanes];     ///< found: from the closest point to the point, m; its square
  double inside[kLanes];                        ///< found: 1 where the closest point is inside the triangle, 0 where it is on its border
  int point[kLanes];                            ///< node
  SharesPack shares;                            ///< found; of those inside
};

/// Two edges each.
struct alignas(64) EdgePack {
  const int* node[kLanes];                      ///< eight of each pair, where the list has them: NearList::EdgePair::node
  double s[kLanes], t[kLanes];                  ///< found
  double distance[kLanes];                      ///< found, m
  double inside[kLanes];                        ///< found: 1 where the closest points are inside both; else all but the distance means nothing
  double normal[3][kLanes];                     ///< found: from the second to the first, length 1
  double outside[kLanes];                       ///< found: 1 where each, seen from the facets of the other, lies outside their slabs
  SharesPack shares;                            ///< found
};

struct ClosestKernels {
  /// places, shares: records of four doubles, one a node: x, and Share (pair.h).
  void (*faces)(const double* places, const double* shares, FacePack* packs, long count);
  void (*segments)(const double* places, const double* shares, FacePack* packs, long count);
  /// wedge: slope up to which facets count as level.
  void (*edges)(const double* places, const double* shares, double wedge, EdgePack* packs, long count);
};

const ClosestKernels& closest_kernels_of(Isa isa);

namespace sse2 { const ClosestKernels& closest_kernels(); }
namespace avx2 { const ClosestKernels& closest_kernels(); }
namespace avx512 { const ClosestKernels& closest_kernels(); }

}  // namespace forming_sim
