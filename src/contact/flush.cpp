#include "forming_sim/contact/flush.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "forming_sim/contact/facet_grid.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

constexpr double kMeet = 0.1;      ///< of the layer
constexpr double kBeyond = 2;      ///< layers: so far beyond the plane of a face there is a body
constexpr double kBack = 1e-3;     ///< slope to which faces are back to back
constexpr double kGoesOn = 1e-4;   ///< slope to which one goes on in the other
constexpr double kMoved = 1e-2;    ///< of the layer
constexpr double kTogether = 1e-9; ///< of an edge: parts of it that meet

}  // namespace

/// The tools' facets where they stand at the start.
class Flush::Standing {
 public:
  Standing(double layer, const Features& f, const std::vector<int>& sides, const NodeField& x, const std::vector<ToolMotion>& motion) : f_(f), motion_(motion), near_(kMeet * layer), layer_(layer), tools_(motion.size()) {
    for (int b = 0; b < f.bodies; ++b)
      for (const int v : f.surfaces[b].vertices) bodies_.add(x[v]);
    place_.resize(f.place.size());
    normal_.assign(f.facets.size(), Node::Zero());
    for (std::size_t t = 0; t < motion.size(); ++t) {
      const Features::Surface& s = f.surfaces[f.bodies + t];
      if (!motion[t].present || !motion[t].is_told()) continue;
      for (const int v : s.vertices) {
        place_[v - f.body_nodes] = node(pose0(motion[t], vec3(f.place[v - f.body_nodes])));
        tools_[t].box.add(at(v));
      }
      tools_[t].box.grow(2 * layer);
      for (int i = s.first_facet; i < s.last_facet; ++i) normal_[i] = sides[i] * facet_normal(f.dimension, corner(i, 0), corner(i, 1), corner(i, f.corners() - 1));
    }
  }
  double layer() const { return layer_; }
  bool may_meet(int a, int b) const { return !box(a).empty() && !box(b).empty() && box(a).overlaps(box(b)); }
  const Box& box(int tool) const { return tools_[tool].box; }
  double size(int tool) const { return (box(tool).high - box(tool).low).norm(); }
  const Node& at(int vertex) const { return place_[vertex - f_.body_nodes]; }
  /// Outward; zero where the facet has no side.
  const Node& normal(int facet) const { return normal_[facet]; }
  bool has_side(int facet) const { return !normal_[facet].isZero(0); }
  Node in_frame(int tool, const Node& n) const { return node(motion_[tool].rotation0.transpose() * vec3(n)); }
  Node from_frame(int tool, const Node& n) const { return node(motion_[tool].rotation0 * vec3(n)); }
  /// There is a body on the outward side of its plane.
  bool is_seen(int facet) const {
    if (!has_side(facet) || bodies_.empty()) return false;
    double farthest = -1;
    for (int i = 0; i < 8; ++i) farthest = std::max(farthest, dot3(node(bodies_.corner(i)) - corner(facet, 0), normal_[facet]));
    return farthest > kBeyond * layer_;
  }
  bool are_parallel(int facet, int other) const { return (normal_[facet] - normal_[other]).norm() < kBack; }
  /// At p one of these tools lies on the facet, back to back.
  bool is_covered(int facet, const Node& p, const std::vector<int>& tools) {
    bool is = false;
    for (const int tool : tools)
      if (box(tool).holds(p)) touching(tool, p, [&](int other, double) { is = is || (has_side(other) && (normal_[facet] + normal_[other]).norm() < kBack); });
    return is;
  }
  /// Distance of p from this tool; above a tenth of a layer: the largest double.
  double gap(int tool, const Node& p) {
    double least = std::numeric_limits<double>::max();
    touching(tool, p, [&](int, double distance) { least = std::min(least, distance); });
    return least;
  }
  /// Whether the plane of the facet goes on in this tool, a layer beyond p outward.
  bool goes_on(int facet, const Node& p, const Node& outward, int tool) {
    bool does = false;
    touching(tool, p + layer_ * outward, [&](int other, double) { does = does || is_level(facet, other); });
    return does;
  }
  /// In which part of the way from p to q it does so: from the first number to the second, which is no more than the first where it does so nowhere.
  std::pair<double, double> goes_on(int facet, const Node& p, const Node& q, const Node& outward, int tool) {
    const Node a = p + layer_ * outward, b = q + layer_ * outward;
    std::vector<std::pair<double, double>> parts;
    near(tool, Box::of(a, b), [&](int i) {
      if (is_level(facet, i) && std::abs(dot3(corner(i, 0) - a, normal_[facet])) <= near_) parts.push_back(part_over(i, a, b));
    });
    std::sort(parts.begin(), parts.end());
    std::pair<double, double> longest(0, 0), now(0, 0);
    const double slack = near_ / (b - a).norm();
    for (const auto& part : parts) {
      if (!(part.second > part.first)) continue;
      if (part.first > now.second + slack || now.second <= now.first) now = part;
      else now.second = std::max(now.second, part.second);
      if (now.second - now.first > longest.second - longest.first) longest = now;
    }
    return longest;
  }

 private:
  struct Tool {
    Box box;                                 ///< two layers around it; empty: it has no joints
    std::vector<std::array<int, 3>> facets;  ///< by place_, a segment repeats its second; found when it is first asked
    std::optional<FacetGrid> grid;
  };
  const Node& corner(int facet, int k) const { return at(f_.facets[facet][k]); }
  bool is_level(int facet, int other) const { return (normal_[facet] - normal_[other]).norm() < kGoesOn; }
  /// Of the way from a to b, which lies in the triangle's plane.
  std::pair<double, double> part_over(int facet, const Node& a, const Node& b) const {
    const Node n = facet_normal(3, corner(facet, 0), corner(facet, 1), corner(facet, 2));
    double first = 0, last = 1;
    for (int k = 0; k < 3; ++k) {
      const Node side = corner(facet, (k + 1) % 3) - corner(facet, k), inward = cross3(n, side) / side.norm();
      const double at_a = dot3(a - corner(facet, k), inward) + near_, at_b = dot3(b - corner(facet, k), inward) + near_;
      if (at_a < 0 && at_b < 0) return {0, 0};
      if (at_a < 0) first = std::max(first, at_a / (at_a - at_b));
      if (at_b < 0) last = std::min(last, at_a / (at_a - at_b));
    }
    return {first, last};
  }
  const FacetGrid& grid(int t) {
    Tool& tool = tools_[t];
    if (!tool.grid) {
      const Features::Surface& s = f_.surfaces[f_.bodies + t];
      for (int i = s.first_facet; i < s.last_facet; ++i) {
        std::array<int, 3> places;
        for (int k = 0; k < 3; ++k) places[k] = f_.facets[i][std::min(k, f_.corners() - 1)] - f_.body_nodes;
        tool.facets.push_back(places);
      }
      tool.grid.emplace(f_.corners(), tool.facets, place_);
    }
    return *tool.grid;
  }
  /// Calls found(facet) for those of this tool whose boxes come near to this one.
  template <class Found> void near(int tool, Box around, Found&& found) {
    around.grow(near_);
    grid(tool).query(around, [&](int i) { found(f_.surfaces[f_.bodies + tool].first_facet + i); });
  }
  /// Calls found(facet, distance) for those of this tool that p touches.
  template <class Found> void touching(int tool, const Node& p, Found&& found) {
    near(tool, Box::of(p), [&](int facet) {
      const double squared = grid(tool).closest(p, facet - f_.surfaces[f_.bodies + tool].first_facet).squared;
      if (squared <= near_ * near_) found(facet, std::sqrt(squared));
    });
  }

  const Features& f_;
  const std::vector<ToolMotion>& motion_;
  double near_, layer_;
  NodeField place_, normal_;  ///< of tool vertices; of facets
  std::vector<Tool> tools_;
  Box bodies_;
};

Flush::Flush(double layer, const Features& f, const std::vector<int>& sides, const NodeField& x, const std::vector<ToolMotion>& at_start) : layer_(layer) {
  Standing standing(layer, f, sides, x, at_start);
  find_pairs(f, at_start, standing);
  for (int t = 0; t < static_cast<int>(at_start.size()); ++t) {
    Beside beside{t, {}, {}};
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      if (pairs_[k].has(t)) beside.pairs.push_back(static_cast<int>(k)), beside.tools.push_back(pairs_[k].other(t));
    if (beside.pairs.empty()) continue;
    if (f.dimension == 2) join_section(f, beside, standing);
    else join_edges(f, beside, standing);
  }
  std::sort(facing_.begin(), facing_.end());
  facing_.erase(std::unique(facing_.begin(), facing_.end()), facing_.end());
}

void Flush::find_pairs(const Features& f, const std::vector<ToolMotion>& at_start, const Standing& standing) {
  const auto meet_the_same = [&](int a, int b) {
    for (int body = 0; body < f.bodies; ++body) {
      const Features::Relation &one = f.relation(body, f.bodies + a), &other = f.relation(body, f.bodies + b);
      if (one.meet != other.meet || one.tie >= 0 || other.tie >= 0) return false;
    }
    return true;
  };
  const int tools = static_cast<int>(at_start.size());
  for (int a = 0; a < tools; ++a)
    for (int b = a + 1; b < tools; ++b) {
      if (!standing.may_meet(a, b) || !meet_the_same(a, b)) continue;
      const ToolMotion &A = at_start[a], &B = at_start[b];
      pairs_.push_back({a, b, A.rotation0.transpose() * (B.position0 - A.position0), A.rotation0.transpose() * B.rotation0, standing.size(a) + standing.size(b), true});
    }
}

void Flush::join_section(const Features& f, const Beside& beside, Standing& standing) {
  const Features::Surface& s = f.surfaces[f.bodies + beside.tool];
  std::map<int, std::vector<int>> at_vertex;
  for (int i = s.first_facet; i < s.last_facet; ++i)
    for (int k = 0; k < 2; ++k) at_vertex[f.facets[i][k]].push_back(i);
  for (const auto& [v, facets] : at_vertex)
    for (const int top : facets) {
      const Node& p = standing.at(v);
      const Node along = p - standing.at(f.facets[top][0] == v ? f.facets[top][1] : f.facets[top][0]), outward = along / along.norm();
      if (!standing.is_seen(top) || standing.is_covered(top, p - layer_ * outward, beside.tools)) continue;
      for (std::size_t k = 0; k < beside.pairs.size(); ++k) {
        const double gap = standing.gap(beside.tools[k], p);
        if (gap > layer_ || !standing.goes_on(top, p, outward, beside.tools[k])) continue;
        Joint joint;
        joint.feature = v, joint.pairs = {beside.pairs[k]}, joint.way = standing.in_frame(beside.tool, outward), joint.gap = gap, joint.level = true;
        vertices_.push_back(joint);
        for (const int back : facets)
          if (back != top) facing_.push_back({back, v});
        break;
      }
    }
}

void Flush::join_edges(const Features& f, const Beside& beside, Standing& standing) {
  const Features::Surface& s = f.surfaces[f.bodies + beside.tool];
  std::map<int, Around> around;  // by vertex, where joints come to it
  for (int e = s.first_edge; e < s.last_edge; ++e) {
    const Features::Edge& edge = f.edges[e];
    const Node &p = standing.at(edge.node[0]), &q = standing.at(edge.node[1]);
    Box box = Box::of(p, q);
    box.grow(2 * layer_);
    if (edge.facets > 2 || p == q || std::none_of(beside.tools.begin(), beside.tools.end(), [&](int other) { return standing.box(other).overlaps(box); })) continue;
    if (edge.facets == 2 && standing.are_parallel(edge.facet[0], edge.facet[1])) continue;
    const double length = (q - p).norm(), slack = 2 * layer_ / length;
    const Node along = (q - p) / length;
    for (int k = 0; k < edge.facets; ++k) {
      const int top = edge.facet[k];
      if (!standing.is_seen(top)) continue;
      const Node way = p - standing.at(edge.opposite[k]), across = way - dot3(way, along) * along, outward = across / across.norm();
      for (std::size_t j = 0; j < beside.pairs.size(); ++j) {
        const auto [first, last] = standing.goes_on(top, p, q, outward, beside.tools[j]);
        if (!(last - first > std::min(slack, 0.5))) continue;
        const auto point = [&, from = first, to = last](double part) { return Node(p + (from + part * (to - from)) * (q - p)); };
        Joint joint;
        joint.feature = e, joint.pairs = {beside.pairs[j]}, joint.way = standing.in_frame(beside.tool, outward);
        joint.first = first < slack ? 0 : first, joint.last = last > 1 - slack ? 1 : last;
        for (const double part : {0.05, 0.5, 0.95}) joint.gap = std::max(joint.gap, standing.gap(beside.tools[j], point(part)));
        if (joint.gap > layer_ || standing.is_covered(top, point(0.5) - layer_ * outward, beside.tools)) continue;
        for (const int v : edge.node) around[v].joints.push_back(edges_.size());
        edges_.push_back(joint);
      }
    }
  }
  if (around.empty()) return;
  for (int e = s.first_edge; e < s.last_edge; ++e)
    for (const int v : f.edges[e].node)
      if (const auto found = around.find(v); found != around.end()) found->second.edges.push_back(e);
  for (const auto& [v, there] : around) {
    hold_faces(f, beside, v, there, standing);
    std::optional<Joint> joint = joint_all_around(f, beside, v, there, standing);
    if (!joint) joint = joint_at_corner(f, beside, v, there, standing);
    const double length = joint ? joint->way.norm() : 0;
    if (!(length > kBack)) continue;  // none, or ways that go against each other
    joint->way /= length;
    vertices_.push_back(*joint);
  }
}

/// The joint comes as far as that end of its edge.
bool Flush::reaches(const Features& f, const Joint& joint, int vertex) { return f.edges[joint.feature].node[0] == vertex ? joint.first == 0 : joint.last == 1; }

// Faces that look over a joint are not set back at its ends.
void Flush::hold_faces(const Features& f, const Beside& beside, int vertex, const Around& there, const Standing& standing) {
  for (const int e : there.edges)
    for (int k = 0; k < std::min(2, f.edges[e].facets); ++k) {
      const int facet = f.edges[e].facet[k];
      for (const std::size_t j : there.joints)
        if (standing.has_side(facet) && dot3(standing.normal(facet), standing.from_frame(beside.tool, edges_[j].way)) > 0.5) facing_.push_back({facet, vertex});
    }
}

// What ends at the vertex, at edges between a face that bodies see and one that is covered or is none, goes on in other tools everywhere.
std::optional<Flush::Joint> Flush::joint_all_around(const Features& f, const Beside& beside, int vertex, const Around& there, Standing& standing) const {
  Joint joint;
  joint.feature = vertex;
  int joined = 0;
  std::vector<int> seen;  // faces that end there
  for (const int e : there.edges) {
    const Features::Edge& edge = f.edges[e];
    const Node along = standing.at(edge.node[edge.node[0] == vertex ? 1 : 0]) - standing.at(vertex), inside = standing.at(vertex) + std::min(0.5, 2 * layer_ / along.norm()) * along;
    int open = 0;  // faces at the edge that are seen
    for (int k = 0; k < std::min(2, edge.facets); ++k) {
      const Node way = standing.at(edge.opposite[k]) - inside;
      if (!standing.is_seen(edge.facet[k]) || standing.is_covered(edge.facet[k], inside + layer_ / way.norm() * way, beside.tools)) continue;
      seen.push_back(edge.facet[k]);
      ++open;
    }
    if (open != 1) continue;  // a ridge, or inside of what is covered or level
    const auto found = std::find_if(there.joints.begin(), there.joints.end(), [&](std::size_t j) { return edges_[j].feature == e && reaches(f, edges_[j], vertex); });
    if (found == there.joints.end()) return std::nullopt;
    ++joined;
    joint.way += edges_[*found].way;
    joint.gap = std::max(joint.gap, edges_[*found].gap);
    joint.pairs.push_back(edges_[*found].pairs[0]);
  }
  if (joined < 2) return std::nullopt;
  const Node out = standing.from_frame(beside.tool, joint.way);
  joint.level = std::all_of(seen.begin(), seen.end(), [&](int facet) { return std::abs(dot3(standing.normal(facet), out)) < kBack * out.norm(); });
  return joint;
}

// A corner of the smaller of two: all of the way over it is the other's face.
std::optional<Flush::Joint> Flush::joint_at_corner(const Features& f, const Beside& beside, int vertex, const Around& there, Standing& standing) const {
  std::optional<Joint> found;
  for (const std::size_t j : there.joints) {
    if (!reaches(f, edges_[j], vertex)) continue;
    const Features::Edge& edge = f.edges[edges_[j].feature];
    const Node out = standing.from_frame(beside.tool, edges_[j].way), along = standing.at(edge.node[1]) - standing.at(edge.node[0]), beyond = layer_ / along.norm() * along;
    const int other = pairs_[edges_[j].pairs[0]].other(beside.tool);
    for (int k = 0; k < std::min(2, edge.facets); ++k)
      if (standing.is_seen(edge.facet[k]) && std::abs(dot3(standing.normal(edge.facet[k]), out)) < kBack &&
          standing.goes_on(edge.facet[k], standing.at(vertex) + beyond, out, other) && standing.goes_on(edge.facet[k], standing.at(vertex) - beyond, out, other))
        found = edges_[j];
  }
  if (found) found->feature = vertex, found->first = 0, found->last = 1;
  return found;
}

bool Flush::faces_joint(int facet, int vertex) const { return std::binary_search(facing_.begin(), facing_.end(), std::pair(facet, vertex)); }

std::vector<int> Flush::together(int t) const {
  std::vector<int> all{t};
  const auto holds = [&](int tool) { return std::find(all.begin(), all.end(), tool) != all.end(); };
  for (std::size_t before = 0; before != all.size();) {
    before = all.size();
    for (const std::vector<Joint>* joints : {&edges_, &vertices_})
      for (const Joint& joint : *joints)
        for (const int k : joint.pairs) {
          const Pair& pair = pairs_[k];
          if (holds(pair.first) != holds(pair.second)) all.push_back(holds(pair.first) ? pair.second : pair.first);
        }
  }
  std::sort(all.begin(), all.end());
  return all;
}

void Flush::part(const std::vector<int>& tools) {
  const auto is_of = [&](const Joint& joint) {
    return std::any_of(joint.pairs.begin(), joint.pairs.end(), [&](int k) {
      return std::any_of(tools.begin(), tools.end(), [&](int tool) { return pairs_[k].has(tool); });
    });
  };
  for (std::vector<Joint>* joints : {&edges_, &vertices_}) joints->erase(std::remove_if(joints->begin(), joints->end(), is_of), joints->end());
}

bool Flush::stand(const Pair& pair, const ToolMotion& a, const ToolMotion& b, bool at_end) const {
  const Mat3 &A = at_end ? a.rotation1 : a.rotation0, &B = at_end ? b.rotation1 : b.rotation0;
  const Vec3 way = A.transpose() * (at_end ? b.position1 - a.position1 : b.position0 - a.position0) - pair.apart;
  return way.norm() + (A.transpose() * B - pair.turned).norm() * pair.size < kMoved * layer_;
}

bool Flush::is_one(const Joint& joint) const {
  return std::all_of(joint.pairs.begin(), joint.pairs.end(), [&](int pair) { return pairs_[pair].stands; });
}

/// So far over it a vertex has left the slit that may be there.
double Flush::slack(const Joint& joint) const { return joint.gap + 2 * kMoved * layer_; }

bool Flush::mark(const std::vector<ToolMotion>& motion, Features& f) {
  if (!any()) return false;
  bool changed = !marked_, turned = false;
  for (Pair& pair : pairs_) {
    const ToolMotion &a = motion[pair.first], &b = motion[pair.second];
    const bool stands = a.present && b.present && a.is_told() && b.is_told() && stand(pair, a, b, false) && stand(pair, a, b, true);
    changed = changed || stands != pair.stands;
    pair.stands = stands;
    turned = turned || a.rotation0 != a.rotation1 || b.rotation0 != b.rotation1;
  }
  if (!changed && !turned && !turned_) return false;
  turned_ = turned;
  marked_ = true;
  const auto way_of = [&](const Joint& joint, int surface) { return node(motion[surface - f.bodies].rotation0 * vec3(joint.way)); };
  f.joint_parts.clear();
  for (std::size_t i = 0; i < edges_.size();) {
    Features::Edge& edge = f.edges[edges_[i].feature];
    edge.first_joint = static_cast<int>(f.joint_parts.size());
    double covered = 0;  // from the beginning on
    std::size_t end = i;
    for (; end < edges_.size() && edges_[end].feature == edges_[i].feature; ++end) {
      if (!is_one(edges_[end])) continue;
      f.joint_parts.push_back({way_of(edges_[end], edge.surface), slack(edges_[end]), edges_[end].first, edges_[end].last});
    }
    for (bool more = true; more;) {
      more = false;
      for (std::size_t j = i; j < end; ++j)
        if (is_one(edges_[j]) && edges_[j].first <= covered + kTogether && edges_[j].last > covered) covered = edges_[j].last, more = true;
    }
    edge.joints = static_cast<int>(f.joint_parts.size()) - edge.first_joint;
    edge.level = covered >= 1;
    i = end;
  }
  f.joint_vertex.assign(f.place.size(), Features::kNoJoint);
  for (const Joint& joint : vertices_) {
    const int place = joint.feature - f.body_nodes;
    f.level_vertex[place] = is_one(joint) && joint.level;
    f.joint_vertex[place] = Features::kOpenJoint;
    if (!is_one(joint)) continue;
    f.joint_vertex[place] = static_cast<int>(f.joint_parts.size());
    f.joint_parts.push_back({way_of(joint, f.vertex_surface[joint.feature]), slack(joint), 0, 1});
  }
  return changed;
}

}  // namespace forming_sim
