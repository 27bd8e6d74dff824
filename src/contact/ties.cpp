#include "forming_sim/contact/ties.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/list.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

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
  double distance = 0;
};

Closest closest_on_facet(const Features& f, const Node& p, const Node* const corner[3]) {
  return f.dimension == 2 ? closest_on_segment_facet(p, *corner[0], *corner[1]) : closest_on_triangle(p, *corner[0], *corner[1], *corner[2]);
}

// Unit vectors of a facet: along its first side, across in it, normal to it.
Mat3 frame_of(int corners, const Node* const corner[3]) {
  Mat3 frame = Mat3::Identity();
  const Vec3 along = vec3(*corner[1] - *corner[0]).normalized();
  Vec3 normal = Vec3::UnitZ();
  if (corners == 3) normal = along.cross(vec3(*corner[2] - *corner[0])).normalized();
  frame.col(0) = along;
  frame.col(1) = normal.cross(along);
  frame.col(2) = normal;
  return frame;
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
    if (config.tie_distance > 0) pair.distance = config.tie_distance;
    radius = std::max(radius, pair.distance);
    pairs.push_back(pair);
  }
  if (pairs.empty()) return ties;
  Workspace work;
  const std::vector<bool> all(setup.tools.size(), true);
  const NearList list = build_list(f, x, {ToolIndex(f, place, all), {}, all, is_plane, planes}, {}, radius, work);
  const auto at = [&](int v) -> const Node& { return v < f.body_nodes ? x[v] : place[v - f.body_nodes]; };
  for (const TiedPair& pair : pairs) {
    std::vector<bool> zone(f.vertex_count, false);
    const std::size_t before = ties.size();
    for (const auto& g : list.groups) {
      const int own = f.vertex_surface[g.vertex];
      if (!(own == pair.first && g.surface == pair.second) && !(own == pair.second && g.surface == pair.first)) continue;
      Tie tie;
      double least = pair.distance * pair.distance;
      bool near = false;
      for (int i = g.first; i < g.last; ++i) {
        const auto& c = f.facets[list.facets[i].facet];
        const Node* const corner[3] = {&at(c[0]), &at(c[1]), &at(c[f.corners() - 1])};
        const Closest q = closest_on_facet(f, at(g.vertex), corner);
        if (q.squared > least || (near && q.squared == least)) continue;
        near = true;
        least = q.squared;
        for (int k = 0; k < f.corners(); ++k) {
          tie.corner[k] = c[k];
          tie.weight[k] = q.weight[k];
        }
      }
      if (!near) continue;
      zone[g.vertex] = true;
      for (int v : tie.corner)
        if (v >= 0) zone[v] = true;
      if (own != pair.first) continue;
      tie.vertex = g.vertex;
      if (pair.second >= f.bodies) {
        std::fill(tie.corner, tie.corner + 3, -1);
        tie.tool = pair.second - f.bodies;
      }
      ties.push_back(tie);
    }
    for (const auto& p : list.planes) {
      if (f.vertex_surface[p.vertex] != pair.first || f.bodies + p.tool != pair.second) continue;
      if (std::abs(dot3(at(p.vertex) - planes[p.tool].point, planes[p.tool].normal)) > pair.distance) continue;
      Tie tie;
      tie.vertex = p.vertex;
      tie.tool = p.tool;
      zone[p.vertex] = true;
      ties.push_back(tie);
    }
    if (ties.size() == before) refuse(setup, f, pair);
    f.relation(pair.first, pair.second).tie = f.relation(pair.second, pair.first).tie = static_cast<int>(f.tied_zones.size());
    f.tied_zones.push_back(std::move(zone));
  }
  return ties;
}

void keep_ties(const NodeField& x, const std::vector<ToolMotion>& motion, std::vector<Tie>& ties) {
  for (Tie& tie : ties) {
    if (tie.tool >= 0) {
      tie.kept = motion[tie.tool].rotation0.transpose() * (vec3(x[tie.vertex]) - motion[tie.tool].position0);
      continue;
    }
    Node r = x[tie.vertex];
    for (int k = 0; k < tie.corners(); ++k) r -= tie.weight[k] * x[tie.corner[k]];
    const Node* const corner[3] = {&x[tie.corner[0]], &x[tie.corner[1]], &x[tie.corner[tie.corners() - 1]]};
    tie.kept = frame_of(tie.corners(), corner).transpose() * vec3(r);
  }
}

TiePair link_tie(const Tie& tie, int index, const int* entries) {
  TiePair pair;
  pair.tie = index;
  pair.tool = tie.tool;
  pair.nodes = 1 + (tie.tool >= 0 ? 1 : tie.corners());
  pair.weight[0] = 1;
  for (int k = 1; k < pair.nodes; ++k) pair.weight[k] = tie.tool >= 0 ? -1 : -tie.weight[k - 1];
  std::copy(entries, entries + pair.nodes, pair.node);
  return pair;
}

void prepare_tie(const Workspace& work, TiePair& pair) {
  Mat3 w = Mat3::Zero();
  double total = 0;
  for (int k = 0; k < pair.nodes; ++k) {
    const int n = pair.node[k];
    const Share& share = work.share[n];
    const double b2m = pair.weight[k] * pair.weight[k] * share.inverse_mass;
    total += b2m;
    w += share.projector ? Mat3(b2m * *share.projector) : Mat3(b2m * Mat3::Identity());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(w);
  pair.mass.setZero();
  for (int k = 0; k < 3; ++k) {
    const double value = solver.eigenvalues()[k];
    if (value > 1e-12 * total) pair.mass += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose() / value;
  }
}

void aim_tie(const Tie& tie, const Workspace& work, TiePair& pair) {
  pair.impulse.setZero();
  pair.missing = -relative(pair, work.x);
  if (tie.tool >= 0) return;
  const Node* const corner[3] = {&work.x[pair.node[1]], &work.x[pair.node[2]], &work.x[pair.node[pair.nodes - 1]]};
  pair.missing += node(frame_of(tie.corners(), corner) * tie.kept);
}

double sweep_tie(double dt, Workspace& work, TiePair& pair) {
  const Node change = pair.missing / dt - relative(pair, work.v);
  const Node impulse = node(pair.mass * vec3(change));
  pair.impulse += impulse;
  push(pair, impulse, work, work.v);
  return dt * vec3(change).norm();  // the fourth components hold masses
}

}  // namespace forming_sim
