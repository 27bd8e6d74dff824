#include "forming_sim/contact/list.h"

#include <algorithm>
#include <limits>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

constexpr double kAwake = -std::numeric_limits<double>::infinity();

class Builder {
 public:
  Builder(const Features& f, const NodeField& x, const NodeField& place, double radius)
      : f_(f), x_(x), place_(place), radius_(radius) {}

  const Node& at(int vertex) const { return vertex < f_.body_nodes ? x_[vertex] : place_[vertex - f_.body_nodes]; }

  // Vertices of surface `a` against facets of surface `b`.
  void vertices_against_facets(int a, int b, const Box& near, double cell) {
    const auto& sb = f_.surfaces[b];
    std::vector<Box> boxes(sb.last_facet - sb.first_facet);
    for (size_t i = 0; i < boxes.size(); ++i)
      for (int k = 0; k < f_.corners(); ++k) boxes[i].add(at(f_.facets[sb.first_facet + i][k]));
    Grid grid(boxes, near, cell);
    std::vector<int> found;
    const Features::Relation& relation = f_.relation(a, b);
    for (int v : f_.surfaces[a].vertices) {
      const Node& p = at(v);
      Box query;
      query.add(p);
      query.grow(radius_);
      if (!query.overlaps(near)) continue;
      found.clear();
      grid.query(query, [&](int i) {
        const auto& c = f_.facets[sb.first_facet + i];
        if (a == b && (c[0] == v || c[1] == v || c[2] == v)) return;
        if (f_.tied(relation, std::array<int, 1>{v}, c)) return;
        const double squared = f_.dimension == 2 ? closest_on_segment_facet(p, at(c[0]), at(c[1])).squared
                                                 : closest_on_triangle(p, at(c[0]), at(c[1]), at(c[2])).squared;
        if (squared <= radius_ * radius_) found.push_back(sb.first_facet + i);
      });
      if (found.empty()) continue;
      std::sort(found.begin(), found.end());
      const int first = static_cast<int>(list.facets.size());
      for (int facet : found) list.facets.push_back({facet, {f_.facets[facet][0], f_.facets[facet][1], f_.facets[facet][2]}, kAwake});
      const int near_first = static_cast<int>(list.neighbours.size());
      for (int i = f_.first_neighbour[v]; i < f_.first_neighbour[v + 1]; ++i) list.neighbours.push_back(f_.neighbours[i]);
      list.groups.push_back({v, v, b, first, static_cast<int>(list.facets.size()), near_first, static_cast<int>(list.neighbours.size()), kAwake});
    }
  }

  void edges_against_edges(int a, int b, const Box& near, double cell) {
    const auto& sa = f_.surfaces[a];
    const auto& sb = f_.surfaces[b];
    std::vector<Box> boxes(sb.last_edge - sb.first_edge);
    for (size_t i = 0; i < boxes.size(); ++i)
      for (int k = 0; k < 2; ++k) boxes[i].add(at(f_.edges[sb.first_edge + i].node[k]));
    Grid grid(boxes, near, cell);
    const Features::Relation& relation = f_.relation(a, b);
    for (int e = sa.first_edge; e < sa.last_edge; ++e) {
      const auto& p = f_.edges[e].node;
      Box query;
      query.add(at(p[0]));
      query.add(at(p[1]));
      query.grow(radius_);
      if (!query.overlaps(near)) continue;
      grid.query(query, [&](int i) {
        const auto& q = f_.edges[sb.first_edge + i].node;
        if (a == b && (sb.first_edge + i <= e || p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1])) return;
        if (f_.tied(relation, p, q)) return;
        if (closest_on_edges(at(p[0]), at(p[1]), at(q[0]), at(q[1])).squared > radius_ * radius_) return;
        const auto &op = f_.edges[e].opposite, &oq = f_.edges[sb.first_edge + i].opposite;
        list.edges.push_back({e, sb.first_edge + i, {p[0], p[1], q[0], q[1]}, {op[0], op[1], oq[0], oq[1]}, kAwake});
      });
    }
  }

  void vertices_against_plane(int a, int tool, const PlanePose& plane) {
    const Features::Relation& relation = f_.relation(a, f_.bodies + tool);
    for (int v : f_.surfaces[a].vertices)
      if (dot3(at(v) - plane.point, plane.normal) <= radius_ && !(relation.tie >= 0 && f_.tied_zones[relation.tie][v])) list.planes.push_back({v, v, -1, tool});
  }

  // From feature vertices to places in the workspace.
  void number(Workspace& work) {
    std::vector<int>& used = work.vertex;
    used.clear();
    for (const auto& g : list.groups) used.push_back(g.node);
    used.insert(used.end(), list.neighbours.begin(), list.neighbours.end());
    for (const auto& c : list.facets)
      for (int k = 0; k < f_.corners(); ++k) used.push_back(c.node[k]);
    for (const auto& e : list.edges) {
      used.insert(used.end(), e.node, e.node + 4);
      for (int o : e.opposite)
        if (o >= 0) used.push_back(o);
    }
    for (const auto& p : list.planes) used.push_back(p.node);
    for (const auto& t : list.ties)
      for (int n : t.node)
        if (n >= 0) used.push_back(n);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<int> place(f_.vertex_count, -1);
    for (size_t i = 0; i < used.size(); ++i) place[used[i]] = static_cast<int>(i);
    work.body_entries = static_cast<int>(std::lower_bound(used.begin(), used.end(), f_.body_nodes) - used.begin());
    for (auto& g : list.groups) g.node = place[g.node];
    for (int& n : list.neighbours) n = place[n];
    for (auto& c : list.facets)
      for (int k = 0; k < f_.corners(); ++k) c.node[k] = place[c.node[k]];
    for (auto& e : list.edges) {
      for (int& n : e.node) n = place[n];
      for (int& o : e.opposite)
        if (o >= 0) o = place[o];
    }
    for (auto& p : list.planes) {
      p.node = place[p.node];
      p.foot = static_cast<int>(used.size());
      used.push_back(-1);
    }
    for (auto& t : list.ties) {
      for (int& n : t.node)
        if (n >= 0) n = place[n];
      if (t.node[1] >= 0) continue;
      t.node[1] = static_cast<int>(used.size());
      used.push_back(-1);
    }
    work.x.assign(used.size(), Node::Zero());
    work.v = work.before = work.x;
    work.inverse_mass.assign(used.size(), 0.0);
    work.projector.assign(used.size(), nullptr);
  }

  NearList list;

 private:
  const Features& f_;
  const NodeField &x_, &place_;
  double radius_;
};

}  // namespace

Box box_of(const Features& f, int surface, const NodeField& x, const NodeField& place) {
  Box box;
  for (int v : f.surfaces[surface].vertices) box.add(v < f.body_nodes ? x[v] : place[v - f.body_nodes]);
  return box;
}

NearList build_list(const Features& f, const NodeField& x, const NodeField& place, const std::vector<bool>& present,
                    const std::vector<bool>& is_plane, const std::vector<PlanePose>& planes,
                    const std::vector<Tie>& ties, double radius, Workspace& work) {
  Builder build(f, x, place, radius);
  double clear = std::numeric_limits<double>::infinity();  // of all boxes from one another
  bool any = false;
  const double cell = std::max(f.mean_edge, 2 * radius);
  const auto meet = [&](int a, int b, const Box& box_a, const Box& box_b) {
    if (box_a.empty() || box_b.empty()) return;
    const double distance = box_a.distance(box_b);
    clear = std::min(clear, distance);
    if (distance > radius) return;
    any = true;
    Box near = box_a, near_b = box_b;
    near.grow(radius);
    near_b.grow(radius);
    near.low = near.low.cwiseMax(near_b.low);
    near.high = near.high.cwiseMin(near_b.high);
    build.vertices_against_facets(a, b, near, cell);
    if (a != b) build.vertices_against_facets(b, a, near, cell);
    if (f.dimension == 3) build.edges_against_edges(a, b, near, cell);
  };
  for (int a = 0; a < f.bodies; ++a) {
    const Box body = box_of(f, a, x, place);
    for (size_t t = 0; t < present.size(); ++t) {
      if (!present[t] || !f.relation(a, f.bodies + static_cast<int>(t)).meet) continue;
      if (is_plane[t]) {
        build.vertices_against_plane(a, static_cast<int>(t), planes[t]);
        any = true;
        continue;
      }
      const int b = f.bodies + static_cast<int>(t);
      const Box tool = box_of(f, b, x, place);
      meet(a, b, body, tool);
    }
    for (int b = a; b < f.bodies; ++b)
      if (f.relation(a, b).meet) meet(a, b, body, b == a ? body : box_of(f, b, x, place));
  }
  std::sort(build.list.groups.begin(), build.list.groups.end(), [](const auto& p, const auto& q) {
    return p.vertex != q.vertex ? p.vertex < q.vertex : p.surface < q.surface;
  });
  std::sort(build.list.edges.begin(), build.list.edges.end(), [](const auto& p, const auto& q) {
    return p.first != q.first ? p.first < q.first : p.second < q.second;
  });
  std::sort(build.list.planes.begin(), build.list.planes.end(), [](const auto& p, const auto& q) {
    return p.vertex != q.vertex ? p.vertex < q.vertex : p.tool < q.tool;
  });
  for (size_t i = 0; i < ties.size(); ++i)
    if (ties[i].tool < 0 || present[ties[i].tool])
      build.list.ties.push_back({static_cast<int>(i), {ties[i].vertex, ties[i].corner[0], ties[i].corner[1], ties[i].corner[2]}});
  build.number(work);
  build.list.radius = any ? radius : std::max(radius, clear);
  return std::move(build.list);
}

}  // namespace forming_sim
