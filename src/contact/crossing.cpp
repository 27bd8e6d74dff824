#include "forming_sim/contact/crossing.h"

#include <algorithm>
#include <numeric>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

// Of features that nearly lie in one plane, as faces and edges side by side do, rounding would decide. Below this
// share of the largest volume that its edges can span a vertex counts as in the plane, and what only touches has not passed;
// on which side of an edge something passed is then computed with twice as many digits, which leaves nothing to rounding.
constexpr double kRounding = 1e-14;
__extension__ typedef __float128 Wide;

/// Six volumes of a tetrahedron.
template <class T> T volume(const Node& a, const Node& b, const Node& c, const Node& d) {
  T u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = T(b[k]) - T(a[k]);
    v[k] = T(c[k]) - T(a[k]);
    w[k] = T(d[k]) - T(a[k]);
  }
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
}
/// Two areas of a triangle in the plane.
template <class T> T area(const Node& a, const Node& b, const Node& c) {
  return (T(b[0]) - T(a[0])) * (T(c[1]) - T(a[1])) - (T(b[1]) - T(a[1])) * (T(c[0]) - T(a[0]));
}

/// On which side of abc (2D: ab) is p? 0: in the plane, to rounding.
double side(const Node& a, const Node& b, const Node& c, const Node& p) {
  const Node u = b - a, v = c - a, w = p - a;
  const double size = volume<double>(a, b, c, p);
  return size * size > kRounding * kRounding * dot3(u, u) * dot3(v, v) * dot3(w, w) ? size : 0;
}
double side(const Node& a, const Node& b, const Node& p) {
  const Node u = b - a, v = p - a;
  const double size = area<double>(a, b, p);
  return size * size > kRounding * kRounding * dot3(u, u) * dot3(v, v) ? size : 0;
}
int sign(const Wide& a) { return a > 0 ? 1 : a < 0 ? -1 : 0; }

class Finder {
 public:
  Finder(const Features& f, const NodeField& x, const NodeField& place) : f_(f), x_(x), place_(place) {}

  const Node& at(int v) const { return v < f_.body_nodes ? x_[v] : place_[v - f_.body_nodes]; }

  // Edges (2D: segments) of surface a through facets of surface b.
  void pierce(int a, int b) {
    const auto &sa = f_.surfaces[a], &sb = f_.surfaces[b];
    std::vector<Box> boxes(sb.last_facet - sb.first_facet);
    for (size_t i = 0; i < boxes.size(); ++i)
      for (int k = 0; k < f_.corners(); ++k) boxes[i].add(at(f_.facets[sb.first_facet + i][k]));
    const bool flat = f_.dimension == 2;
    const int first = flat ? sa.first_facet : sa.first_edge, last = flat ? sa.last_facet : sa.last_edge;
    Box all = box_of(f_, a, x_, place_);
    if (all.empty()) return;
    Grid grid(boxes, all, std::max(f_.mean_edge, 1e-12));
    const Features::Relation& relation = f_.relation(a, b);
    for (int e = first; e < last; ++e) {
      const int p = flat ? f_.facets[e][0] : f_.edges[e].node[0], q = flat ? f_.facets[e][1] : f_.edges[e].node[1];
      Box query;
      query.add(at(p));
      query.add(at(q));
      grid.query(query, [&](int i) {
        const auto& c = f_.facets[sb.first_facet + i];
        if (a == b && (p == c[0] || p == c[1] || p == c[2] || q == c[0] || q == c[1] || q == c[2])) return;
        if (f_.tied_edge_to_facet(relation, e, sb.first_facet + i)) return;
        const bool hit = flat ? segments_cross(at(p), at(q), at(c[0]), at(c[1]), true)
                              : pierces(at(p), at(q), at(c[0]), at(c[1]), at(c[2]), true);
        if (hit) found.push_back({std::min(a, b), std::max(a, b), {p, q}, sb.first_facet + i});
      });
    }
  }

  // One vertex of each part of surface a that is not tied against the closed parts of surface b.
  void inside(int a, int b) {
    const Parts pa = find_parts(f_, a), pb = find_parts(f_, b);
    std::vector<int> seen(pa.closed.size(), 0);
    for (size_t i = 0; i < pa.of_facet.size(); ++i) {
      const int v = f_.facets[f_.surfaces[a].first_facet + i][0];
      const std::array<int, 1> vertex{v};
      if (seen[pa.of_facet[i]] || f_.about_ties(f_.relation(a, b), vertex, vertex)) continue;
      seen[pa.of_facet[i]] = 1;
      if (is_inside(at(v), b, pb)) found.push_back({std::min(a, b), std::max(a, b), {v, -1}, -1});
    }
  }

  std::vector<Crossing> found;

 private:
  // Parity of the crossings with all closed parts of a ray in a direction that no mesh is aligned with: what lies in a hole, or between two shells, is outside.
  bool is_inside(const Node& p, int surface, const Parts& parts) const {
    const auto& s = f_.surfaces[surface];
    Box box;
    for (size_t i = 0; i < parts.of_facet.size(); ++i) {
      if (!parts.closed[parts.of_facet[i]]) continue;
      const auto& c = f_.facets[s.first_facet + i];
      for (int k = 0; k < f_.corners(); ++k) box.add(at(c[k]));
    }
    if (box.empty()) return false;
    for (int k = 0; k < f_.dimension; ++k)
      if (p[k] < box.low[k] || p[k] > box.high[k]) return false;
    const double far = 2 * (box.high - box.low).norm();
    const Node q = p + far * Node(0.7548776662466927, 0.5698402909980532, f_.dimension == 2 ? 0 : 0.3247179572447461, 0);
    bool odd = false;
    for (size_t i = 0; i < parts.of_facet.size(); ++i) {
      if (!parts.closed[parts.of_facet[i]]) continue;
      const auto& c = f_.facets[s.first_facet + i];
      if (f_.dimension == 2 ? segments_cross(p, q, at(c[0]), at(c[1]), false) : pierces(p, q, at(c[0]), at(c[1]), at(c[2]), false)) odd = !odd;
    }
    return odd;
  }

  const Features& f_;
  const NodeField &x_, &place_;
};

}  // namespace

bool segments_cross(const Node& p, const Node& q, const Node& a, const Node& b, bool border) {
  if (!(side(a, b, p) * side(a, b, q) < 0)) return false;
  const int u = sign(area<Wide>(p, q, a)), v = sign(area<Wide>(p, q, b));
  return border ? u * v <= 0 && u != v : u * v < 0;
}

bool pierces(const Node& p, const Node& q, const Node& a, const Node& b, const Node& c, bool border) {
  if (!(side(a, b, c, p) * side(a, b, c, q) < 0)) return false;
  const int u = sign(volume<Wide>(p, q, a, b)), v = sign(volume<Wide>(p, q, b, c)), w = sign(volume<Wide>(p, q, c, a));
  const int low = std::min({u, v, w}), high = std::max({u, v, w});
  return border ? (low >= 0 && high > 0) || (high <= 0 && low < 0) : low > 0 || high < 0;
}

std::vector<bool> facets_through_others(const Features& f, int surface) {
  const auto& s = f.surfaces[surface];
  std::vector<bool> through(s.last_facet - s.first_facet, false);
  const NodeField none;
  Finder finder(f, none, f.place);
  finder.pierce(surface, surface);
  std::vector<std::array<int, 2>> edges;
  for (const Crossing& c : finder.found) {
    through[c.facet - s.first_facet] = true;
    edges.push_back({c.edge[0], c.edge[1]});
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < through.size(); ++i)
    for (int k = 0; k < f.corners(); ++k) {
      const int a = f.facets[s.first_facet + i][k], b = f.facets[s.first_facet + i][(k + 1) % f.corners()];
      if (std::binary_search(edges.begin(), edges.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)})) through[i] = true;
    }
  return through;
}

int crossing_with_itself(const Features& f, int body, const NodeField& x) {
  const NodeField none;
  Finder finder(f, x, none);
  finder.pierce(body, body);
  return finder.found.empty() ? -1 : finder.found.front().edge[0];
}

Parts find_parts(const Features& f, int surface) {
  const auto& s = f.surfaces[surface];
  const int facets = s.last_facet - s.first_facet;
  std::vector<int> root(f.vertex_count);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (int i = 0; i < facets; ++i)
    for (int k = 1; k < f.corners(); ++k) {
      const int a = find(f.facets[s.first_facet + i][0]), b = find(f.facets[s.first_facet + i][k]);
      root[std::max(a, b)] = std::min(a, b);
    }
  Parts parts;
  std::vector<int> number(f.vertex_count, -1);
  for (int i = 0; i < facets; ++i) {
    const int r = find(f.facets[s.first_facet + i][0]);
    if (number[r] < 0) {
      number[r] = static_cast<int>(parts.closed.size());
      parts.closed.push_back(true);
    }
    parts.of_facet.push_back(number[r]);
    for (int k = 0; k < f.corners(); ++k) {
      const int around = f.dimension == 2 ? f.facets_at_vertex[f.facets[s.first_facet + i][k]] : f.edges[f.facet_edges[s.first_facet + i][k]].facets;
      if (around % 2 == 1) parts.closed[number[r]] = false;
    }
  }
  return parts;
}

std::vector<Crossing> find_crossings(const Features& f, const NodeField& x, const NodeField& place, const std::vector<bool>& present,
                                     const std::vector<bool>& is_plane, const std::vector<PlanePose>& planes) {
  Finder finder(f, x, place);
  const auto meet = [&](int a, int b) {
    const Box box_a = box_of(f, a, x, place), box_b = box_of(f, b, x, place);
    if (box_a.empty() || box_b.empty() || !box_a.overlaps(box_b)) return;
    const size_t before = finder.found.size();
    finder.pierce(a, b);
    if (a == b) return;
    // In the plane both ways see the same crossings, but for those through a vertex.
    if (f.dimension == 3 || finder.found.size() == before) finder.pierce(b, a);
    if (finder.found.size() > before) return;
    finder.inside(a, b);
    finder.inside(b, a);
  };
  for (int body = 0; body < f.bodies; ++body) {
    for (size_t t = 0; t < present.size(); ++t) {
      const int surface = f.bodies + static_cast<int>(t);
      if (!present[t] || !f.relation(body, surface).meet) continue;
      if (!is_plane[t]) {
        meet(body, surface);
        continue;
      }
      for (int v : f.surfaces[body].vertices)
        if (dot3(x[v] - planes[t].point, planes[t].normal) <= 0 && !f.about_ties(f.relation(body, surface), std::array<int, 1>{v}, std::array<int, 1>{v})) finder.found.push_back({body, surface, {v, -1}, -1});
    }
    for (int other = body; other < f.bodies; ++other)
      if (f.relation(body, other).meet) meet(body, other);
  }
  return std::move(finder.found);
}

}  // namespace forming_sim
