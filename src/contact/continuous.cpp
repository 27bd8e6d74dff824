#include "forming_sim/contact/continuous.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

// Features that touch lie in one plane (2D: on one line). While the nodes move in straight lines, the volume that the
// four of them span is a cubic of time (2D: the area of the three a quadratic). Where its Bernstein coefficients have
// one sign it is never zero. True: certainly no touch between the places p and q.
bool stay_apart(int count, const Node* p, const Node* q) {
  Node e[3][2];  // edges from node 0, at p and at q
  double size = 1;
  for (int k = 1; k < count; ++k) {
    e[k - 1][0] = p[k] - p[0];
    e[k - 1][1] = q[k] - q[0];
    size *= e[k - 1][0].norm() + e[k - 1][1].norm();
  }
  const double rounding = 1e-14 * size;
  double coefficient[4] = {0, 0, 0, 0};
  for (int i = 0; i < 1 << (count - 1); ++i) {  // bit k: edge k at q
    const Node &a = e[0][i & 1], &b = e[1][i >> 1 & 1];
    const double volume = count == 3 ? a[0] * b[1] - a[1] * b[0] : dot3(cross3(a, b), e[2][i >> 2 & 1]);
    coefficient[(i & 1) + (i >> 1 & 1) + (i >> 2 & 1)] += volume;  // times 3 (2D: 2) but for the first and last
  }
  const auto [low, high] = std::minmax_element(coefficient, coefficient + count);
  return *low > rounding || *high < -rounding;
}

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
    // Edges that turn about each other part more slowly than their ends move: the volume knows better than the plane.
    double apart_until = 0;
    for (double stride = 1 - t; apart_until == 0 && stride > 2 * safe; stride /= 4) {
      Node then[4];
      for (int k = 0; k < count; ++k) then[k] = x[k] + (t + stride) * d[k];
      if (stay_apart(count, at, then)) apart_until = stride;
    }
    // A shortest stride, so that rounding in `gap` does not stall it: no farther than the distance allows.
    double speed = 0;
    for (int i = 0; i < split; ++i)
      for (int j = split; j < count; ++j) speed = std::max(speed, (d[i] - d[j]).norm());
    t += std::max({apart_until, 0.95 * safe, 0.9 * (distance - 0.5 * least) / speed});
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
    return closest_on_facet(corners, at[0], at[1], at[2], at[corners]).apart;
  });
}

bool edges_meet(const Node* x, const Node* d, double least) {
  return meet(2, 4, x, d, least, [](const Node* at) -> Node {
    return closest_on_edges(at[0], at[1], at[2], at[3]).apart;
  });
}

}  // namespace forming_sim
