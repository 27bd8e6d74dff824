#pragma once
// Closest points of a point and a segment, a point and a triangle, and two
// segments, with the feature on which they lie.
#include <algorithm>
#include <cmath>

#include "forming_sim/contact/inside.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// On which feature of a facet the closest point lies. Corner and edge carry a
/// number: edge k joins corners k and (k+1) mod 3.
struct Closest {
  enum Feature { corner, edge, face } feature = corner;
  int which = 0;
  double weight[3] = {1, 0, 0};  ///< of the facet's corners, sum 1
  Node apart = Node::Zero();     ///< from the closest point to the point, m
  double squared = 0;            ///< distance squared, m^2
};

inline double dot3(const Node& a, const Node& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Node cross3(const Node& a, const Node& b) {
  return node(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

inline Vector<double, 3> between(const Node& from, const Node& to) { return {{to[0] - from[0], to[1] - from[1], to[2] - from[2]}}; }

/// On a segment of the plane, as OverSegment has it.
inline void lie_on_segment(double s, const Node& apart, Closest& c) {
  c.weight[0] = 1 - s;
  c.weight[1] = s;
  c.feature = s == 0 || s == 1 ? Closest::corner : Closest::face;
  c.which = s == 1 ? 1 : 0;
  c.apart = apart;
  c.squared = dot3(apart, apart);
}
inline Closest closest_on_segment_facet(const Node& p, const Node& a, const Node& b) {
  const OverSegment<double> over = over_segment<double>({{p[0] - a[0], p[1] - a[1]}}, {{b[0] - a[0], b[1] - a[1]}});
  Closest c;
  lie_on_segment(over.s, node(over.apart[0], over.apart[1], 0), c);
  return c;
}

/// Inside a triangle, as OverFace has it.
inline void lie_in_face(double beta, double gamma, const Node& apart, Closest& f) {
  f.feature = Closest::face;
  f.weight[1] = beta;
  f.weight[2] = gamma;
  f.weight[0] = 1 - beta - gamma;
  f.apart = apart;
  f.squared = dot3(apart, apart);
}
/// On its border, as OnBorder has it.
inline void lie_on_border(int side, double s, const Node& apart, Closest& f) {
  const int i = side == 2 ? 0 : side, j = side == 2 ? 2 : side + 1;
  f.weight[0] = f.weight[1] = f.weight[2] = 0;
  f.weight[i] = 1 - s;
  f.weight[j] = s;
  f.feature = s == 0 || s == 1 ? Closest::corner : Closest::edge;
  f.which = f.feature == Closest::edge ? side : s == 0 ? i : j;
  f.apart = apart;
  f.squared = dot3(apart, apart);
}

/// Closest point of the closed triangle abc. A triangle without area (an angle
/// below 1e-6) is its three edges.
inline Closest closest_on_triangle(const Node& p, const Node& a, const Node& b, const Node& c) {
  const Vector<double, 3> r = between(a, p), u = between(a, b), v = between(a, c);
  const auto record = [](const Vector<double, 3>& d) { return node(d[0], d[1], d[2]); };
  Closest found;
  const OverFace<double> over = over_face(r, u, v);
  if (over.inside) {
    lie_in_face(over.beta, over.gamma, record(over.apart), found);
  } else {
    const OnBorder<double> border = on_border(r, u, v);
    lie_on_border(static_cast<int>(border.side), border.s, record(border.apart), found);
  }
  return found;
}

/// Of a facet of 2 corners, which is its segment ab, or 3.
inline Closest closest_on_facet(int corners, const Node& p, const Node& a, const Node& b, const Node& c) {
  return corners == 2 ? closest_on_segment_facet(p, a, b) : closest_on_triangle(p, a, b, c);
}

/// Closest points a0 + s (a1 - a0) and b0 + t (b1 - b0) of two segments.
struct ClosestEdges {
  double s = 0, t = 0;
  Node apart = Node::Zero();  ///< from the point on b to that on a, m
  double squared = 0;
  bool crossing = false;  ///< both inside their segments, and not parallel (sin^2 > 1e-8)
};
ClosestEdges closest_on_edges(const Node& a0, const Node& a1, const Node& b0, const Node& b1);

}  // namespace forming_sim
