#include "forming_sim/contact/list.h"

#include <algorithm>
#include <limits>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

/// A surface as the search asks it: its index, and where it stands.
struct Indexed {
  int surface;
  const SurfaceIndex* index;
  const ToolMotion* motion = nullptr;  ///< null: the index is of the world

  Node to_index(const Node& p) const {
    return motion ? node(motion->rotation0.transpose() * (vec3(p) - motion->position0)) : p;
  }
  /// A box in the index' frame around points of the world, with `radius` to spare.
  template <class... Points> Box query(double radius, const Points&... points) const {
    Box box;
    (box.add(to_index(points)), ...);
    box.grow(radius * (1 + 1e-9));  // the way into the frame rounds
    return box;
  }
};

class Builder {
 public:
  Builder(const Features& f, const NodeField& x, const PlacedTools& tools, double radius) : f_(f), x_(x), tools_(tools), radius_(radius) {}

  Node at(int vertex) const {
    if (vertex < f_.body_nodes) return x_[vertex];
    const Node& p = tools_.index.place(vertex);
    return tools_.motion.empty() ? p : node(pose0(tools_.motion[f_.vertex_surface[vertex] - f_.bodies], vec3(p)));
  }

  bool level(int vertex) const { return f_.rigid(vertex) && !f_.level_vertex.empty() && f_.level_vertex[vertex - f_.body_nodes]; }

  // Vertices of body `a` against facets of `b`.
  void vertices_against_facets(int a, const Indexed& b, const Box& near) {
    for (int v : f_.surfaces[a].vertices) {
      const Node p = at(v);
      Box here;
      here.add(p);
      if (!here.overlaps(near)) continue;
      b.index->facets(b.query(radius_, p), [&](int facet) { meet(v, p, a, facet, b.surface); });
    }
    group(b.surface);
  }

  // Facets of body `a` against vertices of `b`.
  void facets_against_vertices(int a, const Indexed& b, const Box& near) {
    for (int facet = f_.surfaces[a].first_facet; facet < f_.surfaces[a].last_facet; ++facet) {
      const auto& c = f_.facets[facet];
      const Node p = at(c[0]), q = at(c[1]), r = at(c[f_.corners() - 1]);
      Box here;
      here.add(p);
      here.add(q);
      here.add(r);
      if (!here.overlaps(near)) continue;
      b.index->vertices(b.query(radius_, p, q, r), [&](int v) {
        if (!level(v)) meet(v, at(v), b.surface, facet, a);
      });
    }
    group(a);
  }

  void edges_against_edges(int a, const Indexed& b, const Box& near) {
    const auto& sa = f_.surfaces[a];
    const Features::Relation& relation = f_.relation(a, b.surface);
    for (int e = sa.first_edge; e < sa.last_edge; ++e) {
      const auto& p = f_.edges[e].node;
      const Node p0 = at(p[0]), p1 = at(p[1]);
      Box here;
      here.add(p0);
      here.add(p1);
      if (!here.overlaps(near)) continue;
      b.index->edges(b.query(radius_, p0, p1), [&](int other) {
        if (f_.edges[other].level) return;
        const auto& q = f_.edges[other].node;
        if (a == b.surface && (other <= e || p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1])) return;
        if (f_.tied_edges(relation, e, other)) return;
        const double squared = closest_on_edges(p0, p1, at(q[0]), at(q[1])).squared;
        if (squared > radius_ * radius_) return;
        const auto &op = f_.edges[e].opposite, &oq = f_.edges[other].opposite;
        const auto or_end = [](int corner, const int (&ends)[2]) { return corner >= 0 ? corner : ends[0]; };
        list.edges.push_back({e, other, a, b.surface, {p[0], p[1], q[0], q[1], or_end(op[0], p), or_end(op[1], p), or_end(oq[0], q), or_end(oq[1], q)}, -1, std::sqrt(squared)});
      });
    }
  }

  void vertices_against_plane(int a, int tool, const PlanePose& plane) {
    const Features::Relation& relation = f_.relation(a, f_.bodies + tool);
    for (int v : f_.surfaces[a].vertices)
      if (dot3(at(v) - plane.point, plane.normal) <= radius_ && !(relation.tie >= 0 && f_.tied_zones[relation.tie][v])) list.planes.push_back({v, v, -1, tool});
  }

  // From feature vertices to places in the workspace: those of bodies as they are numbered, those of tools in the order in
  // which pairs meet them, so that what is used together stands together.
  void number(Workspace& work) {
    std::vector<int>& used = work.vertex;
    used.clear();
    for (const auto& e : list.edges) used.insert(used.end(), std::begin(e.node), std::end(e.node));
    for (const auto& c : list.facets)
      for (int k = 0; k < f_.corners(); ++k) used.push_back(c.node[k]);
    for (const auto& g : list.groups) used.push_back(g.node);
    used.insert(used.end(), list.neighbours.begin(), list.neighbours.end());
    for (const auto& p : list.planes) used.push_back(p.node);
    for (const auto& t : list.ties)
      for (int n : t.node)
        if (n >= 0) used.push_back(n);
    std::vector<int> place(f_.vertex_count, -1), of_tools;
    for (int v : used) {
      if (f_.rigid(v) && place[v] < 0) of_tools.push_back(v);
      place[v] = 0;
    }
    used.clear();
    for (int v = 0; v < f_.body_nodes; ++v)
      if (place[v] == 0) used.push_back(v);
    work.body_entries = static_cast<int>(used.size());
    used.insert(used.end(), of_tools.begin(), of_tools.end());
    for (size_t i = 0; i < used.size(); ++i) place[used[i]] = static_cast<int>(i);
    for (auto& g : list.groups) g.node = place[g.node];
    for (int& n : list.neighbours) n = place[n];
    for (auto& c : list.facets)
      for (int k = 0; k < f_.corners(); ++k) c.node[k] = place[c.node[k]];
    for (auto& e : list.edges)
      for (int& n : e.node) n = place[n];
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
    work.v = work.before = work.mean = work.x;
    work.share.assign(used.size(), Share());
    work.projector.assign(used.size(), nullptr);
    for (int i = 0; i < work.body_entries; ++i) {
      work.share[i].area = f_.area[used[i]];
      work.share[i].of_body = 1;
    }
  }

  NearList list;

 private:
  // Keeps vertex v (at p, of surface `own`) and a facet of surface `other` where they are near enough.
  void meet(int v, const Node& p, int own, int facet, int other) {
    const auto& c = f_.facets[facet];
    if (own == other && (c[0] == v || c[1] == v || c[2] == v)) return;
    if (f_.tied_to_facet(f_.relation(own, other), v, facet)) return;
    const double squared = f_.dimension == 2 ? closest_on_segment_facet(p, at(c[0]), at(c[1])).squared
                                             : closest_on_triangle(p, at(c[0]), at(c[1]), at(c[2])).squared;
    if (squared <= radius_ * radius_) found_.push_back({v, facet, std::sqrt(squared)});
  }

  // What was kept since the last call, by its vertices; the facets are of `surface`.
  void group(int surface) {
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.vertex != b.vertex ? a.vertex < b.vertex : a.facet < b.facet; });
    for (size_t i = 0; i < found_.size();) {
      const int v = found_[i].vertex, first = static_cast<int>(list.facets.size());
      double nearest = found_[i].distance;
      for (; i < found_.size() && found_[i].vertex == v; ++i) {
        const auto& c = f_.facets[found_[i].facet];
        list.facets.push_back({found_[i].facet, {c[0], c[1], c[2]}, found_[i].distance});
        nearest = std::min(nearest, found_[i].distance);
      }
      const int near_first = static_cast<int>(list.neighbours.size());
      for (int k = f_.first_neighbour[v]; k < f_.first_neighbour[v + 1]; ++k) list.neighbours.push_back(f_.neighbours[k]);
      list.groups.push_back({v, v, surface, first, static_cast<int>(list.facets.size()), near_first, static_cast<int>(list.neighbours.size()), nearest});
    }
    found_.clear();
  }

  const Features& f_;
  const NodeField& x_;
  const PlacedTools& tools_;
  double radius_;
  struct Found {
    int vertex, facet;
    double distance;
  };
  std::vector<Found> found_;
};

// Of a box that is turned with its frame, one that holds it.
Box moved(const Box& box, const ToolMotion& motion) {
  Box all;
  for (int i = 0; i < 8; ++i) all.add(node(pose0(motion, box.corner(i))));
  return all;
}

}  // namespace

void NearList::watch(double reach, double travel) {
  if (travel + reach <= watched_until) return;
  for (const EdgePair& e : watched) edge_wake[e.listed] = e.wake;
  watched.clear();
  watched_until = travel + 2 * reach;
  for (size_t i = 0; i < edges.size(); ++i)
    if (edge_wake[i] <= watched_until * (1 + 1e-12)) {
      watched.push_back(edges[i]);
      watched.back().wake = edge_wake[i];
    }
}

Box box_of(const Features& f, int surface, const NodeField& x, const NodeField& place) {
  Box box;
  for (int v : f.surfaces[surface].vertices) box.add(v < f.body_nodes ? x[v] : place[v - f.body_nodes]);
  return box;
}

NearList build_list(const Features& f, const NodeField& x, const PlacedTools& tools, const std::vector<Tie>& ties, double radius, Workspace& work) {
  Builder build(f, x, tools, radius);
  double clear = std::numeric_limits<double>::infinity();  // of all boxes from one another
  bool any = false;
  const double cell = std::max(f.mean_edge, 2 * radius);
  // The part of either box in which the other can be met; empty: they cannot meet.
  const auto part_near = [&](const Box& a, const Box& b) {
    Box near;
    if (a.empty() || b.empty()) return near;
    const double distance = a.distance(b);
    clear = std::min(clear, distance);
    if (distance > radius) return near;
    any = true;
    Box wide_a = a, wide_b = b;
    wide_a.grow(radius);
    wide_b.grow(radius);
    near.low = wide_a.low.cwiseMax(wide_b.low);
    near.high = wide_a.high.cwiseMin(wide_b.high);
    return near;
  };
  const auto search = [&](int a, const Indexed& b, const Box& near) {
    build.vertices_against_facets(a, b, near);
    if (a != b.surface) build.facets_against_vertices(a, b, near);
    if (f.dimension == 3) build.edges_against_edges(a, b, near);
  };
  for (int a = 0; a < f.bodies; ++a) {
    const Box body = box_of(f, a, x, NodeField());
    for (size_t t = 0; t < tools.present.size(); ++t) {
      const int b = f.bodies + static_cast<int>(t);
      if (!tools.present[t] || !f.relation(a, b).meet) continue;
      if (tools.is_plane[t]) {
        build.vertices_against_plane(a, static_cast<int>(t), tools.planes[t]);
        any = true;
        continue;
      }
      const SurfaceIndex& index = tools.index.of(static_cast<int>(t));
      if (index.box().empty()) continue;
      const ToolMotion* motion = tools.motion.empty() ? nullptr : &tools.motion[t];
      const Box near = part_near(body, motion ? moved(index.box(), *motion) : index.box());
      if (!near.empty()) search(a, {b, &index, motion}, near);
    }
    for (int b = a; b < f.bodies; ++b) {
      if (!f.relation(a, b).meet) continue;
      const Box near = part_near(body, b == a ? body : box_of(f, b, x, NodeField()));
      if (near.empty()) continue;
      const SurfaceIndex index(f, b, [&](int v) -> const Node& { return x[v]; }, near, cell);
      search(a, {b, &index}, near);
    }
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
  for (size_t i = 0; i < build.list.edges.size(); ++i) {
    build.list.edges[i].listed = static_cast<int>(i);
    build.list.edge_wake.push_back(build.list.edges[i].wake);
  }
  for (size_t i = 0; i < ties.size(); ++i)
    if (ties[i].tool < 0 || tools.present[ties[i].tool])
      build.list.ties.push_back({static_cast<int>(i), {ties[i].node[0], ties[i].node[1], ties[i].node[2], ties[i].node[3]}});
  build.number(work);
  build.list.radius = any ? radius : std::max(radius, clear);
  return std::move(build.list);
}

}  // namespace forming_sim
