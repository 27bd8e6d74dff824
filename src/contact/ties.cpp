#include "forming_sim/contact/ties.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/list.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

constexpr double kOwn = 0.1;  ///< least weight with which a tie holds a vertex of its own
constexpr double kTouches = 1e-9;  ///< of its feature: nearer is rounding
constexpr double kAcross = 0.1;  ///< sine between edges that are tied apart from each other
constexpr double kAsNear = 1e-3;  ///< of the distance of a tie, and of 1, a cosine: facets that differ by less are as near, and face as well

struct EdgeLengths {
  double smallest = std::numeric_limits<double>::infinity(), mean = 0;
};

EdgeLengths edge_lengths(const Features& f, int surface, const NodeField& x) {
  EdgeLengths found;
  double sum = 0;
  long count = 0;
  for (int v : f.surfaces[surface].vertices)
    for (int i = f.first_neighbour[v]; i < f.first_neighbour[v + 1]; ++i) {
      const double length = (x[f.neighbours[i]] - x[v]).norm();
      found.smallest = std::min(found.smallest, length);
      sum += length;
      ++count;
    }
  found.mean = count > 0 ? sum / count : 0;
  return found;
}

// The two surfaces of a tied pair: vertices of `first` are tied to `second`.
struct TiedPair {
  int first = -1, second = -1;
  double distance = 0;      ///< up to which vertices are tied, m
  double near = 0;          ///< up to which features that touch the other surface do not meet its features, m
};

// The frame that goes with the second feature of a tie: of a facet, or of an edge and the direction of the one across it.
// place(k): of the k-th node.
template <class Place> Mat3 frame_of(const Tie& tie, Place&& place) {
  const bool edges = tie.weight[1] > 0;  // the second node is of the first feature too
  const Vec3 along = vec3(edges ? Node(place(3) - place(2)) : Node(place(2) - place(1))).normalized();
  Vec3 normal = Vec3::UnitZ();
  if (tie.nodes == 4) normal = along.cross(vec3(edges ? Node(place(1) - place(0)) : Node(place(3) - place(1)))).normalized();
  Mat3 frame;
  frame.col(0) = along;
  frame.col(1) = normal.cross(along);
  frame.col(2) = normal;
  return frame;
}

// By which the frame turns with its nodes: W_k, where it turns by the sum of W_k dx_k. Its first axis a goes with one edge of length L, from p to q; in space its third, n, is across that
// and d = u a + H b, the way from s to t.
template <class Place> std::array<Mat3, 4> turning(const Tie& tie, const Mat3& frame, Place&& place) {
  std::array<Mat3, 4> W;
  W.fill(Mat3::Zero());
  const bool edges = tie.weight[1] > 0;
  const int p = edges ? 2 : 1, q = p + 1, s = edges ? 0 : 1, t = edges ? 1 : 3;
  const Vec3 a = frame.col(0), b = frame.col(1), n = frame.col(2);
  const double L = (vec3(place(q)) - vec3(place(p))).norm();
  const Mat3 around_n = n * b.transpose() / L;
  W[q] += around_n;
  W[p] -= around_n;
  if (tie.nodes < 4) return W;
  const Vec3 d = vec3(place(t)) - vec3(place(s));
  const double u = d.dot(a), H = d.dot(b);
  const Mat3 around_b = -b * n.transpose() / L, around_a = a * n.transpose() / H;
  W[q] += around_b - around_a * (u / L);
  W[p] -= around_b - around_a * (u / L);
  W[t] += around_a;
  W[s] -= around_a;
  return W;
}

Tie tie_to_facet(const Features& f, int vertex, int facet, const Closest& closest) {
  Tie tie;
  tie.node[0] = vertex;
  tie.weight[0] = 1;
  for (int k = 0; k < f.corners(); ++k) {
    tie.node[1 + k] = f.facets[facet][k];
    tie.weight[1 + k] = -closest.weight[k];
  }
  tie.nodes = 1 + f.corners();
  return tie;
}

Tie tie_edges(const int* p, const int* q, const ClosestEdges& closest) {
  Tie tie;
  const double weight[4] = {1 - closest.s, closest.s, closest.t - 1, -closest.t};
  std::copy(weight, weight + 4, tie.weight);
  std::copy(p, p + 2, tie.node);
  std::copy(q, q + 2, tie.node + 2);
  tie.nodes = 4;
  return tie;
}

Tie tie_to_tool(int vertex, int tool, const Node& normal) {
  Tie tie;
  tie.node[0] = vertex;
  tie.weight[0] = 1;
  tie.nodes = 1;
  tie.tool = tool;
  tie.press = vec3(normal);
  return tie;
}

// Outwards at the vertices of the bodies, of no certain length; zero at those of tools.
NodeField outwards(const Features& f, const NodeField& x) {
  NodeField sum(f.vertex_count, Node::Zero());
  for (std::size_t i = 0; i < f.facets.size(); ++i) {
    if (f.facet_surface[i] >= f.bodies) continue;
    const auto& c = f.facets[i];
    const Node normal = f.facet_outward[i] * facet_normal(f.dimension, x[c[0]], x[c[1]], x[c[f.corners() - 1]]);
    for (int k = 0; k < f.corners(); ++k) sum[c[k]] += normal;
  }
  return sum;
}

// Of the ties at a rim as many as can each have a vertex to move that no other tie has: what is told more than its
// vertices can follow is never at rest, and each step's correction would be a kick. Ties that have most of such a vertex come first.
std::vector<Tie> those_with_a_vertex(const Features& f, const std::vector<Tie>& ties, std::vector<Tie> rim) {
  std::vector<bool> taken(f.vertex_count, false);
  for (const Tie& tie : ties)
    for (int k = 0; k < tie.nodes; ++k) taken[tie.node[k]] = true;
  const auto own = [&](const Tie& tie) {  // which of its nodes, -1: none
    int best = -1;
    for (int k = 0; k < tie.nodes; ++k)
      if (!f.rigid(tie.node[k]) && !taken[tie.node[k]] && std::abs(tie.weight[k]) > (best < 0 ? kOwn : std::abs(tie.weight[best]))) best = k;
    return best;
  };
  const auto share = [&](const Tie& tie) { return own(tie) < 0 ? 0 : std::abs(tie.weight[own(tie)]); };
  std::stable_sort(rim.begin(), rim.end(), [&](const Tie& a, const Tie& b) { return share(a) > share(b); });
  std::vector<Tie> chosen;
  for (const Tie& tie : rim) {
    const int k = own(tie);
    if (k < 0) continue;
    taken[tie.node[k]] = true;
    chosen.push_back(tie);
  }
  return chosen;
}

[[noreturn]] void refuse(const ContactSetup& setup, const Features& f, const TiedPair& pair) {
  const auto name = [&](int s) { return s < f.bodies ? "body " + setup.bodies[s].name : "tool " + setup.tools[s - f.bodies].name; };
  std::ostringstream text;
  text << "contact.pairs ties " << name(pair.first) << " to " << name(pair.second) << ", but no vertex of " << name(pair.first) << " is within "
       << pair.distance << " m of it: bring them together at the start, or give a larger tie_distance";
  throw Error(Code::invalid_scene, text.str());
}

}  // namespace

std::vector<Tie> find_ties(const ContactSetup& setup, const NodeField& x, const NodeField& place, const std::vector<bool>& is_plane,
                           const std::vector<PlanePose>& planes, Features& f) {
  std::vector<TiedPair> pairs;
  std::vector<Tie> ties;
  std::vector<std::uint64_t> touching_facets, touching_edges;
  double radius = 0;
  for (const PairConfig& config : setup.config.pairs) {
    if (config.kind != "tied") continue;
    TiedPair pair;
    for (int s = 0; s < static_cast<int>(f.surfaces.size()); ++s) {
      const std::string& name = (s < f.bodies ? setup.bodies[s] : setup.tools[s - f.bodies]).name;
      if (name == config.first) pair.first = s;
      if (name == config.second) pair.second = s;
    }
    const EdgeLengths a = edge_lengths(f, pair.first, x);
    pair.distance = 0.1 * a.smallest;
    if (pair.second < f.bodies) {
      const EdgeLengths b = edge_lengths(f, pair.second, x);
      pair.distance = 0.1 * std::min(a.smallest, b.smallest);
      if (b.mean < a.mean) std::swap(pair.first, pair.second);
    }
    pair.near = std::max({pair.distance, config.tie_distance, 2 * setup.config.layer});
    if (config.tie_distance > 0) pair.distance = config.tie_distance;
    radius = std::max(radius, pair.near);
    pairs.push_back(pair);
  }
  if (pairs.empty()) return ties;
  Workspace work;
  const std::vector<bool> all(setup.tools.size(), true);
  const NodeField out = outwards(f, x);
  const NearList list = build_list(f, x, {ToolIndex(f, place, all), {}, all, is_plane, planes}, {}, radius, work);
  const auto at = [&](int v) -> const Node& { return v < f.body_nodes ? x[v] : place[v - f.body_nodes]; };
  for (const TiedPair& pair : pairs) {
    std::vector<bool> zone(f.vertex_count, false), tied(f.vertex_count, false), touches(f.vertex_count, false);
    std::vector<int> near;  // facets, of a vertex
    const std::size_t before = ties.size();
    std::vector<Tie> of_second, rim;
    for (const auto& g : list.groups) {
      const int own = f.vertex_surface[g.vertex];
      if (!(own == pair.first && g.surface == pair.second) && !(own == pair.second && g.surface == pair.first)) continue;
      Closest nearest;
      int facet = -1;
      near.clear();
      const auto closest = [&](int of) {
        const auto& c = f.facets[of];
        return closest_on_facet(f.corners(), at(g.vertex), at(c[0]), at(c[1]), at(c[f.corners() - 1]));
      };
      double least = pair.distance * pair.distance;
      for (int i = g.first; i < g.last; ++i) {
        const double squared = closest(list.facets[i].facet).squared;
        if (squared <= pair.near * pair.near) near.push_back(list.facets[i].facet);
        least = std::min(least, squared);
      }
      // At a rim the sides of what lies below are as near as its top: of the facets that are as near the one that the vertex looks at.
      const double as_near = std::min(std::sqrt(least) + kAsNear * pair.distance, pair.distance);
      double facing = 0;
      for (int i = g.first; i < g.last; ++i) {
        const int of = list.facets[i].facet;
        const Closest q = closest(of);
        if (q.squared > as_near * as_near) continue;
        const auto& c = f.facets[of];
        const Node normal = f.facet_outward[of] * facet_normal(f.dimension, at(c[0]), at(c[1]), at(c[f.corners() - 1]));
        const double lengths = std::sqrt(normal.squaredNorm() * out[g.vertex].squaredNorm()), along = lengths > 0 ? -dot3(out[g.vertex], normal) / lengths : 0;
        const double across = f.rigid(c[0]) ? std::abs(along) : along;  // either side of a tool may be its outside
        if (facet >= 0 && (across < facing - kAsNear || (across < facing + kAsNear && q.squared >= nearest.squared))) continue;
        nearest = q;
        facet = of;
        facing = across;
      }
      if (facet < 0) continue;
      touches[g.vertex] = zone[g.vertex] = true;
      for (int other : near) {
        touching_facets.push_back(Features::key(g.vertex, other));
        for (int k = 0; k < f.corners(); ++k) zone[f.facets[other][k]] = true;
      }
      if (own == pair.second) {
        of_second.push_back(tie_to_facet(f, g.vertex, facet, nearest));
        continue;
      }
      tied[g.vertex] = true;
      const auto& c = f.facets[facet];
      ties.push_back(pair.second >= f.bodies
                         ? tie_to_tool(g.vertex, pair.second - f.bodies, facet_normal(f.dimension, at(c[0]), at(c[1]), at(c[f.corners() - 1])))
                         : tie_to_facet(f, g.vertex, facet, nearest));
    }
    for (const auto& p : list.planes) {
      if (f.vertex_surface[p.vertex] != pair.first || f.bodies + p.tool != pair.second) continue;
      if (std::abs(dot3(at(p.vertex) - planes[p.tool].point, planes[p.tool].normal)) > pair.distance) continue;
      zone[p.vertex] = true;
      ties.push_back(tie_to_tool(p.vertex, p.tool, planes[p.tool].normal));
    }
    if (ties.size() == before) refuse(setup, f, pair);
    // The rim: a facet of the first that reaches out of what is tied would turn into the second about its tied vertices.
    for (const Tie& tie : of_second)
      if (!std::all_of(tie.node + 1, tie.node + tie.nodes, [&](int v) { return tied[v]; })) rim.push_back(tie);
    for (const auto& e : list.edges) {
      const bool own = e.own == pair.first && e.surface == pair.second;
      if (!own && !(e.own == pair.second && e.surface == pair.first)) continue;
      const int* const p = f.edges[own ? e.first : e.second].node;
      const int* const q = f.edges[own ? e.second : e.first].node;
      const ClosestEdges c = closest_on_edges(at(p[0]), at(p[1]), at(q[0]), at(q[1]));
      const bool both = (touches[p[0]] || touches[p[1]]) && (touches[q[0]] || touches[q[1]]);
      const double near_by = both ? pair.near : pair.distance;
      if (c.squared > near_by * near_by) continue;
      touching_edges.push_back(Features::key(std::min(e.first, e.second), std::max(e.first, e.second)));
      for (int k = 0; k < 2; ++k) zone[p[k]] = zone[q[k]] = true;
      if ((tied[p[0]] && tied[p[1]]) || !c.crossing || c.squared > pair.distance * pair.distance) continue;
      const Vec3 along = vec3(at(p[1])) - vec3(at(p[0])), other = vec3(at(q[1])) - vec3(at(q[0]));
      const double lengths = along.norm() * other.norm();
      if (c.squared > kTouches * kTouches * lengths && along.cross(other).norm() < kAcross * lengths) continue;  // the frame of such a tie would turn by far more than its edges
      rim.push_back(tie_edges(p, q, c));
    }
    for (Tie& tie : those_with_a_vertex(f, ties, rim)) {
      if (pair.second >= f.bodies) tie.tool = pair.second - f.bodies;
      ties.push_back(tie);
    }
    f.relation(pair.first, pair.second).tie = f.relation(pair.second, pair.first).tie = static_cast<int>(f.tied_zones.size());
    f.tied_zones.push_back(std::move(zone));
  }
  std::sort(touching_facets.begin(), touching_facets.end());
  std::sort(touching_edges.begin(), touching_edges.end());
  f.touching_facets = std::move(touching_facets);
  f.touching_edges = std::move(touching_edges);
  return ties;
}

void keep_ties(const Features& f, const NodeField& x, const NodeField& place, const std::vector<ToolMotion>& motion, std::vector<Tie>& ties) {
  if (ties.empty()) return;
  const NodeField out = outwards(f, x);
  for (Tie& tie : ties) {
    // What is tied is pressed against its outward direction; what it is tied to has weights below 0.
    Vec3 inwards = Vec3::Zero();
    for (int k = 0; k < tie.nodes; ++k) inwards -= tie.weight[k] * vec3(out[tie.node[k]]);
    const auto face = [&](const Vec3& in_the_world) {
      if (tie.press.dot(in_the_world) < 0) tie.press = -tie.press;
    };
    const auto at = [&](int k) -> const Node& { return tie.node[k] < f.body_nodes ? x[tie.node[k]] : place[tie.node[k] - f.body_nodes]; };
    if (tie.to_tool()) {
      const Mat3 to_the_tool = motion[tie.tool].rotation0.transpose();
      tie.kept = to_the_tool * (vec3(at(0)) - motion[tie.tool].position0);
      face(inwards);
      tie.press = to_the_tool * tie.press;
      continue;
    }
    Node r = tie.weight[0] * at(0);
    for (int k = 1; k < tie.nodes; ++k) r += tie.weight[k] * at(k);
    const Mat3 frame = frame_of(tie, at);
    tie.kept = frame.transpose() * vec3(r);
    tie.press = Vec3::Unit(f.dimension - 1);  // across the features
    face(frame.transpose() * inwards);
  }
}

TiePair link_tie(const Tie& tie, int index, const int* entries) {
  TiePair pair;
  static_cast<Link&>(pair) = tie;
  pair.tie = index;
  pair.tool = tie.tool;
  pair.to_tool = tie.to_tool();
  if (pair.to_tool) {
    pair.nodes = 2;
    pair.weight[1] = -1;
  }
  std::copy(entries, entries + pair.nodes, pair.node);
  return pair;
}

namespace {
// Inverse of sum G P/m G^T over the directions that can move.
Mat3 mass_of(const Workspace& work, const TiePair& pair) {
  Mat3 w = Mat3::Zero();
  for (int k = 0; k < pair.nodes; ++k) {
    const int n = pair.node[k];
    Mat3 G = pair.weight[k] * Mat3::Identity();
    if (pair.apart) G += pair.turn[k];
    w += work.share[n].inverse_mass * (work.projector[n] ? Mat3(G * *work.projector[n] * G.transpose()) : Mat3(G * G.transpose()));
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(w);
  Mat3 mass = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    const double value = solver.eigenvalues()[k];
    if (value > 1e-12 * w.trace()) mass += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose() / value;
  }
  return mass;
}
}  // namespace

void prepare_tie(const Workspace& work, TiePair& pair) {
  pair.apart = false;
  pair.mass = pair.undamped = mass_of(work, pair);
}

std::vector<TiePair> take_out_doubled(const Workspace& work, const std::vector<bool>& told, std::vector<TiePair>& ties) {
  constexpr double kCounts = 1e-3;  // a weight: a node of less could follow only in leaps
  const auto counts = [](const TiePair& tie, int k) { return std::abs(tie.weight[k]) > kCounts; };
  std::vector<bool> follows(work.body_entries, false);
  for (const int i : work.fixed) follows[i] = true;
  follows.insert(follows.end(), told.begin(), told.end());
  std::vector<std::vector<int>> of_node(follows.size());  // ties that are kept
  const auto open = [&](const TiePair& tie, int& last) {  // of its nodes, so many do not follow; last: one of them
    int count = 0;
    for (int k = 0; k < tie.nodes; ++k)
      if (counts(tie, k) && !follows[tie.node[k]]) ++count, last = tie.node[k];
    return count;
  };
  // Those first that hold a vertex on a tool: others may be left out with less loss.
  std::vector<int> order(ties.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [&](int t) { return ties[t].to_tool; });
  std::vector<bool> doubled(ties.size(), false);
  std::vector<int> look;
  for (const int t : order) {
    int node = -1;
    if (open(ties[t], node) == 0) {
      doubled[t] = true;
      continue;
    }
    for (int k = 0; k < ties[t].nodes; ++k)
      if (counts(ties[t], k)) of_node[ties[t].node[k]].push_back(t);
    look.assign(1, t);
    while (!look.empty()) {  // what one of them fixes may fix the last node of others
      const int of = look.back();
      look.pop_back();
      if (open(ties[of], node) != 1) continue;
      follows[node] = true;
      look.insert(look.end(), of_node[node].begin(), of_node[node].end());
    }
  }
  std::vector<TiePair> kept, taken_out;
  for (std::size_t t = 0; t < ties.size(); ++t) (doubled[t] ? taken_out : kept).push_back(ties[t]);
  ties = std::move(kept);
  return taken_out;
}

void aim_tie(const Tie& tie, const Workspace& work, const std::vector<ToolMotion>& motion, TiePair& pair) {
  pair.impulse.setZero();
  pair.missing = -relative(static_cast<const Link&>(pair), work.x);
  if (pair.to_tool) {
    pair.press = node(motion[tie.tool].rotation0 * tie.press);
    return;
  }
  const auto at = [&](int k) -> const Node& { return work.x[pair.node[k]]; };
  const Mat3 frame = frame_of(tie, at);
  const Vec3 kept = frame * tie.kept;
  pair.missing += node(kept);
  pair.press = node(frame * tie.press);
  const int last = tie.nodes - 1;
  pair.apart = tie.kept.norm() > kTouches * (at(last) - at(last - 1)).norm();
  if (!pair.apart) return;
  pair.turn = turning(tie, frame, at);
  for (Mat3& turn : pair.turn) turn = Mat3(turn.colwise().cross(-kept));  // [kept]x of each column
  pair.mass = mass_of(work, pair);  // of the workspace's inertia
}

double sweep_tie(double dt, Workspace& work, TiePair& pair) {
  const Node before = relative(pair, work.v), change = pair.missing / dt - before;
  const Node impulse = node(pair.mass * vec3(change));
  pair.impulse += impulse;
  push(pair, impulse, work, work.v);
  return dt * vec3(Node(relative(pair, work.v) - before)).norm();  // what boundaries hold stays open; the fourth components hold masses
}

}  // namespace forming_sim
