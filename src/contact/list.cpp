#include "forming_sim/contact/list.h"

#include <algorithm>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

class Builder {
 public:
  Builder(const Features& f, const NodeField& x, const PlacedTools& tools, const Encounters& encounters)
      : f_(f), x_(x), tools_(tools), encounters_(encounters), radius_(encounters.radius()) {}

  void search(int a, const Indexed& b, const Box& near) {
    vertices_against_facets(a, b, near);
    if (a != b.surface) facets_against_vertices(a, b, near);
    if (f_.dimension == 3) edges_against_edges(a, b, near);
  }

  void vertices_against_plane(int a, int tool) {
    const PlanePose& plane = tools_.planes[tool];
    const Features::Relation& relation = f_.relation(a, f_.bodies + tool);
    for (int v : f_.surfaces[a].vertices)
      if (dot3(x_[v] - plane.point, plane.normal) <= radius_ && !f_.tied_to_plane(relation, v)) list.planes.push_back({v, v, -1, tool});
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
    work.stands.assign(used.size(), 0);
    for (int i = 0; i < work.body_entries; ++i) {
      work.share[i].area = f_.area[used[i]];
      work.share[i].of_body = 1;
    }
  }

  NearList list;

 private:
  // All distances below are found in the frame of b's index, in which only what is of body `a` has to be turned.

  bool level(int vertex) const { return f_.rigid(vertex) && !f_.level_vertex.empty() && f_.level_vertex[vertex - f_.body_nodes]; }
  const Node& place(int vertex) const { return encounters_.place(vertex); }

  void vertices_against_facets(int a, const Indexed& b, const Box& near) {
    for (int v : f_.surfaces[a].vertices) {
      if (!near.holds(x_[v])) continue;
      const Node p = b.to_index(x_[v]);
      b.index->facets(Indexed::around(radius_, p), [&](int facet) {
        const auto& c = f_.facets[facet];
        meet(v, a, p, facet, b.surface, place(c[0]), place(c[1]), place(c[f_.corners() - 1]));
      });
    }
    group(b.surface);
  }

  void facets_against_vertices(int a, const Indexed& b, const Box& near) {
    for (int facet = f_.surfaces[a].first_facet; facet < f_.surfaces[a].last_facet; ++facet) {
      const auto& c = f_.facets[facet];
      const Node &p = x_[c[0]], &q = x_[c[1]], &r = x_[c[f_.corners() - 1]];
      if (!Box::of(p, q, r).overlaps(near)) continue;
      const Node p_b = b.to_index(p), q_b = b.to_index(q), r_b = b.to_index(r);
      b.index->vertices(Indexed::around(radius_, p_b, q_b, r_b), [&](int v) {
        if (!level(v)) meet(v, b.surface, place(v), facet, a, p_b, q_b, r_b);
      });
    }
    group(a);
  }

  void edges_against_edges(int a, const Indexed& b, const Box& near) {
    const auto& sa = f_.surfaces[a];
    const Features::Relation& relation = f_.relation(a, b.surface);
    for (int e = sa.first_edge; e < sa.last_edge; ++e) {
      const auto& p = f_.edges[e].node;
      if (!Box::of(x_[p[0]], x_[p[1]]).overlaps(near)) continue;
      const Node p0 = b.to_index(x_[p[0]]), p1 = b.to_index(x_[p[1]]);
      b.index->edges(Indexed::around(radius_, p0, p1), [&](int other) {
        if (f_.edges[other].level) return;
        const auto& q = f_.edges[other].node;
        if (a == b.surface && (other <= e || p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1])) return;
        if (f_.tied_edges(relation, e, other)) return;
        const double squared = closest_on_edges(p0, p1, place(q[0]), place(q[1])).squared;
        if (squared > radius_ * radius_) return;
        const auto &op = f_.edges[e].opposite, &oq = f_.edges[other].opposite;
        const auto or_end = [](int corner, const int (&ends)[2]) { return corner >= 0 ? corner : ends[0]; };
        list.edges.push_back({e, other, a, b.surface, {p[0], p[1], q[0], q[1], or_end(op[0], p), or_end(op[1], p), or_end(oq[0], q), or_end(oq[1], q)}, -1, std::sqrt(squared)});
      });
    }
  }

  // Keeps vertex v of surface `own`, at p, and a facet of surface `other`, at q, r, s, where they are near enough.
  void meet(int v, int own, const Node& p, int facet, int other, const Node& q, const Node& r, const Node& s) {
    if (f_.never_meet(v, own, facet, other)) return;
    const double squared = closest_on_facet(f_.corners(), p, q, r, s).squared;
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
  const Encounters& encounters_;
  const double radius_;
  struct Found {
    int vertex, facet;
    double distance;
  };
  std::vector<Found> found_;
};

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

NearList build_list(const Features& f, const NodeField& x, const PlacedTools& tools, const std::vector<Tie>& ties, double radius, Workspace& work) {
  const Encounters encounters(f, x, tools, radius);
  Builder build(f, x, tools, encounters);
  double clear;
  const bool any = encounters.each([&](int a, const Indexed& b, const Box& near) { build.search(a, b, near); },
                                   [&](int a, int tool) { build.vertices_against_plane(a, tool); }, clear);
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
