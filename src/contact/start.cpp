// Do the bodies start free of the tools? Small overlaps are mended, deep ones refused.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

#include "forming_sim/config/words.h"
#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/crossing.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

constexpr double kAlongAxis = 0.1;  // rings that face each other more squarely than this are not parted along the axis

/// "3.8e-07 m along (0, 0, -1)"
std::string length_and_direction(const Vec3& shift) {
  constexpr double kNone = 1e-6;  // of a direction: rounding
  const Vec3 along = shift.normalized().unaryExpr([](double c) { return std::abs(c) < kNone ? 0 : c; });
  std::ostringstream text;
  text << shift.norm() << " m along (" << along.x() << ", " << along.y() << ", " << along.z() << ")";
  return text.str();
}

// A vertex near a facet of the other side, or an edge near an edge, with the gap signed by what is inside.
struct StartGap {
  int vertex = -1;
  int surface = -1;            ///< of the facet, the second edge or the plane
  double gap = 0;              ///< to the tool set back; negative inside
  Node away = Node::Zero();    ///< from the tool to the body; of two bodies from the facet to the vertex
  int end = -1;                ///< of an edge from `vertex` on; -1: a vertex alone
};

constexpr double kShallow = 3;   // layers up to which a vertex that lies inside has a choice of facets to come out of
constexpr double kOn = 1e-6;      // of the layer: so near a facet a vertex lies on it
constexpr double kWedge = 1e-3;  // slope up to which a direction counts as along a facet

class Start {
 public:
  Start(double layer, const std::vector<int>& sides, const ContactSetup& setup, const NodeField& x, const Features& f, const ToolSet& tools)
      : layer_(layer), sides_(sides), setup_(setup), x_(x), f_(f), tools_(tools) {}

  /// To the bodies from one tool; tool -1: of the bodies from each other.
  std::vector<StartGap> gaps(int tool, const std::vector<ToolMotion>& motion, const NodeField& place) const {
    std::vector<bool> only(motion.size(), false);
    if (tool >= 0) only[tool] = motion[tool].present;
    Workspace work;
    const std::vector<PlanePose> planes = tools_.planes(motion);
    const double radius = 5 * layer_;
    const NearList list = build_list(f_, x_, {ToolIndex(f_, place, only), {}, only, tools_.is_plane, planes}, {}, radius, work);
    std::vector<StartGap> found;
    for (const auto& p : list.planes) found.push_back({p.vertex, f_.bodies + tool, dot3(x_[p.vertex] - planes[tool].point, planes[tool].normal), planes[tool].normal});
    const auto at = [&](int v) -> const Node& { return v < f_.body_nodes ? x_[v] : place[v - f_.body_nodes]; };
    for (const auto& g : list.groups) {
      const bool with_tool = f_.rigid(g.vertex) || g.surface >= f_.bodies;
      if (with_tool != (tool >= 0) || f_.vertex_surface[g.vertex] == g.surface) continue;
      if (const std::optional<StartGap> gap = gap_of(g, list, at)) found.push_back(*gap);
    }
    for (const auto& e : list.edges) {
      if (f_.about_ties(f_.relation(e.own, e.surface), f_.edges[e.first].node, f_.edges[e.second].node)) continue;
      const int other = f_.edges[e.second].surface;
      if ((other >= f_.bodies) != (tool >= 0) || f_.edges[e.first].surface == other) continue;
      add_edge_gap(e.first, e.second, at, found);
    }
    return found;
  }

  // Translations of the bodies after which no two of them are nearer than the
  // layer; empty where there are none of a few layers. Rings part along their axis only.
  std::vector<Node> part(const std::vector<StartGap>& gaps) const {
    std::vector<Node> t(f_.bodies, Node::Zero());
    for (int turn = 0; turn < 10000; ++turn) {
      double worst = 0;
      for (const StartGap& g : gaps) {
        Node &a = t[f_.vertex_surface[g.vertex]], &b = t[g.surface], way = g.away;
        const double missing = kOutside * layer_ - (g.gap + dot3(g.away, a - b));
        if (missing <= 0) continue;
        if (setup_.axisymmetric) {
          if (std::abs(way[1]) < kAlongAxis) return {};
          way = Node(0, 1 / way[1], 0, 0);
        }
        a += 0.5 * missing * way;
        b -= 0.5 * missing * way;
        worst = std::max(worst, missing);
      }
      if (worst < 1e-6 * layer_) return t;
    }
    return {};
  }

  // A small translation of the tool after which no gap is less than the layer;
  // zero where there is none.
  Node back_off(const std::vector<StartGap>& gaps) const {
    Node t = Node::Zero();
    for (int turn = 0; turn < 200; ++turn) {
      double worst = 0;
      for (const StartGap& g : gaps) {
        const double missing = kOutside * layer_ - (g.gap - dot3(g.away, t));
        if (missing <= 0) continue;
        t -= missing * g.away;
        worst = std::max(worst, missing);
      }
      if (worst < 1e-3 * layer_) return t;
    }
    return Node::Zero();
  }

  /// How deep the corners of a body's facet lie behind both facets of a tool's edge that pierces it, m; of other crossings how far the nearer end of the edge has come through.
  template <class At> double depth_of(const Crossing& c, At&& at) const {
    const auto& corner = f_.facets[c.facet];
    const Node n = facet_normal(f_.dimension, at(corner[0]), at(corner[1]), at(corner[f_.corners() - 1]));
    const double through = std::min(std::abs(dot3(at(c.edge[0]) - at(corner[0]), n)), std::abs(dot3(at(c.edge[1]) - at(corner[0]), n)));
    const int edge = f_.dimension == 3 && f_.rigid(c.edge[0]) ? edge_between(c.edge[0], c.edge[1]) : -1;
    if (edge < 0) return through;
    double deepest = 0;
    const Features::Edge& e = f_.edges[edge];
    for (int k = 0; k < 3; ++k) {
      double behind = std::numeric_limits<double>::infinity();
      for (int i = 0; i < std::min(e.facets, 2); ++i) behind = std::min(behind, -dot3(at(corner[k]) - at(e.node[0]), outward_normal(e, i, at)));
      deepest = std::max(deepest, behind);
    }
    return deepest > 0 && std::isfinite(deepest) ? std::min(deepest, through) : through;
  }

  std::string surface_name(int surface) const {
    return surface < f_.bodies ? "body " + setup_.bodies[surface].name : "tool " + setup_.tools[surface - f_.bodies].name;
  }
  std::string vertex_name(int v, const Node& at) const {
    std::ostringstream text;
    if (v < f_.body_nodes)
      text << "node " << v << " of body " << setup_.bodies[f_.vertex_surface[v]].name;
    else
      text << "a vertex of " << surface_name(f_.vertex_surface[v]);
    text << " at (" << at[0] << ", " << at[1] << ", " << at[2] << ") m";
    return text.str();
  }

 private:
  int edge_between(int a, int b) const {
    if (edges_.empty())
      for (std::size_t i = 0; i < f_.edges.size(); ++i) edges_[std::minmax(f_.edges[i].node[0], f_.edges[i].node[1])] = static_cast<int>(i);
    const auto found = edges_.find(std::minmax(a, b));
    return found == edges_.end() ? -1 : found->second;
  }

  // Of a vertex to the facets near it: to the nearest, or, where it lies inside, to the one by which it comes out.
  template <class At> std::optional<StartGap> gap_of(const NearList::VertexGroup& g, const NearList& list, At&& at) const {
    const Node& p = at(g.vertex);
    double best = 1e300, slope = -1e300;
    StartGap gap, out;
    gap.vertex = out.vertex = g.vertex;
    gap.surface = out.surface = g.surface;
    double most_room = -1e300;
    for (int i = g.first; i < g.last; ++i) {
      const int facet = list.facets[i].facet;
      const auto& c = f_.facets[facet];
      if (f_.about_ties(f_.relation(f_.vertex_surface[g.vertex], g.surface), std::array<int, 1>{g.vertex}, c)) continue;
      const Node& third = at(c[f_.corners() - 1]);
      const Closest q = closest_on_facet(f_.corners(), p, at(c[0]), at(c[1]), third);
      const Node& d = q.apart;
      const int side = f_.rigid(c[0]) ? sides_[facet] : f_.facet_outward[facet];
      const Node n = side * facet_normal(f_.dimension, at(c[0]), at(c[1]), third);
      const double distance = std::sqrt(q.squared), along = dot3(d, n);
      if (distance < kShallow * layer_ && along <= kOn * layer_ - 0.999 * distance) {  // behind it, or on it
        const double free = room(g.vertex, n, at);
        if (free > most_room + 1e-6 || (free > most_room - 1e-6 && along > out.gap)) {
          most_room = std::max(free, most_room);
          out.gap = along;
          out.away = f_.rigid(g.vertex) ? Node(-n) : n;
        }
      }
      if (q.squared > best * (1 + 1e-9) + 1e-12 * layer_ * layer_) continue;
      // Of facets that are equally near, the one that is met most squarely; where the vertex
      // lies on them, the one with the most of the vertex' own surface before it.
      const double square = distance > kOn * layer_ ? std::abs(along) : room(g.vertex, n, at);
      if (q.squared >= best * (1 - 1e-9) - 1e-12 * layer_ * layer_ && square <= slope) continue;
      slope = square;
      best = std::min(best, q.squared);
      gap.gap = along < 0 ? -distance : distance;
      // From the second feature to the vertex, on the outer side; then from tool to body.
      gap.away = distance > kOn * layer_ ? Node(d / gap.gap) : n;
      if (f_.rigid(g.vertex)) gap.away = -gap.away;
    }
    // Inside a corner the nearest facet need not be the way out: that is where the vertex' own surface has room.
    if (best == 1e300) return std::nullopt;
    // (Before it by less than half of kOn it counts as on it, above.)
    return gap.gap < 0.5 * kOn * layer_ && most_room > -1e300 ? out : gap;
  }

  // How far the vertex' own surface lies before the plane through it with normal n:
  // the least slope of the edges that leave it.
  template <class At> double room(int vertex, const Node& n, At&& at) const {
    double least = 1;
    for (int i = f_.first_neighbour[vertex]; i < f_.first_neighbour[vertex + 1]; ++i) {
      const Node along = at(f_.neighbours[i]) - at(vertex);
      const double slope = dot3(along, n) / std::sqrt(dot3(along, along));
      least = std::min(least, slope);
    }
    return least;
  }

  // Two edges meet along the one normal of both that points out of the wedge of
  // the second and into that of the first; this tells the sign of their gap, also
  // where they touch or overlap.
  template <class At> void add_edge_gap(int first, int second, At&& at, std::vector<StartGap>& found) const {
    const auto &a = f_.edges[first].node, &b = f_.edges[second].node;
    if (!closest_on_edges(at(a[0]), at(a[1]), at(b[0]), at(b[1])).crossing) return;
    const Node common = cross3(at(a[1]) - at(a[0]), at(b[1]) - at(b[0])).normalized();
    for (const double sense : {1., -1.}) {
      const Node n = sense * common;
      if (!leaves(second, n, at) || !leaves(first, -n, at)) continue;
      found.push_back({a[0], f_.edges[second].surface, dot3(n, at(a[0]) - at(b[0])), n, a[1]});
      return;
    }
  }

  // Does n point out of the solid wedge at an edge, beside none of its facets?
  template <class At> bool leaves(int edge, const Node& n, At&& at) const {
    const Features::Edge& e = f_.edges[edge];
    if (e.facets > 2) return false;
    const Node u = at(e.node[1]) - at(e.node[0]);
    double outward = 0;
    for (int k = 0; k < e.facets; ++k) {
      const Node r = at(e.opposite[k]) - at(e.node[0]), inward = r - dot3(r, u) / dot3(u, u) * u;
      if (dot3(n, inward) > kWedge * inward.norm()) return false;
      outward += dot3(n, outward_normal(e, k, at));
    }
    return outward > kWedge;
  }

  template <class At> Node outward_normal(const Features::Edge& e, int k, At&& at) const {
    const int facet = e.facet[k];
    const auto& c = f_.facets[facet];
    const int side = f_.rigid(c[0]) ? sides_[facet] : f_.facet_outward[facet];
    return side * facet_normal(3, at(c[0]), at(c[1]), at(c[2]));
  }

  double layer_;
  const std::vector<int>& sides_;
  const ContactSetup& setup_;
  const NodeField& x_;
  const Features& f_;
  const ToolSet& tools_;
  mutable std::map<std::pair<int, int>, int> edges_;  ///< by their ends, once they are asked for
};

}  // namespace

BodiesAtStart look_at_bodies(double layer, const ContactSetup& setup, const Features& f, const NodeField& x) {
  constexpr double kTouch = .05;  // of the layer
  BodiesAtStart found;
  if (f.bodies < 2) return found;
  const ToolSet none;
  const std::vector<int> sides;
  std::map<std::pair<int, int>, double> nearest;
  for (const StartGap& g : Start(layer, sides, setup, x, f, none).gaps(-1, {}, {})) {
    const int own = f.vertex_surface[g.vertex];
    double& gap = nearest.try_emplace({std::min(own, g.surface), std::max(own, g.surface)}, g.gap).first->second;
    gap = std::min(gap, g.gap);
  }
  std::vector<int> pack(f.bodies);  // by the least number of a body that touches it, straight or through others
  std::iota(pack.begin(), pack.end(), 0);
  const auto join = [&](int a, int b) {
    const int low = std::min(pack[a], pack[b]), high = std::max(pack[a], pack[b]);
    std::replace(pack.begin(), pack.end(), high, low);
  };
  for (int a = 0; a < f.bodies; ++a)
    for (int b = a + 1; b < f.bodies; ++b)
      if (f.relation(a, b).tie >= 0) join(a, b);
  for (const auto& [pair, gap] : nearest) {
    if (gap <= kTouch * layer) join(pair.first, pair.second);
    else if (found.clearance == 0 || gap < found.clearance) found.clearance = gap;
  }
  found.in_one_pack = std::all_of(pack.begin(), pack.end(), [](int first) { return first == 0; });
  return found;
}

std::vector<Vec3> part_bodies(double layer, const ContactSetup& setup, const Features& f, NodeField& x, std::vector<std::string>& warnings) {
  std::vector<Vec3> shifts(f.bodies, Vec3::Zero());
  if (f.bodies < 2) return shifts;
  const ToolSet none;
  const std::vector<int> sides;
  const Start start(layer, sides, setup, x, f, none);
  const std::vector<StartGap> gaps = start.gaps(-1, {}, {});
  if (std::none_of(gaps.begin(), gaps.end(), [&](const StartGap& g) { return g.gap < 0.99 * layer; })) return shifts;
  const std::vector<Node> moves = start.part(gaps);
  if (moves.empty() && setup.axisymmetric)
    throw Error(Code::initial_penetration, "bodies touch each other radially at the start, and a ring cannot be moved aside: leave a gap of at least " +
                                               three_digits(layer) + " m between them");
  for (int b = 0; b < static_cast<int>(moves.size()); ++b) {
    if (moves[b].isZero(0) || moves[b].norm() > 8 * f.bodies * layer) continue;  // no way out: left as it is, check_start decides
    shifts[b] = vec3(moves[b]);
    for (int v : f.surfaces[b].vertices) x[v] += moves[b];
    std::ostringstream text;
    text << "body " << setup.bodies[b].name << " touches another body at the start: it was moved by " << length_and_direction(shifts[b]);
    warnings.push_back(text.str());
  }
  return shifts;
}

void check_start(double layer, const std::vector<int>& sides, Flush& flush, const ContactSetup& setup, const NodeField& x,
                 const std::vector<ToolMotion>& at_start, Features& f, ToolSet& tools, std::vector<std::string>& warnings) {
  const Start start(layer, sides, setup, x, f, tools);
  std::vector<std::pair<double, std::string>> refused;  // with how deep it lies, m; what is all inside first
  NodeField place;
  tools.place_all(f, at_start, place);
  std::vector<bool> told(setup.tools.size(), false), too_near = told;
  std::vector<std::vector<StartGap>> gaps_of(setup.tools.size());
  std::vector<std::string> laid_on;
  tools.touching.assign(setup.tools.size(), false);
  for (size_t t = 0; t < setup.tools.size(); ++t) {
    if (!at_start[t].present) continue;
    const int tool = static_cast<int>(t);
    const std::vector<StartGap> gaps = start.gaps(tool, at_start, place);
    bool close = false, touches = false;
    for (const StartGap& g : gaps) {
      if (g.gap < 0.99 * layer) close = true;
      if (g.gap < 1.01 * layer) touches = true;
      if (g.gap >= -1.001 * layer) continue;
      const Node& p = g.vertex < f.body_nodes ? x[g.vertex] : place[g.vertex - f.body_nodes];
      std::ostringstream text;
      text << start.vertex_name(g.vertex, p);
      if (g.end >= 0) text << " and " << start.vertex_name(g.end, x[g.end]) << " are joined by an edge that";
      text << " lies " << layer - g.gap << " m deep in " << (g.vertex < f.body_nodes ? "tool " + setup.tools[t].name : "a body");
      refused.emplace_back(layer - g.gap, text.str());
      told[t] = true;
    }
    tools.touching[t] = touches;
    if (touches && !close) laid_on.push_back("tool " + setup.tools[t].name);
    too_near[t] = close;
    gaps_of[t] = gaps;
  }
  /// Moves these as one; false where there is no way out.
  const auto back_off = [&](const std::vector<int>& those) {
    std::vector<StartGap> gaps;
    std::vector<std::string> names;
    for (const int t : those) {
      gaps.insert(gaps.end(), gaps_of[t].begin(), gaps_of[t].end());
      names.push_back(setup.tools[t].name);
    }
    const Node shift = start.back_off(gaps);
    if (shift.isZero(0) || shift.norm() > 8 * layer) return false;
    for (const int t : those) {
      const Vec3 local = at_start[t].rotation0.transpose() * vec3(shift);
      for (int v : f.surfaces[f.bodies + t].vertices) f.place[v - f.body_nodes] += node(local);
      if (tools.is_plane[t]) tools.point[t] += local;
    }
    const bool alone = names.size() == 1;
    std::ostringstream text;
    text << (alone ? "tool " : "tools ") << one_of(names, " and ") << (alone ? " touches or overlaps a body at the start: it was" : " touch or overlap a body at the start: together they were")
         << " backed off by " << length_and_direction(vec3(shift));
    warnings.push_back(text.str());
    return true;
  };
  for (size_t t = 0; t < setup.tools.size(); ++t) {
    const std::vector<int> together = flush.together(static_cast<int>(t));
    const auto any = [&](const std::vector<bool>& of) { return std::any_of(together.begin(), together.end(), [&](int one) { return of[one]; }); };
    if (together.front() != static_cast<int>(t) || !any(too_near)) continue;
    if (!any(told) && back_off(together)) continue;
    if (together.size() == 1) continue;  // no way out: left as it is, the check below decides
    flush.part(together);
    for (const int one : together) {
      if (too_near[one] && !told[one]) back_off({one});
      too_near[one] = false;
    }
  }
  if (!laid_on.empty()) {
    const bool one = laid_on.size() == 1;
    std::ostringstream text;
    text << one_of(laid_on, " and ") << (one ? " touches a body at the start: it was" : " touch a body at the start: they were") << " backed off by the contact layer, " << layer << " m along "
         << (one ? "its" : "their") << " normals";
    warnings.push_back(text.str());
  }
  tools.place_all(f, at_start, place);
  const auto at = [&](int v) -> const Node& { return v < f.body_nodes ? x[v] : place[v - f.body_nodes]; };
  for (const Crossing& c : find_crossings(f, x, place, ToolSet::present(at_start), tools.is_plane, tools.planes(at_start))) {
    if (c.other >= f.bodies && told[c.other - f.bodies]) continue;
    const int pierced = c.facet >= 0 ? f.facet_surface[c.facet] : f.vertex_surface[c.edge[0]] == c.surface ? c.other : c.surface;
    std::ostringstream text;
    double deep = std::numeric_limits<double>::infinity();
    text << start.vertex_name(c.edge[0], at(c.edge[0]));
    if (c.facet < 0) {
      text << " lies inside " << start.surface_name(pierced);
      if (pierced >= f.bodies) text << " (a container is given with the outside of its walls too, or open)";
    } else {
      const double depth = start.depth_of(c, at);
      text << " and " << start.vertex_name(c.edge[1], at(c.edge[1])) << " are joined by an edge that pierces a facet of "
           << start.surface_name(pierced) << " by " << depth + layer << " m";
      deep = depth + layer;
    }
    refused.emplace_back(deep, text.str());
  }
  if (refused.empty()) return;
  std::ostringstream text;
  text << refused.size() << " pairs of tools and bodies overlap at the start by more than " << 2 * layer
       << " m: move the tool's position, or where its motion begins, or the body, so that they at most touch (arcs of profiles are chords, which lie up to tools[].profile.chord_error aside of them).";
  std::stable_sort(refused.begin(), refused.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (refused.size() > 10) text << " The ten deepest:";
  for (size_t i = 0; i < std::min<size_t>(refused.size(), 10); ++i) text << "\n  " << refused[i].second;
  throw Error(Code::initial_penetration, text.str());
}

}  // namespace forming_sim
