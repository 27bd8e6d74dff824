#pragma once
// Closest points that lie inside both features: a point over a face, and two edges that
// cross; and that of a point on the border of a face. T: double, or a Pack of such pairs.
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// Closer to the border of a feature than this fraction of its size counts as
/// on the border, so that a point over a shared edge belongs to the edge alone.
constexpr double kBorder = 1e-10;

template <class T> using Truth = decltype(T() > T());

/// Of a point and a triangle.
template <class T> struct OverFace {
  T beta, gamma;        ///< weights of the second and third corner
  Vector<T, 3> apart;   ///< from the foot to the point, m
  Truth<T> inside;      ///< the foot is inside the triangle, and that has an area (an angle above 1e-6)
};
/// r: from corner a to the point; u, v: from a to the other corners. By cross products, which stay accurate for needles.
template <class T> OverFace<T> over_face(const Vector<T, 3>& r, const Vector<T, 3>& u, const Vector<T, 3>& v) {
  const Vector<T, 3> n = cross(u, v);
  const T area2 = dot(n, n), beta = dot(cross(r, v), n), gamma = dot(cross(u, r), n);  // the last two times area2
  const T border = T(kBorder) * area2, over = T(1.0) / area2;
  OverFace<T> f;
  f.beta = beta * over;
  f.gamma = gamma * over;
  f.apart = (dot(r, n) * over) * n;
  f.inside = (area2 > T(1e-12) * dot(u, u) * dot(v, v)) & (beta > border) & (gamma > border) & (area2 - beta - gamma > border);
  return f;
}

/// Of a point and a segment: where on it, 0 ... 1, the closest point lies; 0 and 1 also where it is less than kBorder away,
/// 0 where the segment has no length. r, u: from its start to the point and to its end.
template <class T, int D> T along_segment(const Vector<T, D>& r, const Vector<T, D>& u) {
  const T zero(0.0), one(1.0), length2 = dot(u, u), s = select(length2 > zero, dot(r, u) / length2, zero);
  return select(s > T(kBorder), select(T(1 - kBorder) > s, s, one), zero);
}

/// Of a point and a segment in the plane.
template <class T> struct OverSegment {
  T s;                  ///< where on it
  Vector<T, 2> apart;   ///< from there to the point, m
  Truth<T> inside;      ///< not at an end
};
/// r, u: as above. Inside, `apart` is across the segment to the last bit.
template <class T> OverSegment<T> over_segment(const Vector<T, 2>& r, const Vector<T, 2>& u) {
  OverSegment<T> o;
  o.s = along_segment(r, u);
  o.inside = (o.s > T(0.0)) & (T(1.0) > o.s);
  const Vector<T, 2> n = {{-u[1], u[0]}};
  const T across = dot(r, n) / dot(n, n);
  for (int i = 0; i < 2; ++i) o.apart[i] = select(o.inside, across * n[i], r[i] - o.s * u[i]);
  return o;
}

/// Keeps of `apart` and `squared` those of the nearer one; returns where that is the other.
template <class Point> auto keep_nearer(Point& best, const Point& other) {
  const auto nearer = best.squared > other.squared;
  for (int i = 0; i < 3; ++i) best.apart[i] = select(nearer, other.apart[i], best.apart[i]);
  best.squared = select(nearer, other.squared, best.squared);
  return nearer;
}

/// Of a point and the border of a triangle: on the side between the corners i and j, i < j, the point x_i + s (x_j - x_i).
template <class T> struct OnBorder {
  T side;              ///< k of the side between the corners k and (k+1) mod 3
  T s;                 ///< as along_segment() has it
  Vector<T, 3> apart;  ///< from there to the point, m
  T squared;           ///< distance squared, m^2
};
/// r, u, v: as above.
template <class T> OnBorder<T> on_border(const Vector<T, 3>& r, const Vector<T, 3>& u, const Vector<T, 3>& v) {
  const auto on_side = [&](int k, const Vector<T, 3>& from, const Vector<T, 3>& d) {
    OnBorder<T> o;
    o.side = T(k);
    o.s = along_segment(from, d);
    o.apart = from - o.s * d;
    o.squared = dot(o.apart, o.apart);
    return o;
  };
  OnBorder<T> best = on_side(0, r, u);
  const auto offer = [&](const OnBorder<T>& other) {
    const auto nearer = keep_nearer(best, other);
    best.side = select(nearer, other.side, best.side);
    best.s = select(nearer, other.s, best.s);
  };
  offer(on_side(1, r - u, v - u));
  offer(on_side(2, r, v));
  return best;
}

/// Of the segments a0 + s u and b0 + t v.
template <class T> struct CrossingEdges {
  T s, t;
  Vector<T, 3> apart;   ///< from the point on b to that on a, m
  Truth<T> inside;      ///< both points inside their segments, and these not parallel (sin^2 > 1e-8)
};
/// r = a0 - b0.
template <class T> CrossingEdges<T> crossing_edges(const Vector<T, 3>& r, const Vector<T, 3>& u, const Vector<T, 3>& v) {
  const Vector<T, 3> n = cross(u, v);
  const T n2 = dot(n, n), over = T(1.0) / n2, low(kBorder), high(1.0 - kBorder);
  CrossingEdges<T> e;
  e.s = -dot(cross(r, v), n) * over;
  e.t = -dot(cross(r, u), n) * over;
  e.apart = (dot(r, n) * over) * n;
  e.inside = (n2 > T(1e-8) * dot(u, u) * dot(v, v)) & (e.s > low) & (high > e.s) & (e.t > low) & (high > e.t);
  return e;
}

/// Of the same that do not cross: one of the closest points is an end.
template <class T> struct EndOnEdge {
  T s, t;
  Vector<T, 3> apart;   ///< likewise
  T squared;            ///< distance squared, m^2
};
template <class T> EndOnEdge<T> end_on_edge(const Vector<T, 3>& r, const Vector<T, 3>& u, const Vector<T, 3>& v) {
  const auto at = [&](const T& s, const T& t) {
    EndOnEdge<T> e{s, t, r + s * u - t * v, T(0.0)};
    e.squared = dot(e.apart, e.apart);
    return e;
  };
  const T zero(0.0), one(1.0);
  EndOnEdge<T> best = at(zero, along_segment(r, v));
  const auto offer = [&](const EndOnEdge<T>& other) {
    const auto nearer = keep_nearer(best, other);
    best.s = select(nearer, other.s, best.s);
    best.t = select(nearer, other.t, best.t);
  };
  offer(at(one, along_segment(r + u, v)));
  offer(at(along_segment(-r, u), zero));
  offer(at(along_segment(v - r, u), one));
  return best;
}

}  // namespace forming_sim
