#include "forming_sim/contact/contact.h"

#include <Eigen/Geometry>
#include <cstring>

#include "contact/impl.h"
#include "forming_sim/config/words.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/crossing.h"

namespace forming_sim {

namespace {
/// Bodies stand a layer apart where they meet, as if each were thicker by half of it: what is pressed into another is as much tighter. So the layer is
/// thinner, by this, where some come together that were apart. What touches from the start on is set a layer apart there and loses nothing, and packs that are squeezed
/// would take twice the sweeps; a hem changes by half a per cent and takes a quarter more time. So would rubber, which is pressed by its modulus and more and goes far into its layer.
constexpr double kWhereBodiesComeTogether = .1;
constexpr double kOfClearance = .2;  ///< bodies that stand close are to meet where they meet, not a layer before
}

Contact::Contact(const ContactSetup& setup, const NodeField& at, const std::vector<ToolMotion>& at_start) : impl_(new Impl(setup.team)) {
  Impl& m = *impl_;
  m.config = setup.config;
  if (m.config.method == "explicit") m.method = Impl::Method::explicit_mild;
  if (m.config.method == "geometric") m.method = Impl::Method::geometric;
  m.features = build_features(setup, at);
  for (int b = 0; b < m.features.bodies; ++b) {
    const std::vector<int>& own = m.features.surfaces[b].vertices;
    m.body_vertices.insert(m.body_vertices.end(), own.begin(), own.end());
  }
  m.layer = setup.config.layer;
  if (m.layer == 0) {
    m.layer = std::min(0.05 * m.features.smallest_edge, 1e-3 * setup.thinnest);
    const BodiesAtStart bodies = look_at_bodies(m.layer, setup, m.features, at);
    if (m.method == Impl::Method::implicit && !setup.soft && m.features.bodies_meet() && !bodies.in_one_pack) m.layer *= kWhereBodiesComeTogether;
    if (bodies.clearance > 0 && kOfClearance * bodies.clearance < m.layer) {
      m.layer = kOfClearance * bodies.clearance;
      m.warnings.push_back("two bodies stand " + three_digits(bodies.clearance) + " m apart: contact acts from a fifth of that on, contact.layer " + three_digits(m.layer) + " m; where the gap itself matters give a smaller one");
    }
  }
  m.thickest = m.layer;
  m.ceiling = std::max(m.layer, 0.05 * m.features.smallest_edge);
  m.modulus = setup.config.stiffness > 0 ? setup.config.stiffness : setup.softest_modulus;
  m.push_speed = setup.config.push_speed > 0 ? setup.config.push_speed : std::min(0.1, 1e-3 * setup.wave_speed);
  for (const ContactSurface& body : setup.bodies) m.body_names.push_back(body.name);
  for (const ContactSurface& tool : setup.tools) {
    m.tools.is_plane.push_back(tool.plane);
    m.tools.point.push_back(tool.point);
    m.tools.normal.push_back(tool.normal);
    m.tools.names.push_back(tool.name);
  }
  for (const Features::Relation& relation : m.features.relations)
    if (relation.meet && relation.friction > 0) m.slip.assign(at.size(), 0.0);
  m.shear_limit = ShearLimit(m.features, setup.axisymmetric);
  m.sticking.emplace(m.features);
  m.both = m.features.bodies_meet() ? 2 : 1;
  if (m.method == Impl::Method::implicit && m.config.swing == "damped" && !m.slip.empty()) {
    std::vector<WaveBody> bodies;
    bool any = false;
    for (const ContactSurface& body : setup.bodies) {
      bodies.push_back(body.waves);
      any = any || body.waves.impedance > 0;
    }
    if (any) m.waves = ShearWaves(bodies, at.size(), rigid_modes(setup.dimension, setup.axisymmetric));
  }
  NodeField x = at, place;
  m.tools.place_all(m.features, at_start, place);
  m.ties = find_ties(setup, x, place, m.tools.is_plane, m.tools.planes(at_start), m.features);
  m.body_shifts = part_bodies(m.layer, setup, m.features, x, m.warnings);
  const Sides sides = find_sides(m.layer, m.features, x, at_start);
  m.sides = sides.of_facet;
  m.flush = Flush(m.layer, m.features, sides.of_facet, x, at_start);
  set_back(kOutside * m.layer, sides, m.flush, setup, m.features, m.tools, m.warnings);
  check_start(m.layer, m.sides, m.flush, setup, x, at_start, m.features, m.tools, m.warnings);
  m.tools.place_all(m.features, at_start, place);  // set back
  find_level_parts(m.features);
  m.flush.mark(at_start, m.features);
  keep_ties(m.features, x, place, at_start, m.ties);
  if (m.method == Impl::Method::geometric) m.know_sides();
  m.tool_index = std::make_unique<ToolIndex>(m.features, m.features.place, std::vector<bool>(setup.tools.size(), true));
}
Contact::~Contact() = default;
Contact::Contact(Contact&&) noexcept = default;
Contact& Contact::operator=(Contact&&) noexcept = default;

void Contact::set_masses(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held) {
  impl_->inverse_mass = inverse_mass;
  impl_->held = held;
  impl_->held_of.assign(inverse_mass.size(), -1);
  for (size_t i = 0; i < held.size(); ++i) impl_->held_of[held[i].node] = static_cast<int>(i);
  impl_->waves.hold(inverse_mass, held);
  impl_->listed = false;
}

const ContactStep& Contact::advance(double time, double dt, NodeField& x, NodeField& v, NodeField& v_before, const Predict& predict, const Move& move, const ToolsAt& tools_at, double full_dt, double damping) {
  Impl& m = *impl_;
  m.damping = damping;
  v_before.resize(x.size());
  m.step.begin(m.tools.names.size());
  switch (m.method) {
    case Impl::Method::implicit: m.advance_implicit(time, dt, std::max(dt, full_dt), x, v, v_before, predict, move, tools_at); break;
    case Impl::Method::explicit_mild: m.advance_explicit(time, dt, x, v, v_before, predict, move, tools_at); break;
    case Impl::Method::geometric: m.advance_geometric(dt, x, v, v_before, predict, move, tools_at); break;
  }
  m.previous_dt = m.step.dt;
  tools_at(m.step.dt, m.previous_motion);
  return m.step;
}

void Contact::Impl::end(double dt, const Move& move, NodeField& x, NodeField& v, NodeField& v_star) {
  if (!near.pairs.empty() || !tie_pairs.empty())
    for (int i = 0; i < work.body_entries; ++i) v_star[work.vertex[i]] = work.v[i];
  for (size_t i = 0; i < work.mean.size(); ++i) work.mean[i] = 0.5 * (work.before[i] + work.v[i]);
  v.swap(v_star);
  move(dt, v, x);
}

void Contact::Impl::follow_steady_motion(double dt, const NodeField& x, const NodeField& before, const NodeField& v) {
  if (!waves.any()) return;
  const auto rubs = [](const ContactPair& pair) { return pair.rub >= 0 && pair.impulse != 0; };
  place_pressed.assign(work.body_entries, -1);
  for (const ContactPair& pair : near.pairs)
    if (rubs(pair)) work.each_of_bodies(pair, [&](int i, double) { place_pressed[i] = 0; });
  pressed.clear();
  for (int i = 0; i < work.body_entries; ++i) {
    if (place_pressed[i] < 0) continue;
    place_pressed[i] = static_cast<int>(pressed.size());
    pressed.push_back({work.vertex[i], features.area[work.vertex[i]]});
  }
  for (const ContactPair& pair : near.pairs) {
    if (!rubs(pair)) continue;
    const int tool = pair.tool(features.bodies);
    const bool by_tool = tool >= 0 && !motion[tool].goes_freely();
    double speed_before = 0, speed = 0;
    if (by_tool) {
      Node foot = Node::Zero();
      for (int k = 0; k < pair.nodes; ++k)
        if (pair.node[k] >= work.body_entries) foot += std::abs(pair.weight[k]) * work.x[pair.node[k]];
      // Of the tool as a whole at this place: a drum that turns steadily has the same at both times, though not the same of its points is there.
      const ToolMotion& now = motion[tool];
      const Vec3 x = vec3(foot), n = vec3(pair.normal);
      speed = n.dot(pose1(now, now.rotation0.transpose() * (x - now.position0)) - x) / dt;
      for (int k = 0; k < ToolMotion::kFreedoms; ++k)  // an axle: what it turns by was found since
        if (step.tool_push[tool][k] != 0) speed += step.tool_push[tool][k] * n.dot(now.freedom[k].along(x));
      speed_before = speed;
      if (previous_dt > 0) {
        const ToolMotion& last = previous_motion[tool];
        speed_before = n.dot(pose0(now, last.rotation0.transpose() * (x - last.position0)) - x) / previous_dt;
      }
    }
    work.each_of_bodies(pair, [&](int i, double b) {
      RubbedNode& rubbed = pressed[place_pressed[i]];
      rubbed.normal += b * pair.impulse * pair.normal;
      rubbed.radiated += b / part_that_leaves(near.rubs[pair.rub].friction) * near.rubs[pair.rub].radiated;
      if (!by_tool) return;
      rubbed.by_tools += b * pair.impulse * pair.normal;
      rubbed.told_before += b * pair.impulse * speed_before;
      rubbed.told += b * pair.impulse * speed;
    });
  }
  delay.follow(work, near.pairs, near.rubs, x.size(), waves);
  waves.follow(team, dt, previous_dt > 0 ? previous_dt : dt, x, before, v, pressed);
}

Books Contact::Impl::open_books() {
  add_slip(step.dt);
  Books books = empty_books(step);
  for (const TiePair& tie : tie_pairs) books.add(tie);
  return books;
}

long Contact::count_crossings(const NodeField& x, const std::vector<ToolMotion>& tools) const {
  const Impl& m = *impl_;
  NodeField place;
  m.tools.place_all(m.features, tools, place);
  return static_cast<long>(find_crossings(m.features, x, place, ToolSet::present(tools), m.tools.is_plane, m.tools.planes(tools)).size());
}

int Contact::passed_through_itself(int body, const NodeField& x) const {
  const Features& features = impl_->features;
  return features.relation(body, body).meet ? -1 : crossing_with_itself(features, body, x);
}

void Contact::add_normal_impulses(std::vector<double>& sum) const {
  for (const ContactPair& pair : impl_->near.pairs)
    for (int k = 0; k < pair.nodes; ++k)
      if (pair.node[k] < impl_->work.body_entries) sum[impl_->work.vertex[pair.node[k]]] += std::abs(pair.weight[k]) * pair.impulse;
  for (const TiePair& pair : impl_->tie_pairs) {
    const double impulse = dot3(pair.impulse, pair.press);
    for (int k = 0; k < pair.nodes; ++k)
      if (pair.node[k] < impl_->work.body_entries) sum[impl_->work.vertex[pair.node[k]]] += std::abs(pair.weight[k]) * impulse;
  }
}

std::vector<Contact::ActedOn> Contact::acted_on(const std::vector<char>& tools) const {
  const Impl& m = *impl_;
  const int bodies = m.features.bodies;
  std::vector<char> act(tools.size(), 0);
  for (const ContactPair& pair : m.near.pairs)
    if (const int tool = pair.tool(bodies); tool >= 0 && pair.impulse > 0) act[tool] = 1;
  std::vector<ActedOn> of(m.features.area.size());
  const auto see = [&](const auto& link, int tool, bool acts, const Node& impulse) {
    const bool asked = tool >= 0 && tools[tool] && (act[tool] || acts);
    for (int k = 0; k < link.nodes; ++k) {
      if (link.node[k] >= m.work.body_entries) continue;
      const int n = m.work.vertex[link.node[k]];
      ActedOn& on = of[n];
      on.node = n;
      on.asked = on.asked || asked;
      on.others = on.others || (acts && !asked);
      if (asked) on.impulse += on_node(link, k, impulse);
    }
  };
  for (const ContactPair& pair : m.near.pairs) see(pair, pair.tool(bodies), pair.impulse > 0, m.impulse_of(pair));
  for (const TiePair& tie : m.tie_pairs) see(tie, tie.tool, true, tie.impulse);
  of.erase(std::remove_if(of.begin(), of.end(), [](const ActedOn& on) { return !on.asked && !on.others; }), of.end());
  return of;
}

std::set<std::pair<int, int>> Contact::bodies_that_hold_each_other() const {
  const Features& f = impl_->features;
  std::set<std::pair<int, int>> all;
  const auto hold = [&](int a, int b) {
    if (a != b && std::max(a, b) < f.bodies) all.emplace(std::min(a, b), std::max(a, b));
  };
  for (int a = 0; a < f.bodies; ++a)
    for (int b = a + 1; b < f.bodies; ++b)
      if (f.relation(a, b).tie >= 0) hold(a, b);
  for (const ContactPair& pair : impl_->near.pairs)
    if (pair.impulse > 0) hold(pair.own, pair.surface);
  return all;
}

std::vector<int> Contact::tools_on(int body) const {
  const Features& f = impl_->features;
  std::set<int> found;
  for (const ContactPair& pair : impl_->near.pairs)
    if (const int tool = pair.tool(f.bodies); tool >= 0 && pair.impulse > 0 && std::min(pair.own, pair.surface) == body) found.insert(tool);
  for (const TiePair& tie : impl_->tie_pairs)
    if (tie.tool >= 0)
      for (int k = 0; k < tie.nodes; ++k)
        if (const int n = tie.node[k]; n < impl_->work.body_entries && f.vertex_surface[impl_->work.vertex[n]] == body) found.insert(tie.tool);
  return {found.begin(), found.end()};
}

std::vector<Contact::PressedInside> Contact::pressed_inside() const {
  constexpr double kAtNode = 0.9;  // of the weights
  const Workspace& work = impl_->work;
  std::vector<PressedInside> found;
  for (const ContactPair& pair : impl_->near.pairs) {
    PressedInside press;
    press.tool = pair.tool(impl_->features.bodies);
    if (press.tool < 0 || !(pair.impulse > 0)) continue;
    std::size_t k = 0;
    double side = 1;
    work.each_of_bodies(pair, [&](int entry, double b) {
      press.nodes[k] = work.vertex[entry];
      press.weights[k++] = std::abs(b);
      side = b;
    });
    if (k < 2 || *std::max_element(press.weights.begin(), press.weights.end()) > kAtNode) continue;
    press.impulse = std::copysign(pair.impulse, side) * vec3(pair.normal);
    found.push_back(press);
  }
  return found;
}

bool Contact::ties() const { return !impl_->ties.empty(); }

void Contact::add_held_impulses(std::vector<Vec3>& sum) const {
  const Workspace& work = impl_->work;
  const auto add = [&](const auto& link, const Node& impulse) {
    for (int k = 0; k < link.nodes; ++k) {
      const int n = link.node[k];
      if (n >= work.body_entries || !work.projector[n]) continue;
      const Node j = on_node(link, k, impulse);
      sum[impl_->held_of[work.vertex[n]]] += vec3(j - project(*work.projector[n], j));
    }
  };
  for (const TiePair& tie : impl_->tie_pairs) add(tie, tie.impulse);
  for (const ContactPair& pair : impl_->near.pairs) {
    if (pair.impulse != 0) add(pair, impl_->impulse_of(pair));
  }
}

const std::vector<double>& Contact::nodal_area() const { return impl_->features.area; }
double Contact::layer() const { return impl_->layer; }
double Contact::stiffness() const { return impl_->modulus; }
double Contact::push_speed() const { return impl_->push_speed; }
long Contact::listed_pairs() const { return impl_->list.size(); }
long Contact::list_builds() const { return impl_->builds; }
std::vector<SurfacePair> Contact::surface_pairs() const {
  const Features& f = impl_->features;
  std::vector<std::string> names = impl_->body_names;
  names.insert(names.end(), impl_->tools.names.begin(), impl_->tools.names.end());
  std::vector<SurfacePair> all;
  for (int a = 0; a < f.bodies; ++a)
    for (int b = a; b < static_cast<int>(names.size()); ++b) {
      const Features::Relation& relation = f.relation(a, b);
      if (relation.meet || relation.tie >= 0) all.push_back({names[a], names[b], relation.friction, relation.friction_limit, relation.tie >= 0});
    }
  return all;
}
void Contact::time_parts(ContactTimes* times) { impl_->times = times; }
bool Contact::touches_at_start(int tool) const { return impl_->tools.touching[tool]; }
const std::vector<Vec3>& Contact::body_shifts() const { return impl_->body_shifts; }
const std::vector<std::string>& Contact::warnings() const { return impl_->warnings; }

namespace {
constexpr std::uint64_t kMagic = 0x41746361746e6f43u;  // "ContactA"
struct SavedHeader {
  std::uint64_t magic, vertices, facets, records, drags, tools, slip, steady, delayed, parted;
  double potential, previous_dt;

  std::size_t size() const;
};
static_assert(std::is_trivially_copyable<PairRecord>::value && std::is_trivially_copyable<Drag>::value, "saved byte by byte");

/// Position and rotation of a tool as twelve numbers.
constexpr std::size_t kPose = 12;

std::size_t SavedHeader::size() const {
  return sizeof *this + records * sizeof(PairRecord) + drags * sizeof(Drag) + (tools * kPose + slip + steady + delayed) * sizeof(double) + parted;
}

template <class Items> void append(const Items& items, std::vector<char>& data) {
  const char* first = reinterpret_cast<const char*>(items.data());
  data.insert(data.end(), first, first + items.size() * sizeof(typename Items::value_type));
}
template <class Items> void take(std::size_t count, const char*& from, Items& items) {
  const std::size_t bytes = count * sizeof(typename Items::value_type);
  items.resize(count);
  if (count > 0) std::memcpy(static_cast<void*>(items.data()), from, bytes);
  from += bytes;
}
}  // namespace

std::vector<char> Contact::save() const {
  const Impl& m = *impl_;
  const std::vector<double> steady = m.waves.save();
  const SavedHeader header{kMagic, static_cast<std::uint64_t>(m.features.vertex_count), m.features.facets.size(), m.records.pairs.size(), m.records.drags.size(), m.previous_motion.size(), m.slip.size(), steady.size(), m.delay.delayed().size(), m.parted.size(), m.potential, m.previous_dt};
  std::vector<double> poses;
  for (const ToolMotion& tool : m.previous_motion) {
    poses.insert(poses.end(), tool.position0.data(), tool.position0.data() + 3);
    poses.insert(poses.end(), tool.rotation0.data(), tool.rotation0.data() + 9);
  }
  std::vector<char> data;
  data.reserve(header.size());
  append(std::vector<SavedHeader>{header}, data);
  append(m.records.pairs, data);
  append(m.records.drags, data);
  append(poses, data);
  append(m.slip, data);
  append(steady, data);
  append(m.delay.delayed(), data);
  append(m.parted, data);
  return data;
}

void Contact::restore(const std::vector<char>& data) {
  Impl& m = *impl_;
  SavedHeader header;
  const bool whole = data.size() >= sizeof header && (std::memcpy(&header, data.data(), sizeof header), header.magic == kMagic) && data.size() == header.size() &&
                     (header.drags == 0 || header.drags == header.records);
  if (!whole) throw Error(Code::resume_error, "the saved contact is damaged or of another version");
  if (header.vertices != static_cast<std::uint64_t>(m.features.vertex_count) || header.facets != m.features.facets.size() || header.slip != m.slip.size())
    throw Error(Code::resume_error, "the saved contact has other surfaces than this scene: resume with the scene that was saved");
  const char* from = data.data() + sizeof header;
  take(header.records, from, m.records.pairs);
  take(header.drags, from, m.records.drags);
  m.thickest = m.layer;
  for (const PairRecord& record : m.records.pairs) m.thickest = std::max(m.thickest, record.layer);
  std::vector<double> poses;
  take(header.tools * kPose, from, poses);
  m.previous_motion.assign(header.tools, ToolMotion());
  for (std::size_t t = 0; t < header.tools; ++t) {
    m.previous_motion[t].position0 = Eigen::Map<const Vec3>(&poses[t * kPose]);
    m.previous_motion[t].rotation0 = Eigen::Map<const Mat3>(&poses[t * kPose + 3]);
  }
  take(header.slip, from, m.slip);
  std::vector<double> steady;
  take(header.steady, from, steady);
  m.waves.restore(steady);
  take(header.delayed, from, m.delay.delayed());
  take(header.parted, from, m.parted);
  m.potential = header.potential;
  m.previous_dt = header.previous_dt;
  m.listed = false;
}

}  // namespace forming_sim
