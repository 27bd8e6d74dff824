#include "forming_sim/contact/contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/continuous.h"
#include "forming_sim/contact/crossing.h"
#include "forming_sim/contact/law.h"
#include "forming_sim/contact/layers.h"
#include "forming_sim/contact/list.h"
#include "forming_sim/contact/narrow.h"
#include "forming_sim/contact/sweeps.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {

struct Contact::Impl {
  // ---- what does not change
  ContactConfig config;
  Features features;
  ToolSet tools;
  std::vector<double> friction;
  std::vector<std::string> body_names;
  std::vector<Vec3> body_shifts;
  double both = 1;          ///< 2 where both sides of a pair can be deformable and move
  double layer = 0, ceiling = 0, modulus = 0, push_speed = 0;
  std::vector<std::string> warnings;
  // ---- masses
  std::vector<double> inverse_mass;
  std::vector<HeldNode> held;
  std::vector<int> held_of;
  // ---- what the next step depends on
  std::vector<LayerRecord> records;
  double potential = 0;
  // ---- the list and how much of its margin is used
  NearList list;
  Workspace work;
  bool listed = false;
  long builds = 0;
  double travel = 0;        ///< bound on relative motion since the list was built (never falls)
  double used = 0;          ///< of the list's radius
  std::vector<bool> listed_present;
  NodeField x_at_build;     ///< of the bodies' surface vertices, in their order
  std::vector<ToolMotion> motion_at_build;
  // ---- scratch
  NodeField v_star, place;
  Narrow near;
  std::vector<double> moved;
  std::vector<LayerRecord> next_records;

  template <class Each> void each_body_vertex(Each&& each) const {
    for (int b = 0; b < features.bodies; ++b)
      for (int v : features.surfaces[b].vertices) each(v);
  }

  double fastest(const NodeField& v) const {
    double most = 0;
    each_body_vertex([&](int i) { most = std::max(most, dot3(v[i], v[i])); });
    return std::sqrt(most);
  }

  // Largest way of any point of the present tools between two poses, m. The
  // motion is affine, so that a corner of the box moves farthest.
  template <class From, class To>
  double way(const std::vector<ToolMotion>& motion, const NodeField& x, From&& from, To&& to) const {
    double most = 0;
    Box bodies;
    bool have = false;
    for (size_t t = 0; t < motion.size(); ++t) {
      if (!motion[t].present) continue;
      Box box = tools.frame_box[t];
      if (tools.is_plane[t]) {
        if (!have) each_body_vertex([&](int i) { bodies.add(x[i]); });
        have = true;
        box = bodies;  // in the world: brought into the tool's frame below
      }
      if (box.empty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        Vec3 p;
        for (int k = 0; k < 3; ++k) p[k] = corner >> k & 1 ? box.high[k] : box.low[k];
        if (tools.is_plane[t]) p = motion[t].rotation0.transpose() * (p - motion[t].position0);
        most = std::max(most, (to(t, p) - from(t, p)).norm());
      }
    }
    return most;
  }
  double step_way(const std::vector<ToolMotion>& motion, const NodeField& x) const {
    bool rests = true;
    for (const ToolMotion& m : motion) rests = rests && m.position0 == m.position1 && m.rotation0 == m.rotation1;
    if (rests) return 0;
    return way(motion, x, [&](size_t t, const Vec3& p) { return pose0(motion[t], p); },
               [&](size_t t, const Vec3& p) { return pose1(motion[t], p); });
  }

  void ensure_list(const NodeField& x, const std::vector<ToolMotion>& motion, double reach, double step_bound) {
    const std::vector<bool> present = ToolSet::present(motion);
    if (listed && present == listed_present) {
      if (used + reach <= list.radius) return;
      // The bound adds up vibrations; how far has anything really gone?
      double body = 0;
      size_t i = 0;
      each_body_vertex([&](int v) { body = std::max(body, (x[v] - x_at_build[i++]).squaredNorm()); });
      const double tool = way(motion, x, [&](size_t t, const Vec3& p) { return pose0(motion_at_build[t], p); },
                              [&](size_t t, const Vec3& p) { return pose0(motion[t], p); });
      used = (both * std::sqrt(body) + tool) * (1 + 1e-12);
      if (used + reach <= list.radius - std::max(0.1 * features.mean_edge, step_bound)) return;
    }
    tools.place_all(features, motion, false, place);
    const double radius = reach + std::max(0.25 * features.mean_edge, 4 * step_bound);
    list = build_list(features, x, place, present, tools.is_plane, tools.planes(motion), radius, work);
    listed = true;
    listed_present = present;
    motion_at_build = motion;
    x_at_build.clear();
    each_body_vertex([&](int v) { x_at_build.push_back(x[v]); });
    travel = used = 0;
    ++builds;
    for (int i = 0; i < work.body_entries; ++i) {
      work.inverse_mass[i] = inverse_mass[work.vertex[i]];
      const int h = held_of[work.vertex[i]];
      work.projector[i] = h >= 0 ? &held[h].projector : nullptr;
    }
  }

  void gather(const NodeField& x, const NodeField& v, double dt, const std::vector<ToolMotion>& motion, const std::vector<PlanePose>& planes) {
    for (int i = 0; i < work.body_entries; ++i) {
      const int n = work.vertex[i];
      work.x[i] = x[n];
      work.v[i] = v_star[n];
      work.before[i] = v[n];
    }
    const size_t feet = list.planes.size(), last = work.vertex.size() - feet;
    int surface = features.bodies;
    for (size_t i = work.body_entries; i < last; ++i) {
      const int n = work.vertex[i];
      while (surface + 1 < static_cast<int>(features.surfaces.size()) && n >= features.surfaces[surface + 1].first_vertex) ++surface;
      const Vec3 p = vec3(features.place[n - features.body_nodes]);
      const ToolMotion& m = motion[surface - features.bodies];
      work.x[i] = node(pose0(m, p));
      work.v[i] = work.before[i] = (node(pose1(m, p)) - work.x[i]) / dt;
    }
    for (const NearList::PlanePair& p : list.planes) {
      const ToolMotion& m = motion[p.tool];
      const PlanePose& plane = planes[p.tool];
      const Node foot = work.x[p.node] - dot3(work.x[p.node] - plane.point, plane.normal) * plane.normal;
      work.x[p.foot] = foot;
      work.v[p.foot] = work.before[p.foot] = (node(pose1(m, m.rotation0.transpose() * (vec3(foot) - m.position0))) - foot) / dt;
    }
  }

  void set_constants() {
    for (ContactPair& pair : near.pairs) {
      // The mean area of the deformable nodes.
      double sum = 0;
      int count = 0;
      for (int k = 0; k < pair.nodes; ++k)
        if (pair.node[k] < work.body_entries) {
          sum += features.area[work.vertex[pair.node[k]]];
          ++count;
        }
      pair.stiffness = count > 0 ? modulus * layer * sum / count : 0;
      int rigid = pair.surface;
      if (rigid < features.bodies) rigid = surface_of_first(pair);
      pair.tool = std::max(-1, rigid - features.bodies);
      pair.friction = pair.tool >= 0 ? friction[pair.tool] : config.friction;
    }
    prepare_pairs(work, near.pairs);
  }

  int surface_of_first(const ContactPair& pair) const { return features.vertex_surface[work.vertex[pair.node[0]]]; }

  // The first close pair that touches on the way, -1: none.
  int first_touch(double dt) {
    moved.resize(work.v.size());
    for (size_t i = 0; i < moved.size(); ++i) moved[i] = dt * std::sqrt(dot3(work.v[i], work.v[i]));
    Node x[4], d[4];
    for (size_t c = 0; c < near.close.size(); ++c) {
      const ClosePair& close = near.close[c];
      int n[4], count, split;
      if (close.group >= 0) {
        const NearList::FacetEntry& e = list.facets[close.entry];
        n[0] = list.groups[close.group].node;
        for (int k = 0; k < features.corners(); ++k) n[1 + k] = e.node[k];
        count = 1 + features.corners();
        split = 1;
      } else {
        for (int k = 0; k < 4; ++k) n[k] = list.edges[close.entry].node[k];
        count = 4;
        split = 2;
      }
      double most[2] = {0, 0};
      for (int k = 0; k < count; ++k) most[k >= split] = std::max(most[k >= split], moved[n[k]]);
      if (most[0] + most[1] < 0.999 * close.distance) continue;
      for (int k = 0; k < count; ++k) {
        d[k] = dt * work.v[n[k]];
        x[k] = work.x[n[k]];
      }
      const double least = 1e-3 * std::min(close.distance, layer);
      if (close.group >= 0 ? point_meets_facet(features.corners(), x, d, least) : edges_meet(x, d, least)) return static_cast<int>(c);
    }
    return -1;
  }

  std::string name_of_vertex(int v) const {
    std::ostringstream text;
    const int s = features.vertex_surface[v];
    if (v < features.body_nodes)
      text << "node " << v << " of body " << body_names[s];
    else
      text << "a vertex of tool " << tools.names[s - features.bodies];
    return text.str();
  }
  std::string name_of_entry(int entry) const {
    const Node& p = work.x[entry];
    std::ostringstream text;
    text << (work.vertex[entry] < 0 ? "the plane" : name_of_vertex(work.vertex[entry])) << " at (" << p[0] << ", " << p[1] << ", " << p[2] << ") m";
    return text.str();
  }

  std::string name_of_other(const ContactPair& pair) const {
    return pair.tool >= 0 ? "tool " + tools.names[pair.tool] : "body " + body_names[pair.surface];
  }

  void check_unmovable(double time) const {
    for (const ContactPair& pair : near.pairs) {
      if (pair.w > 0 || pair.end_gap > 0) continue;
      std::ostringstream text;
      text << "at time " << time << " s " << name_of_other(pair) << " runs over " << name_of_entry(pair.node[0])
           << ", which is held or driven against it (gap " << pair.end_gap << " m at the end of the step): let it stop short of it, or free the node";
      throw Error(Code::contact_error, text.str());
    }
  }

  [[noreturn]] void give_up(double time, double dt, int touch) const {
    std::ostringstream text;
    text << "at time " << time << " s contact found no step without a crossing, down to " << dt << " s (" << config.max_halvings << " halvings)";
    if (touch >= 0) {
      const ClosePair& close = near.close[touch];
      const int a = close.group >= 0 ? list.groups[close.group].node : list.edges[close.entry].node[0];
      const int b = close.group >= 0 ? list.facets[close.entry].node[0] : list.edges[close.entry].node[2];
      text << ": " << (close.group >= 0 ? "" : "an edge from ") << name_of_entry(a) << " and a feature with " << name_of_entry(b) << ", " << close.distance << " m apart";
    } else {
      double worst = 1e300;
      const ContactPair* pair = nullptr;
      for (const ContactPair& p : near.pairs)
        if (p.end_gap < worst) {
          worst = p.end_gap;
          pair = &p;
        }
      if (pair) text << ": " << name_of_entry(pair->node[0]) << " against " << name_of_other(*pair) << " ends at a gap of " << worst << " m";
    }
    text << ". The bodies may be squeezed harder than they can yield, or move too fast for the layer of " << layer
         << " m: check the tools' stroke, refine the mesh there, or set contact.layer larger";
    throw Error(Code::contact_error, text.str());
  }
};

Contact::Contact(const ContactSetup& setup, const NodeField& at, const std::vector<ToolMotion>& at_start) : impl_(new Impl) {
  Impl& m = *impl_;
  m.config = setup.config;
  m.features = build_features(setup, at);
  m.layer = setup.config.layer > 0 ? setup.config.layer : std::min(0.05 * m.features.smallest_edge, 1e-3 * setup.thinnest);
  m.ceiling = std::max(m.layer, 0.05 * m.features.smallest_edge);
  m.modulus = setup.config.stiffness > 0 ? setup.config.stiffness : setup.softest_modulus;
  m.push_speed = setup.config.push_speed > 0 ? setup.config.push_speed : std::min(0.1, 1e-3 * setup.wave_speed);
  for (const ContactSurface& body : setup.bodies) m.body_names.push_back(body.name);
  for (const ContactSurface& tool : setup.tools) {
    m.tools.is_plane.push_back(tool.plane);
    m.tools.point.push_back(tool.point);
    m.tools.normal.push_back(tool.normal);
    m.tools.names.push_back(tool.name);
    m.friction.push_back(tool.friction);
  }
  m.both = m.features.bodies_meet() ? 2 : 1;
  NodeField x = at;
  m.body_shifts = part_bodies(m.layer, setup, m.features, x, m.warnings);
  const std::vector<int> sides = find_sides(m.layer, m.features, x, at_start);
  set_back(m.layer, sides, setup, m.features, m.tools, m.warnings);
  check_start(m.layer, sides, setup, x, at_start, m.features, m.tools, m.warnings);
  m.tools.frame_box.resize(setup.tools.size());
  for (size_t t = 0; t < setup.tools.size(); ++t)
    for (int v : m.features.surfaces[m.features.bodies + t].vertices) m.tools.frame_box[t].add(m.features.place[v - m.features.body_nodes]);
}
Contact::~Contact() = default;
Contact::Contact(Contact&&) noexcept = default;
Contact& Contact::operator=(Contact&&) noexcept = default;

void Contact::set_masses(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held) {
  impl_->inverse_mass = inverse_mass;
  impl_->held = held;
  impl_->held_of.assign(inverse_mass.size(), -1);
  for (size_t i = 0; i < held.size(); ++i) impl_->held_of[held[i].node] = static_cast<int>(i);
  impl_->listed = false;
}

ContactStep Contact::advance(double time, double dt, NodeField& x, NodeField& v, const Predict& predict, const ToolsAt& tools_at) {
  Impl& m = *impl_;
  m.v_star.resize(x.size());
  ContactStep step;
  bool all = false;  // let pairs that push askew act before they are in their layer
  for (;;) {
    const std::vector<ToolMotion> motion = tools_at(dt);
    predict(dt, m.v_star);
    const double tool_way = m.step_way(motion, x);
    double bound = 2 * (m.both * m.fastest(m.v_star) * dt + tool_way);
    double thickest = m.layer;
    for (const LayerRecord& r : m.records) thickest = std::max(thickest, r.layer);
    const std::vector<PlanePose> planes = m.tools.planes(motion);
    SweepResult swept;
    double way = 0;
    // The sweeps may make a node faster than was predicted: then look farther.
    for (;; bound = 1.5 * way) {
      const double reach = std::max(thickest, std::min(m.ceiling, 0.1 * bound)) + bound;
      m.ensure_list(x, motion, reach, bound);
      m.near.pairs.clear();
      m.near.close.clear();
      way = bound / 2;
      if (m.list.size() == 0) break;
      m.gather(x, v, dt, motion, planes);
      narrow_phase(m.features, m.work, planes, m.layer, all, reach, m.travel, m.list, m.near);
      m.set_constants();
      assign_layers(m.records, m.work, dt, m.layer, m.ceiling, m.near.pairs);
      swept = SweepResult();
      if (!m.near.pairs.empty()) swept = solve_pairs(dt, 1e-3 * m.layer, m.config.max_sweeps, m.work, m.near.pairs);
      double fastest = 0;
      for (int i = 0; i < m.work.body_entries; ++i) fastest = std::max(fastest, dot3(m.work.v[i], m.work.v[i]));
      way = std::max(bound / 2, m.both * std::sqrt(fastest) * dt + tool_way);
      if (way <= bound) break;
    }
    step.sweeps += swept.sweeps;
    m.check_unmovable(time + dt);
    const int touch = swept.open ? m.first_touch(dt) : -1;
    if (swept.open && touch < 0) {
      m.travel += way * (1 + 1e-12);
      m.used += way * (1 + 1e-12);
      break;
    }
    if (!all) {
      all = true;
      continue;
    }
    if (step.halvings >= m.config.max_halvings) m.give_up(time, dt, touch);
    dt /= 2;
    ++step.halvings;
  }
  step.dt = dt;

  // ---- velocities and places
  if (!m.near.pairs.empty())
    for (int i = 0; i < m.work.body_entries; ++i) m.v_star[m.work.vertex[i]] = m.work.v[i];
  v.swap(m.v_star);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * v[i];

  // ---- what it did
  step.tool_impulse.assign(m.tools.names.size(), Vec3::Zero());
  step.tool_angular_impulse.assign(m.tools.names.size(), Vec3::Zero());
  double start = 0;
  step.layer = m.layer;
  for (const ContactPair& pair : m.near.pairs) {
    start += mild_potential(pair.gap, pair.layer, pair.stiffness);
    step.min_gap_over_layer = std::min(step.min_gap_over_layer, pair.end_gap / m.layer);
    if (pair.impulse == 0) continue;
    ++step.active;
    step.layer = std::max(step.layer, pair.layer);
    const Vec3 impulse = vec3(pair.impulse * pair.normal + pair.slip);
    for (int k = 0; k < pair.nodes; ++k) {
      if (pair.node[k] < m.work.body_entries) continue;
      step.tool_impulse[pair.tool] += pair.weight[k] * impulse;
      step.tool_angular_impulse[pair.tool] += vec3(m.work.x[pair.node[k]]).cross(pair.weight[k] * impulse);
    }
  }
  const PairWork done = work_of(m.work, m.near.pairs);
  const RelaxedPotential end = relax_layers(m.push_speed * dt, m.near.pairs, m.next_records);
  step.soft_start_work = end.after - end.before;
  step.potential = end.after;
  m.records.swap(m.next_records);
  step.tool_work = done.tool;
  step.held_work = done.held;
  step.friction_work = done.friction;
  // Potential that comes or goes with the change of features counts as dissipation, of either sign.
  step.dissipated = -done.normal - (end.before - start) - (start - m.potential);
  m.potential = step.potential;
  return step;
}

long Contact::count_crossings(const NodeField& x, const std::vector<ToolMotion>& tools) const {
  const Impl& m = *impl_;
  NodeField place;
  m.tools.place_all(m.features, tools, false, place);
  return static_cast<long>(find_crossings(m.features, x, place, ToolSet::present(tools), m.tools.is_plane, m.tools.planes(tools)).size());
}

void Contact::add_normal_impulses(std::vector<double>& sum) const {
  for (const ContactPair& pair : impl_->near.pairs)
    for (int k = 0; k < pair.nodes; ++k)
      if (pair.node[k] < impl_->work.body_entries) sum[impl_->work.vertex[pair.node[k]]] += std::abs(pair.weight[k]) * pair.impulse;
}

const std::vector<double>& Contact::nodal_area() const { return impl_->features.area; }
double Contact::layer() const { return impl_->layer; }
double Contact::stiffness() const { return impl_->modulus; }
double Contact::push_speed() const { return impl_->push_speed; }
long Contact::listed_pairs() const { return impl_->list.size(); }
long Contact::list_builds() const { return impl_->builds; }
const std::vector<Vec3>& Contact::body_shifts() const { return impl_->body_shifts; }
const std::vector<std::string>& Contact::warnings() const { return impl_->warnings; }

namespace {
constexpr std::uint64_t kMagic = 0x31746361746e6f43u;  // "Contact1"
struct SavedHeader {
  std::uint64_t magic, vertices, facets, records;
  double potential;
};
static_assert(std::is_trivially_copyable<LayerRecord>::value, "saved byte by byte");
}  // namespace

std::vector<char> Contact::save() const {
  const Impl& m = *impl_;
  const SavedHeader header{kMagic, static_cast<std::uint64_t>(m.features.vertex_count), m.features.facets.size(), m.records.size(), m.potential};
  std::vector<char> data(sizeof header + m.records.size() * sizeof(LayerRecord));
  std::memcpy(data.data(), &header, sizeof header);
  if (!m.records.empty()) std::memcpy(data.data() + sizeof header, m.records.data(), m.records.size() * sizeof(LayerRecord));
  return data;
}

void Contact::restore(const std::vector<char>& data) {
  Impl& m = *impl_;
  SavedHeader header;
  const bool whole = data.size() >= sizeof header && (std::memcpy(&header, data.data(), sizeof header), header.magic == kMagic) &&
                     data.size() == sizeof header + header.records * sizeof(LayerRecord);
  if (!whole) throw Error(Code::resume_error, "the saved contact is damaged or of another version");
  if (header.vertices != static_cast<std::uint64_t>(m.features.vertex_count) || header.facets != m.features.facets.size())
    throw Error(Code::resume_error, "the saved contact has other surfaces than this scene: resume with the scene that was saved");
  m.records.resize(header.records);
  if (!m.records.empty()) std::memcpy(m.records.data(), data.data() + sizeof header, m.records.size() * sizeof(LayerRecord));
  m.potential = header.potential;
  m.listed = false;
}

}  // namespace forming_sim
