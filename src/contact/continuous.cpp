#include "forming_sim/contact/continuous.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

// Nodes 0 ... split-1 against split ... count-1. closest(places) returns the
// vector from the closest point of the second to that of the first.
template <class ClosestVector>
bool meet(int split, int count, const Node* x, const Node* d, double least, ClosestVector&& closest) {
  Node at[4];
  double t = 0;
  for (int turn = 0; turn < 200; ++turn) {
    for (int k = 0; k < count; ++k) at[k] = x[k] + t * d[k];
    const Node apart = closest(at);
    const double distance = std::sqrt(dot3(apart, apart));
    if (!(distance > least)) return true;
    const Node n = apart / distance;
    double safe = 1 - t;  // until then n parts the features
    for (int i = 0; i < split; ++i)
      for (int j = split; j < count; ++j) {
        const double closing = dot3(n, d[j] - d[i]), gap = dot3(n, at[i] - at[j]);
        if (!(gap > 0))
          safe = 0;  // to rounding, the plane does not part them
        else if (closing * safe > gap)
          safe = gap / closing;
      }
    if (safe >= 1 - t) {
      // Parted to the end; but by how much?
      for (int k = 0; k < count; ++k) at[k] = x[k] + d[k];
      const Node end = closest(at);
      return !(dot3(end, end) > least * least);
    }
    // A shortest stride, so that rounding in `gap` does not stall it: no farther than the distance allows.
    double speed = 0;
    for (int i = 0; i < split; ++i)
      for (int j = split; j < count; ++j) speed = std::max(speed, (d[i] - d[j]).norm());
    t += std::max(0.95 * safe, 0.9 * (distance - 0.5 * least) / speed);
    if (t >= 1) {
      for (int k = 0; k < count; ++k) at[k] = x[k] + d[k];
      const Node end = closest(at);
      return !(dot3(end, end) > least * least);
    }
  }
  return true;
}

}  // namespace

bool point_meets_facet(int corners, const Node* x, const Node* d, double least) {
  return meet(1, 1 + corners, x, d, least, [corners](const Node* at) -> Node {
    const Closest c = corners == 2 ? closest_on_segment_facet(at[0], at[1], at[2]) : closest_on_triangle(at[0], at[1], at[2], at[3]);
    return c.apart;
  });
}

bool edges_meet(const Node* x, const Node* d, double least) {
  return meet(2, 4, x, d, least, [](const Node* at) -> Node {
    return closest_on_edges(at[0], at[1], at[2], at[3]).apart;
  });
}

}  // namespace forming_sim
