// Which features are near: the list and its margin, the workspace.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "contact/impl.h"

namespace forming_sim {

double Contact::Impl::fastest(const NodeField& v) const {
  return std::sqrt(team.largest(static_cast<long>(body_vertices.size()), kNodesOfAThread, [&](long first, long last) {
    double of_share[4] = {0, 0, 0, 0};  // that do not wait for each other
    long k = first;
    for (; k + 4 <= last; k += 4)
      for (int j = 0; j < 4; ++j) {
        const Node& u = v[body_vertices[k + j]];
        of_share[j] = std::max(of_share[j], dot3(u, u));
      }
    for (; k < last; ++k) of_share[0] = std::max(of_share[0], dot3(v[body_vertices[k]], v[body_vertices[k]]));
    return *std::max_element(of_share, of_share + 4);
  }));
}

// Largest way of any point of the present tools between two poses, m. The
// motion is affine, so that a corner of the box moves farthest.
template <class From, class To>
double Contact::Impl::farthest(const NodeField& x, From&& from, To&& to, std::vector<double>* ways) const {
  double most = 0;
  Box bodies;
  bool have = false;
  for (size_t t = 0; t < motion.size(); ++t) {
    if (!motion[t].present) continue;
    Box box = tool_index->of(static_cast<int>(t)).box();
    if (tools.is_plane[t]) {
      if (!have)
        for (int i : body_vertices) bodies.add(x[i]);
      have = true;
      box = bodies;  // in the world: brought into the tool's frame below
    }
    if (box.empty()) continue;
    double way = 0;
    for (int i = 0; i < 8; ++i) {
      Vec3 p = box.corner(i);
      if (tools.is_plane[t]) p = motion[t].rotation0.transpose() * (p - motion[t].position0);
      way = std::max(way, (to(t, p) - from(t, p)).norm());
    }
    if (ways) (*ways)[t] = way;
    most = std::max(most, way);
  }
  return most;
}

double Contact::Impl::step_way(const NodeField& x, double dt) {
  // Velocity of a point of a tool that nothing presses on, in what it is free to do.
  const auto freely = [](const ToolMotion& m, const Vec3& at) {
    Vec3 sum = Vec3::Zero();
    for (const ToolFreedom& f : m.freedom)
      if (f.inverse_mass > 0) sum += f.speed * f.along(at);
    return sum;
  };
  bool rests = true;
  for (const ToolMotion& m : motion) rests = rests && m.position0 == m.position1 && m.rotation0 == m.rotation1;
  told_ways.assign(motion.size(), 0.0);
  if (rests) return 0;
  return farthest(x, [&](size_t t, const Vec3& p) { return pose0(motion[t], p); },
             [&](size_t t, const Vec3& p) -> Vec3 { return pose1(motion[t], p) - dt * freely(motion[t], pose0(motion[t], p)); }, &told_ways);
}

// Squares and cubes of lengths must stay numbers.
void Contact::Impl::check_reach(const NodeField& x, double radius) const {
  constexpr double kFarthest = 1e30;  // m
  const auto lost = std::find_if(body_vertices.begin(), body_vertices.end(), [&](int v) { return !(x[v].cwiseAbs().maxCoeff() < kFarthest); });
  if (lost == body_vertices.end() && radius < kFarthest) return;
  std::ostringstream text;
  if (lost != body_vertices.end())
    text << name_of_vertex(*lost) << " is at (" << vec3(x[*lost]).transpose() << ") m";
  else
    text << "a body or tool would go " << radius << " m in a step";
  text << ", farther than numbers reach: look for a motion, a boundary, a pressure, gravity or an initial velocity in other units than m, s, Pa";
  throw Error(Code::contact_error, text.str());
}

void Contact::Impl::ensure_list(const NodeField& x, double reach, double step_bound) {
  if (flush.mark(motion, features)) listed = false;
  const bool same = listed && std::equal(motion.begin(), motion.end(), listed_present.begin(), listed_present.end(), [](const ToolMotion& tool, bool was) { return tool.present == was; });
  if (same) {
    if (used + reach <= list.radius) return;
    // The bound adds up vibrations; how far has anything really gone?
    double body = 0;
    for (size_t i = 0; i < body_vertices.size(); ++i) body = std::max(body, (x[body_vertices[i]] - x_at_build[i]).squaredNorm());
    const double tool = farthest(x, [&](size_t t, const Vec3& p) { return pose0(motion_at_build[t], p); },
                            [&](size_t t, const Vec3& p) { return pose0(motion[t], p); });
    used = (both * std::sqrt(body) + tool) * (1 + 1e-12);
    if (used + reach <= list.radius - std::max(0.1 * features.mean_edge, step_bound)) return;
  }
  const double radius = reach + std::max(0.25 * features.mean_edge, 4 * step_bound);
  check_reach(x, radius);
  listed_present = ToolSet::present(motion);
  tools.place_planes(motion, planes);
  list = build_list(features, x, {*tool_index, motion, listed_present, tools.is_plane, planes}, ties, radius, work);
  listed = true;
  motion_at_build = motion;
  x_at_build.clear();
  for (int v : body_vertices) x_at_build.push_back(x[v]);
  travel = used = 0;
  ++builds;
  inertia = 1;
  work.fixed.clear();
  for (int i = 0; i < work.body_entries; ++i) {
    work.share[i].inverse_mass = inverse_mass[work.vertex[i]];
    const int h = held_of[work.vertex[i]];
    work.share[i].held = h >= 0;
    work.projector[i] = h >= 0 ? &held[h].projector : nullptr;
    if (work.share[i].inverse_mass == 0 || (h >= 0 && held[h].projector.topLeftCorner(features.dimension, features.dimension).isZero(0))) work.fixed.push_back(i);
  }
  link_ties();
}

void Contact::Impl::link_ties() {
  tie_pairs.clear();
  std::vector<bool> told;  // of the entries of tools
  for (std::size_t i = work.body_entries; i < work.vertex.size(); ++i) told.push_back(work.vertex[i] < 0 || motion[features.vertex_surface[work.vertex[i]] - features.bodies].is_told());
  feet = list.planes.size();
  std::vector<TiePair> given_up;
  parted.resize(ties.size(), 0);
  for (const NearList::TieEntry& entry : list.ties) {
    TiePair tie = link_tie(ties[entry.tie], entry.tie, entry.node);
    prepare_tie(work, tie);
    if (tie.to_tool) {
      ++feet;
      told[tie.node[1] - work.body_entries] = motion[tie.tool].is_told();
    }
    (parted[entry.tie] ? given_up : tie_pairs).push_back(tie);
  }
  doubled = take_out_doubled(work, told, tie_pairs);
  doubled.insert(doubled.end(), given_up.begin(), given_up.end());
}

// What goes together goes on being tied, also where it hangs on other ties for a while; what has parted is given up for good: tied again it would snap shut.
void Contact::Impl::give_up_parted_ties() {
  const auto surfaces_of = [&](const Tie& tie) -> std::pair<int, int> {
    const int first = features.vertex_surface[tie.node[0]], second = tie.to_tool() ? features.bodies + tie.tool : features.vertex_surface[tie.node[tie.nodes - 1]];
    return std::minmax({first, second});
  };
  for (TiePair& pair : doubled) {
    if (parted[pair.tie]) continue;
    const Tie& tie = ties[pair.tie];
    aim_tie(tie, work, motion, pair);
    if (!(pair.missing.norm() > layer)) continue;
    const std::pair<int, int> both = surfaces_of(tie);
    bool known = false;
    for (std::size_t t = 0; t < ties.size(); ++t) known = known || (parted[t] && surfaces_of(ties[t]) == both);
    parted[pair.tie] = 1;
    if (known) continue;
    const auto name = [&](int s) { return s < features.bodies ? "body " + body_names[s] : "tool " + tools.names[s - features.bodies]; };
    std::ostringstream text;
    text << name(both.first) << " and " << name(both.second) << " are tied, and part where other ties or boundaries hold them, at " << name_of_vertex(tie.node[0])
         << " first: what is told to be in two places is left where the others have it. Keep ties off what is held or driven otherwise";
    step.told = text.str();
  }
}

void Contact::Impl::set_inertia(double wanted) {
  if (wanted == inertia) return;
  for (int i = 0; i < work.body_entries; ++i) work.share[i].inverse_mass = inverse_mass[work.vertex[i]] / wanted;
  for (TiePair& pair : tie_pairs) pair.mass = wanted * pair.undamped;
  inertia = wanted;
}

void Contact::Impl::gather(const NodeField& x, const NodeField& v, const NodeField& v_star, double dt) {
  set_inertia(1 + 0.25 * damping * (previous_dt + dt));
  team.share(work.body_entries, kNodesOfAThread, [&](long first, long last) {
    for (long i = first; i < last; ++i) {
      const int n = work.vertex[i];
      work.x[i] = x[n];
      work.v[i] = v_star[n];
      work.before[i] = v[n];
    }
  });
  for (const int i : work.fixed) work.stands[i] = work.v[i] == Node::Zero();
  // Where a point of a tool is and how it moves, from its place in the tool's frame.
  const auto place_on_tool = [&](size_t entry, int tool, const Vec3& p) {
    const ToolMotion& m = motion[tool];
    const Vec3 now = pose0(m, p);
    work.x[entry] = node(now);
    work.v[entry] = node((pose1(m, p) - now) / dt);
    work.stands[entry] = m.is_told() && work.v[entry] == Node::Zero();
    work.before[entry] = previous_dt > 0 ? node((now - pose0(previous_motion[tool], p)) / previous_dt) : work.v[entry];
  };
  const size_t last = work.vertex.size() - feet;
  team.share(static_cast<long>(last) - work.body_entries, kNodesOfAThread, [&](long from, long to) {
    for (size_t i = work.body_entries + from; i < static_cast<size_t>(work.body_entries + to); ++i) {
      const int n = work.vertex[i];
      place_on_tool(i, features.vertex_surface[n] - features.bodies, vec3(features.place[n - features.body_nodes]));
    }
  });
  for (const NearList::PlanePair& p : list.planes) {
    const ToolMotion& m = motion[p.tool];
    const PlanePose& plane = planes[p.tool];
    const Node foot = work.x[p.node] - dot3(work.x[p.node] - plane.point, plane.normal) * plane.normal;
    place_on_tool(p.foot, p.tool, m.rotation0.transpose() * (vec3(foot) - m.position0));
    work.x[p.foot] = foot;  // to the last bit
  }
  for (const std::vector<TiePair>* all : {&tie_pairs, &doubled})
    for (const TiePair& tie : *all)
      if (tie.to_tool) place_on_tool(tie.node[1], tie.tool, ties[tie.tie].kept);
  if (waves.any()) {
    work.steady.resize(work.v.size());
    const double steps = previous_dt > 0 ? dt / previous_dt : 0;
    for (int i = 0; i < work.body_entries; ++i) work.steady[i] = waves.steady(work.vertex[i], steps, work.before[i]);
    std::copy(work.v.begin() + work.body_entries, work.v.end(), work.steady.begin() + work.body_entries);
  }
  for (TiePair& tie : tie_pairs) aim_tie(ties[tie.tie], work, motion, tie);
  give_up_parted_ties();
}

void Contact::Impl::moved_by(double way) {
  travel += way * (1 + 1e-12);
  used += way * (1 + 1e-12);
}

}  // namespace forming_sim
