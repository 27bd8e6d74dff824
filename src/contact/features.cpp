#include "forming_sim/contact/features.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "forming_sim/contact/closest.h"
#include "forming_sim/mesh/axis.h"

namespace forming_sim {
namespace {

// Numbers of a tool's nodes in the order of their places: nodes at one place
// are one vertex, and the order in which a file lists them has no effect.
std::vector<int> number_by_place(const std::vector<Vec3>& nodes, NodeField& place) {
  std::vector<int> order(nodes.size()), number(nodes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int a, int b) {
    for (int k = 0; k < 3; ++k)
      if (nodes[a][k] != nodes[b][k]) return nodes[a][k] < nodes[b][k];
    return false;
  };
  std::sort(order.begin(), order.end(), before);
  int count = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || before(order[i - 1], order[i])) {
      place.push_back(node(nodes[order[i]]));
      ++count;
    }
    number[order[i]] = count - 1;
  }
  return number;
}

// Corners in rising order; false for a facet that has collapsed (its edges
// belong to its neighbours).
bool sorted_corners(int corners, std::array<int, 3>& c, int& parity) {
  if (corners == 2) c[2] = std::numeric_limits<int>::max();
  parity = 1;
  const auto order = [&](int i, int j) {
    if (c[i] <= c[j]) return;
    std::swap(c[i], c[j]);
    parity = -parity;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  if (corners == 2) c[2] = -1;
  return c[0] != c[1] && c[1] != c[2];
}

void find_vertices(Features& f, Features::Surface& s) {
  for (int i = s.first_facet; i < s.last_facet; ++i)
    for (int k = 0; k < f.corners(); ++k) s.vertices.push_back(f.facets[i][k]);
  std::sort(s.vertices.begin(), s.vertices.end());
  s.vertices.erase(std::unique(s.vertices.begin(), s.vertices.end()), s.vertices.end());
}

void find_edges(Features& f, int surface) {
  Features::Surface& s = f.surfaces[surface];
  s.first_edge = s.last_edge = static_cast<int>(f.edges.size());
  if (f.dimension == 2) return;
  struct Side {
    int a, b, facet, side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * (s.last_facet - s.first_facet));
  for (int i = s.first_facet; i < s.last_facet; ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = f.facets[i][k], b = f.facets[i][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), i, k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
    return p.a != q.a ? p.a < q.a : p.b != q.b ? p.b < q.b : p.facet != q.facet ? p.facet < q.facet : p.side < q.side;
  });
  for (size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i == 0 || side.a != sides[i - 1].a || side.b != sides[i - 1].b) {
      f.edges.emplace_back();
      f.edges.back().node[0] = side.a;
      f.edges.back().node[1] = side.b;
      f.edges.back().surface = surface;
    }
    Features::Edge& edge = f.edges.back();
    if (edge.facets < 2) {
      edge.facet[edge.facets] = side.facet;
      edge.opposite[edge.facets] = f.facets[side.facet][(side.side + 2) % 3];
    }
    ++edge.facets;
    f.facet_edges[side.facet][side.side] = static_cast<int>(f.edges.size()) - 1;
  }
  s.last_edge = static_cast<int>(f.edges.size());
}

void find_neighbours(Features& f) {
  f.first_neighbour.assign(f.vertex_count + 1, 0);
  const auto each = [&](auto&& act) {
    if (f.dimension == 2)
      for (const auto& c : f.facets) act(c[0], c[1]);
    else
      for (const auto& e : f.edges) act(e.node[0], e.node[1]);
  };
  each([&](int a, int b) { ++f.first_neighbour[a + 1], ++f.first_neighbour[b + 1]; });
  for (int v = 0; v < f.vertex_count; ++v) f.first_neighbour[v + 1] += f.first_neighbour[v];
  f.neighbours.resize(f.first_neighbour.back());
  std::vector<int> next(f.first_neighbour.begin(), f.first_neighbour.end() - 1);
  each([&](int a, int b) {
    f.neighbours[next[a]++] = b;
    f.neighbours[next[b]++] = a;
  });
}

void measure_bodies(Features& f, const NodeField& x, bool axisymmetric) {
  f.area.assign(f.body_nodes, 0.0);
  f.smallest_edge = std::numeric_limits<double>::infinity();
  double sum = 0;
  long count = 0;
  const int last = f.bodies == 0 ? 0 : f.surfaces[f.bodies - 1].last_facet;
  for (int i = 0; i < last; ++i) {
    const auto& c = f.facets[i];
    const int corners = f.corners();
    for (int k = 0; k < (corners == 2 ? 1 : 3); ++k) {
      const double length = (x[c[(k + 1) % corners]] - x[c[k]]).norm();
      f.smallest_edge = std::min(f.smallest_edge, length);
      sum += length;
      ++count;
    }
    const double size = corners == 2 ? (x[c[1]] - x[c[0]]).norm() : cross3(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]).norm() / 2;
    for (int k = 0; k < corners; ++k) f.area[c[k]] += size * (axisymmetric ? turned_share(x[c[k]][0], x[c[1 - k]][0]) : 1.0 / corners);
  }
  f.mean_edge = count > 0 ? sum / count : 0;
}

// Every body meets every tool and other body, and itself where it says so; then what `pairs` says.
void set_relations(const ContactSetup& setup, const NodeField& x, Features& f) {
  const int bodies = f.bodies, surfaces = static_cast<int>(f.surfaces.size());
  f.relations.assign(surfaces * surfaces, Features::Relation());
  const auto set = [&](int a, int b, bool meet, double friction, double limit) { f.relation(a, b) = f.relation(b, a) = {meet, friction, limit, -1, -1}; };
  const auto find = [&](const std::string& name) {
    for (int s = 0; s < surfaces; ++s)
      if ((s < bodies ? setup.bodies[s] : setup.tools[s - bodies]).name == name) return s;
    throw Error(Code::invalid_scene, "contact.pairs names " + name + ", which is neither a body nor a tool");
  };
  for (int a = 0; a < bodies; ++a) {
    set(a, a, setup.bodies[a].meets_itself, setup.config.friction, setup.config.friction_limit);
    for (int b = a + 1; b < bodies; ++b) set(a, b, true, setup.config.friction, setup.config.friction_limit);
    for (int t = bodies; t < surfaces; ++t) set(a, t, true, setup.tools[t - bodies].friction, setup.tools[t - bodies].friction_limit);
  }
  for (const PairConfig& pair : setup.config.pairs)
    set(find(pair.first), find(pair.second), pair.kind != "none",
        pair.kind == "sticking" ? std::numeric_limits<double>::max() : pair.kind == "frictionless" ? 0 : pair.friction, pair.friction_limit);
  // The finer of two surfaces that stick does so first.
  const auto mean_face = [&](int surface) {
    const Features::Surface& s = f.surfaces[surface];
    double sum = 0;
    for (int i = s.first_facet; i < s.last_facet; ++i) {
      const auto& c = f.facets[i];
      sum += f.dimension == 2 ? (x[c[1]] - x[c[0]]).norm() : cross3(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]).norm();
    }
    return sum / std::max(1, s.last_facet - s.first_facet);
  };
  for (int a = 0; a < bodies; ++a)
    for (int b = a + 1; b < bodies; ++b) {
      Features::Relation& relation = f.relation(a, b);
      if (relation.friction < std::numeric_limits<double>::max() || relation.friction_limit > 0) continue;
      relation.sticks_by = f.relation(b, a).sticks_by = mean_face(b) < mean_face(a) ? b : a;
    }
}

}  // namespace

bool Features::bodies_meet() const {
  for (int a = 0; a < bodies; ++a)
    for (int b = a; b < bodies; ++b)
      if (relation(a, b).meet) return true;
  return false;
}

Features build_features(const ContactSetup& setup, const NodeField& x) {
  Features f;
  f.dimension = setup.dimension;
  f.body_nodes = static_cast<int>(x.size());
  f.bodies = static_cast<int>(setup.bodies.size());
  f.vertex_count = f.body_nodes;
  const auto add_surface = [&](const std::vector<Facet>& facets, int first_vertex, const std::vector<int>* number) {
    Features::Surface s;
    s.first_vertex = first_vertex;
    s.first_facet = static_cast<int>(f.facets.size());
    for (const Facet& facet : facets) {
      std::array<int, 3> corner{-1, -1, -1};
      for (int k = 0; k < f.corners(); ++k) corner[k] = first_vertex + (number ? (*number)[facet.nodes[k]] : facet.nodes[k]);
      int parity;
      if (!sorted_corners(f.corners(), corner, parity)) continue;
      f.facets.push_back(corner);
      f.facet_outward.push_back(number ? 1 : parity);
    }
    if (number) {
      std::sort(f.facets.begin() + s.first_facet, f.facets.end());
      f.facets.erase(std::unique(f.facets.begin() + s.first_facet, f.facets.end()), f.facets.end());
    }
    s.last_facet = static_cast<int>(f.facets.size());
    f.facet_outward.resize(f.facets.size());
    f.facet_surface.resize(f.facets.size(), static_cast<int>(f.surfaces.size()));
    f.surfaces.push_back(std::move(s));
  };
  for (const ContactSurface& body : setup.bodies) {
    add_surface(body.facets, 0, nullptr);
  }
  for (size_t t = 0; t < setup.tools.size(); ++t) {
    if (setup.tools[t].plane) {
      add_surface({}, f.vertex_count, nullptr);
      continue;
    }
    const std::vector<int> number = number_by_place(setup.tool_meshes[t]->nodes, f.place);
    add_surface(setup.tools[t].facets, f.vertex_count, &number);
    f.vertex_count = f.body_nodes + static_cast<int>(f.place.size());
  }
  set_relations(setup, x, f);
  f.facet_edges.resize(f.facets.size());
  f.facets_at_vertex.assign(f.vertex_count, 0);
  f.vertex_surface.assign(f.vertex_count, -1);
  for (size_t i = 0; i < f.surfaces.size(); ++i) {
    find_vertices(f, f.surfaces[i]);
    for (int v : f.surfaces[i].vertices) f.vertex_surface[v] = static_cast<int>(i);
    find_edges(f, static_cast<int>(i));
  }
  for (const auto& facet : f.facets)
    for (int k = 0; k < f.corners(); ++k) ++f.facets_at_vertex[facet[k]];
  find_neighbours(f);
  measure_bodies(f, x, setup.axisymmetric);
  return f;
}

void find_level_parts(Features& f) {
  constexpr double kLevel = 1e-6;  // slope
  f.level_vertex.assign(f.place.size(), f.dimension == 3);
  for (Features::Edge& edge : f.edges) {
    if (!f.rigid(edge.node[0])) continue;
    const auto at = [&](int v) { return vec3(f.place[v - f.body_nodes]); };
    if (edge.facets == 2) {
      const Vec3 along = (at(edge.node[1]) - at(edge.node[0])).normalized();
      const auto across = [&](int corner) {
        const Vec3 way = at(corner) - at(edge.node[0]);
        return Vec3(way - way.dot(along) * along);
      };
      const Vec3 a = across(edge.opposite[0]), b = across(edge.opposite[1]);
      edge.level = a.dot(b) < 0 && a.cross(b).norm() <= kLevel * a.norm() * b.norm();
    }
    for (int v : edge.node)
      if (!edge.level) f.level_vertex[v - f.body_nodes] = false;
  }
}

bool Features::tied_edge_to_facet(const Relation& relation, int e, int facet) const {
  if (relation.tie < 0) return false;
  const int* ends = dimension == 2 ? facets[e].data() : edges[e].node;
  for (int k = 0; k < 2; ++k) {
    if (tied_to_facet(relation, ends[k], facet)) return true;
    if (dimension == 2 && tied_to_facet(relation, facets[facet][k], e)) return true;
  }
  if (dimension == 3)
    for (int border : facet_edges[facet])
      if (tied_edges(relation, e, border)) return true;
  return false;
}

}  // namespace forming_sim
