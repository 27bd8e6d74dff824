#include "forming_sim/contact/flush.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/grid.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

constexpr double kMeet = 0.1;      ///< of the layer
constexpr double kBeyond = 2;      ///< layers: so far beyond the plane of a face there is a body
constexpr double kBack = 1e-3;     ///< slope to which faces are back to back
constexpr double kGoesOn = 1e-4;   ///< slope to which one goes on in the other
constexpr double kMoved = 1e-2;    ///< of the layer
constexpr double kTogether = 1e-9; ///< of an edge: parts of it that meet

/// The tools' facets where they stand at the start.
class Standing {
 public:
  Standing(double layer, const Features& f, const std::vector<int>& sides, const NodeField& x, const std::vector<ToolMotion>& motion) : f_(f), near_(kMeet * layer), step_(layer), grids_(motion.size()) {
    for (int b = 0; b < f.bodies; ++b)
      for (const int v : f.surfaces[b].vertices) bodies_.add(x[v]);
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
  /// There is a body on the outward side of its plane.
  bool is_seen(int facet) const {
    if (!has_side(facet) || bodies_.empty()) return false;
    double farthest = -1;
    for (int i = 0; i < 8; ++i) farthest = std::max(farthest, dot3(node(bodies_.corner(i)) - corner(facet, 0), normal_[facet]));
    return farthest > kBeyond * step_;
  }
  bool are_parallel(int facet, int other) const { return (normal_[facet] - normal_[other]).norm() < kBack; }
  /// At p another tool lies on the facet, back to back.
  bool is_covered(int facet, const Node& p, const std::vector<int>& tools) {
    bool is = false;
    for (const int tool : tools)
      if (box(tool).holds(p)) touching(tool, p, [&](int other) { is = is || (has_side(other) && (normal_[facet] + normal_[other]).norm() < kBack); });
    return is;
  }
  /// Distance of p from this tool; above a tenth of a layer: the largest double.
  double gap(int tool, const Node& p) {
    double least = std::numeric_limits<double>::max();
    near(tool, Box::of(p), [&](int i) {
      const double squared = closest_on_facet(f_.corners(), p, corner(i, 0), corner(i, 1), corner(i, f_.corners() - 1)).squared;
      if (squared <= near_ * near_) least = std::min(least, std::sqrt(squared));
    });
    return least;
  }

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
  Box bodies_;
  std::vector<std::optional<Grid>> grids_;
};

}  // namespace

Flush::Flush(double layer, const Features& f, const std::vector<int>& sides, const NodeField& x, const std::vector<ToolMotion>& at_start) : layer_(layer) {
  Standing standing(layer, f, sides, x, at_start);
  const int tools = static_cast<int>(at_start.size());
  const auto alike = [&](int a, int b) {
    for (int body = 0; body < f.bodies; ++body) {
      const Features::Relation &one = f.relation(body, f.bodies + a), &other = f.relation(body, f.bodies + b);
      if (one.meet != other.meet || one.tie >= 0 || other.tie >= 0) return false;
    }
    return true;
  };
  for (int a = 0; a < tools; ++a)
    for (int b = a + 1; b < tools; ++b) {
      if (!standing.may_meet(a, b) || !alike(a, b)) continue;
      const ToolMotion &A = at_start[a], &B = at_start[b];
      const double size = (standing.box(a).high - standing.box(a).low).norm() + (standing.box(b).high - standing.box(b).low).norm();
      pairs_.push_back({a, b, A.rotation0.transpose() * (B.position0 - A.position0), A.rotation0.transpose() * B.rotation0, size, true});
    }
  for (int t = 0; t < tools; ++t) {
    std::vector<int> pairs, others;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      for (const auto& [own, other] : {std::pair(pairs_[k].first, pairs_[k].second), std::pair(pairs_[k].second, pairs_[k].first)})
        if (own == t) pairs.push_back(static_cast<int>(k)), others.push_back(other);
    if (pairs.empty()) continue;
    const auto in_frame = [&](const Node& n) { return node(at_start[t].rotation0.transpose() * vec3(n)); };
    const Features::Surface& s = f.surfaces[f.bodies + t];
    if (f.dimension == 2) {
      std::map<int, std::vector<int>> at_vertex;
      for (int i = s.first_facet; i < s.last_facet; ++i)
        for (int k = 0; k < 2; ++k) at_vertex[f.facets[i][k]].push_back(i);
      for (const auto& [v, facets] : at_vertex)
        for (const int top : facets) {
          const Node& p = standing.at(v);
          const Node along = p - standing.at(f.facets[top][0] == v ? f.facets[top][1] : f.facets[top][0]), outward = along / along.norm();
          if (!standing.is_seen(top) || standing.is_covered(top, p - layer * outward, others)) continue;
          for (std::size_t k = 0; k < pairs.size(); ++k) {
            const double gap = standing.gap(others[k], p);
            if (gap > layer || !standing.goes_on(top, p, outward, others[k])) continue;
            Joint joint;
            joint.feature = v, joint.pairs = {pairs[k]}, joint.way = in_frame(outward), joint.gap = gap, joint.level = true;
            vertices_.push_back(joint);
            for (const int back : facets)
              if (back != top) facing_.push_back({back, v});
            break;
          }
        }
      continue;
    }
    std::map<int, std::vector<std::size_t>> joints_at;  // by vertex, which of edges_ come to it
    for (int e = s.first_edge; e < s.last_edge; ++e) {
      const Features::Edge& edge = f.edges[e];
      const Node &p = standing.at(edge.node[0]), &q = standing.at(edge.node[1]);
      Box around = Box::of(p, q);
      around.grow(2 * layer);
      if (edge.facets > 2 || p == q || std::none_of(others.begin(), others.end(), [&](int other) { return standing.box(other).overlaps(around); })) continue;
      if (edge.facets == 2 && standing.are_parallel(edge.facet[0], edge.facet[1])) continue;
      for (int k = 0; k < edge.facets; ++k) {
        const int top = edge.facet[k];
        if (!standing.is_seen(top)) continue;
        const Node along = (q - p) / (q - p).norm(), way = p - standing.at(edge.opposite[k]), across = way - dot3(way, along) * along, outward = across / across.norm();
        for (std::size_t j = 0; j < pairs.size(); ++j) {
          const auto [first, last] = standing.goes_on(top, p, q, outward, others[j]);
          const double slack = 2 * layer / (q - p).norm();
          Joint joint;
          joint.first = first < slack ? 0 : first, joint.last = last > 1 - slack ? 1 : last;
          if (!(last - first > std::min(slack, 0.5))) continue;
          for (const double part : {0.05, 0.5, 0.95}) joint.gap = std::max(joint.gap, standing.gap(others[j], p + (first + part * (last - first)) * (q - p)));
          if (joint.gap > layer || standing.is_covered(top, p + 0.5 * (first + last) * (q - p) - layer * outward, others)) continue;
          joint.feature = e, joint.pairs = {pairs[j]}, joint.way = in_frame(outward);
          for (const int end : {0, 1}) joints_at[edge.node[end]].push_back(edges_.size());
          edges_.push_back(joint);
        }
      }
    }
    if (joints_at.empty()) continue;
    std::map<int, std::vector<int>> edges_at;
    for (int e = s.first_edge; e < s.last_edge; ++e)
      for (const int v : f.edges[e].node)
        if (joints_at.count(v) > 0) edges_at[v].push_back(e);
    for (const auto& [v, those] : joints_at) {
      // Faces there that look over a joint are not set back.
      for (const int e : edges_at[v])
        for (int k = 0; k < std::min(2, f.edges[e].facets); ++k) {
          const int facet = f.edges[e].facet[k];
          for (const std::size_t j : those) {
            const Node out = node(at_start[t].rotation0 * vec3(edges_[j].way));
            if (standing.has_side(facet) && dot3(standing.normal(facet), out) > 0.5) facing_.push_back({facet, v});
          }
        }
      // What ends there: edges between a face that bodies see and one that is covered, or of an open surface.
      Joint joint;
      joint.feature = v;
      int borders = 0, joined = 0;
      std::vector<int> seen;  // faces that end there
      for (const int e : edges_at[v]) {
        const Features::Edge& edge = f.edges[e];
        const int end = edge.node[0] == v ? 0 : 1;
        const Node along = standing.at(edge.node[1 - end]) - standing.at(v), inside = standing.at(v) + std::min(0.5, 2 * layer / along.norm()) * along;
        const auto is_open = [&](int k) {
          const Node way = standing.at(edge.opposite[k]) - inside;
          return standing.is_seen(edge.facet[k]) && !standing.is_covered(edge.facet[k], inside + layer / way.norm() * way, others);
        };
        const bool first = is_open(0), second = edge.facets == 2 && is_open(1);
        if (first) seen.push_back(edge.facet[0]);
        if (second) seen.push_back(edge.facet[1]);
        if (first == second) continue;  // a ridge, or inside of what is covered or level
        ++borders;
        for (const std::size_t j : those) {
          if (edges_[j].feature != e || (end == 0 ? edges_[j].first > 0 : edges_[j].last < 1)) continue;
          ++joined;
          joint.way += edges_[j].way;
          joint.gap = std::max(joint.gap, edges_[j].gap);
          joint.pairs.push_back(edges_[j].pairs[0]);
          break;
        }
      }
      const bool all_around = borders == joined && joined >= 2;
      if (!all_around) {
        // A corner of the smaller of two: all of the way over it is the other's face.
        joint = Joint();
        for (const std::size_t j : those) {
          const Features::Edge& edge = f.edges[edges_[j].feature];
          if (edge.node[0] == v ? edges_[j].first > 0 : edges_[j].last < 1) continue;
          const Node out = node(at_start[t].rotation0 * vec3(edges_[j].way)), along = standing.at(edge.node[1]) - standing.at(edge.node[0]);
          const Pair& pair = pairs_[edges_[j].pairs[0]];
          for (int k = 0; k < std::min(2, edge.facets); ++k)
            if (standing.is_seen(edge.facet[k]) && std::abs(dot3(standing.normal(edge.facet[k]), out)) < kBack &&
                standing.goes_on(edge.facet[k], standing.at(v) + layer / along.norm() * along, out, pair.first == t ? pair.second : pair.first) &&
                standing.goes_on(edge.facet[k], standing.at(v) - layer / along.norm() * along, out, pair.first == t ? pair.second : pair.first))
              joint = edges_[j];
        }
        if (joint.pairs.empty()) continue;
        joint.feature = v, joint.first = 0, joint.last = 1;
      }
      const double length = joint.way.norm();
      if (!(length > kBack)) continue;  // ways that go against each other
      joint.way /= length;
      const Node out = node(at_start[t].rotation0 * vec3(joint.way));
      joint.level = all_around && std::all_of(seen.begin(), seen.end(), [&](int facet) { return std::abs(dot3(standing.normal(facet), out)) < kBack; });
      vertices_.push_back(joint);
    }
  }
  std::sort(facing_.begin(), facing_.end());
  facing_.erase(std::unique(facing_.begin(), facing_.end()), facing_.end());
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
      return std::any_of(tools.begin(), tools.end(), [&](int tool) { return tool == pairs_[k].first || tool == pairs_[k].second; });
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
