#include "forming_sim/contact/flush.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/grid.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

constexpr double kMeet = 0.1;      ///< of the layer
constexpr double kBack = 1e-3;     ///< slope to which faces are back to back
constexpr double kGoesOn = 1e-4;   ///< slope to which one goes on in the other

/// The tools' facets where they stand at the start.
class Standing {
 public:
  Standing(double layer, const Features& f, const std::vector<int>& sides, const std::vector<ToolMotion>& motion) : f_(f), near_(kMeet * layer), step_(layer), grids_(motion.size()) {
    place_.resize(f.place.size());
    normal_.assign(f.facets.size(), Node::Zero());
    for (std::size_t t = 0; t < motion.size(); ++t) {
      const Features::Surface& s = f.surfaces[f.bodies + t];
      boxes_.emplace_back();
      if (!motion[t].present || !motion[t].is_told()) continue;
      for (const int v : s.vertices) {
        place_[v - f.body_nodes] = node(pose0(motion[t], vec3(f.place[v - f.body_nodes])));
        boxes_[t].add(at(v));
      }
      boxes_[t].grow(2 * layer);
      for (int i = s.first_facet; i < s.last_facet; ++i) normal_[i] = sides[i] * facet_normal(f.dimension, corner(i, 0), corner(i, 1), corner(i, f.corners() - 1));
    }
  }
  bool may_meet(int a, int b) const { return !boxes_[a].empty() && !boxes_[b].empty() && boxes_[a].overlaps(boxes_[b]); }
  const Box& box(int tool) const { return boxes_[tool]; }
  const Node& at(int vertex) const { return place_[vertex - f_.body_nodes]; }
  /// Outward; zero where the facet has no side.
  const Node& normal(int facet) const { return normal_[facet]; }
  bool has_side(int facet) const { return !normal_[facet].isZero(0); }
  bool back_to_back(int facet, int other) const { return has_side(facet) && has_side(other) && (normal_[facet] + normal_[other]).norm() < kBack; }

  /// Calls found(facet) for those of this tool that p touches.
  template <class Found> void touching(int tool, const Node& p, Found&& found) {
    near(tool, Box::of(p), [&](int i) {
      if (closest_on_facet(f_.corners(), p, corner(i, 0), corner(i, 1), corner(i, f_.corners() - 1)).squared <= near_ * near_) found(i);
    });
  }
  /// Whether the plane of the facet goes on in this tool, a layer beyond p outward.
  bool goes_on(int facet, const Node& p, const Node& outward, int tool) {
    bool does = false;
    touching(tool, p + step_ * outward, [&](int other) { does = does || is_level(facet, other); });
    return does;
  }
  /// In which part of the way from p to q it does so: from the first number to the second, which is no more than the first where it does so nowhere.
  std::pair<double, double> goes_on(int facet, const Node& p, const Node& q, const Node& outward, int tool) {
    const Node a = p + step_ * outward, b = q + step_ * outward;
    std::vector<std::pair<double, double>> parts;
    near(tool, Box::of(a, b), [&](int i) {
      if (is_level(facet, i) && std::abs(dot3(corner(i, 0) - a, normal_[facet])) <= near_) parts.push_back(part_over(i, a, b));
    });
    std::sort(parts.begin(), parts.end());
    std::pair<double, double> longest(0, 0), now(0, 0);
    const double slack = near_ / (b - a).norm();
    for (const auto& part : parts) {
      if (!(part.second > part.first)) continue;
      if (part.first > now.second + slack) now = part;
      else if (now.second <= now.first) now = part;
      else now.second = std::max(now.second, part.second);
      if (now.second - now.first > longest.second - longest.first) longest = now;
    }
    return longest;
  }

 private:
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
  template <class Found> void near(int tool, Box around, Found&& found) {
    const Features::Surface& s = f_.surfaces[f_.bodies + tool];
    if (!grids_[tool]) {
      std::vector<Box> boxes;
      double size = 0;
      for (int i = s.first_facet; i < s.last_facet; ++i) {
        boxes.push_back(Box::of(corner(i, 0), corner(i, 1), corner(i, f_.corners() - 1)));
        size += (boxes.back().high - boxes.back().low).norm() / (s.last_facet - s.first_facet);
      }
      grids_[tool].emplace(std::move(boxes), boxes_[tool], std::max(size, step_));
    }
    around.grow(near_);
    grids_[tool]->query(around, [&](int i) { found(s.first_facet + i); });
  }

  const Features& f_;
  double near_, step_;
  NodeField place_, normal_;  ///< of tool vertices; of facets
  std::vector<Box> boxes_;
  std::vector<std::optional<Grid>> grids_;
};

}  // namespace

Flush::Flush(double layer, const Features& f, const std::vector<int>& sides, const std::vector<ToolMotion>& at_start) : layer_(layer) {
  Standing standing(layer, f, sides, at_start);
  const int tools = static_cast<int>(at_start.size());
  for (int a = 0; a < tools; ++a)
    for (int b = a + 1; b < tools; ++b) {
      if (!standing.may_meet(a, b)) continue;
      const ToolMotion &A = at_start[a], &B = at_start[b];
      const double size = (standing.box(a).high - standing.box(a).low).norm() + (standing.box(b).high - standing.box(b).low).norm();
      pairs_.push_back({a, b, A.rotation0.transpose() * (B.position0 - A.position0), A.rotation0.transpose() * B.rotation0, size, true});
    }
  if (pairs_.empty()) return;
  std::vector<std::vector<int>> at_vertex(f.place.size());  // facets
  for (int i = 0; i < static_cast<int>(f.facets.size()); ++i)
    for (int k = 0; k < f.corners(); ++k)
      if (f.rigid(f.facets[i][k])) at_vertex[f.facets[i][k] - f.body_nodes].push_back(i);
  covered_.assign(f.facets.size(), 0);
  std::map<int, Joint> inside;                // by vertex: what the joints around it have to say
  std::map<int, std::pair<int, int>> around;  // by vertex: borders between what is covered and what is not, or of open surfaces; and how many of them are joints
  const auto other_of = [&](const Pair& pair, int tool) { return pair.first == tool ? pair.second : pair.second == tool ? pair.first : -1; };
  for (const Pair& pair : pairs_)
    for (const int own : {pair.first, pair.second})
      for (const int v : f.surfaces[f.bodies + own].vertices) {
        const int other = other_of(pair, own);
        if (!standing.box(other).holds(standing.at(v))) continue;
        standing.touching(other, standing.at(v), [&](int facet) {
          for (const int i : at_vertex[v - f.body_nodes])
            if (standing.back_to_back(i, facet)) covered_[i] = covered_[facet] = 1;
        });
      }
  /// A border at this vertex; a joint where there is a pair of tools that makes it one.
  const auto see = [&](int vertex, int pair, const Node& way) {
    auto& [borders, joints] = around[vertex];
    ++borders;
    if (pair < 0) return;
    ++joints;
    Joint& joint = inside[vertex];
    joint.feature = vertex;
    joint.way += way;
    if (std::find(joint.pairs.begin(), joint.pairs.end(), pair) == joint.pairs.end()) joint.pairs.push_back(pair);
  };
  const auto in_frame = [&](int tool, const Node& n) { return node(at_start[tool].rotation0.transpose() * vec3(n)); };
  for (int t = 0; t < tools; ++t) {
    const Features::Surface& s = f.surfaces[f.bodies + t];
    std::vector<int> pairs;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      if (other_of(pairs_[k], t) >= 0) pairs.push_back(static_cast<int>(k));
    if (pairs.empty()) continue;
    if (f.dimension == 2)
      for (const int v : s.vertices) {
        const std::vector<int>& facets = at_vertex[v - f.body_nodes];
        for (const int top : facets) {
          const bool ends = facets.size() == 1 || (facets.size() == 2 && covered_[facets[0] == top ? facets[1] : facets[0]]);
          if (!ends || covered_[top] || !standing.has_side(top)) continue;
          const Node along = standing.at(v) - standing.at(f.facets[top][0] == v ? f.facets[top][1] : f.facets[top][0]), outward = along / along.norm();
          int joined = -1;
          for (const int k : pairs)
            if (joined < 0 && standing.goes_on(top, standing.at(v), outward, other_of(pairs_[k], t))) joined = k;
          see(v, joined, in_frame(t, outward));
        }
      }
    for (int e = s.first_edge; e < s.last_edge; ++e) {
      const Features::Edge& edge = f.edges[e];
      const Node &p = standing.at(edge.node[0]), &q = standing.at(edge.node[1]);
      for (int k = 0; k < std::min(2, edge.facets); ++k) {
        const int top = edge.facet[k];
        const bool ends = edge.facets == 1 || (edge.facets == 2 && covered_[edge.facet[1 - k]]);
        if (!ends || covered_[top] || !standing.has_side(top) || p == q) continue;
        const Node along = (q - p) / (q - p).norm(), way = p - standing.at(edge.opposite[k]), across = way - dot3(way, along) * along, outward = across / across.norm();
        Joint joint;
        joint.feature = e;
        joint.way = in_frame(t, outward);
        joint.last = 0;
        for (const int pair : pairs) {
          const auto [first, last] = standing.goes_on(top, p, q, outward, other_of(pairs_[pair], t));
          if (last - first <= joint.last - joint.first) continue;
          joint.first = first, joint.last = last;
          joint.pairs = {pair};
        }
        const double slack = 2 * layer / (q - p).norm();
        if (joint.first < slack) joint.first = 0;
        if (joint.last > 1 - slack) joint.last = 1;
        const int pair = joint.last > joint.first ? joint.pairs[0] : -1;
        see(edge.node[0], joint.first == 0 ? pair : -1, joint.way);
        see(edge.node[1], joint.last == 1 ? pair : -1, joint.way);
        if (pair >= 0) edges_.push_back(joint);
      }
    }
  }
  // Inside of a joint whatever ends at the vertex goes on in other tools.
  for (auto& [vertex, joint] : inside) {
    const auto [borders, joints] = around[vertex];
    if (joints != borders || joints < f.dimension - 1) continue;
    joint.way /= joint.way.norm();
    vertices_.push_back(joint);
  }
  if (!any()) covered_.clear();
}

std::vector<int> Flush::together(int t) const {
  std::vector<int> all{t};
  const auto join = [&](const std::vector<Joint>& joints) {
    for (const Joint& joint : joints)
      for (const int pair : joint.pairs)
        for (const auto& [one, other] : {std::pair(pairs_[pair].first, pairs_[pair].second), std::pair(pairs_[pair].second, pairs_[pair].first)})
          if (std::find(all.begin(), all.end(), one) != all.end() && std::find(all.begin(), all.end(), other) == all.end()) all.push_back(other);
  };
  for (std::size_t before = 0; before != all.size();) {
    before = all.size();
    join(edges_);
    join(vertices_);
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool Flush::stand(const Pair& pair, const ToolMotion& a, const ToolMotion& b, bool at_end) const {
  constexpr double kMoved = 1e-2;  // of the layer
  const Mat3 &A = at_end ? a.rotation1 : a.rotation0, &B = at_end ? b.rotation1 : b.rotation0;
  const Vec3 way = A.transpose() * (at_end ? b.position1 - a.position1 : b.position0 - a.position0) - pair.apart;
  return way.norm() + (A.transpose() * B - pair.turned).norm() * pair.size < kMoved * layer_;
}

bool Flush::mark(const std::vector<ToolMotion>& motion, Features& f) {
  if (!any()) return false;
  bool changed = f.joint_vertex.empty();
  for (Pair& pair : pairs_) {
    const ToolMotion &a = motion[pair.first], &b = motion[pair.second];
    const bool stands = a.present && b.present && stand(pair, a, b, false) && stand(pair, a, b, true);
    changed = changed || stands != pair.stands;
    pair.stands = stands;
  }
  const auto is_one = [&](const Joint& joint) { return std::all_of(joint.pairs.begin(), joint.pairs.end(), [&](int pair) { return pairs_[pair].stands; }); };
  const auto way_of = [&](const Joint& joint, int surface) { return is_one(joint) ? node(motion[surface - f.bodies].rotation0 * vec3(joint.way)) : Node(Node::Zero()); };
  if (f.joint_vertex.empty()) f.joint_vertex.assign(f.place.size(), Node::Zero());
  for (const Joint& joint : edges_) {
    Features::Edge& edge = f.edges[joint.feature];
    edge.joint = way_of(joint, edge.surface);
    edge.joint_first = joint.first, edge.joint_last = joint.last;
    edge.level = is_one(joint) && joint.first == 0 && joint.last == 1;
  }
  for (const Joint& joint : vertices_) {
    const int place = joint.feature - f.body_nodes;
    f.joint_vertex[place] = way_of(joint, f.vertex_surface[joint.feature]);
    f.level_vertex[place] = is_one(joint);
  }
  return changed;
}

}  // namespace forming_sim
