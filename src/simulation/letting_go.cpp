// What lets go of a body: tools that leave while they press on it, boundaries that end. Taken away in one step their forces would send
// a wave through the body, which makes it flow anew where it was about to. So they stay on its nodes: supports in the place of tools recede
// until they squeeze it no more, and what then holds it fades.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/simulation/stage_times.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {
constexpr double kCantilever = 6.2;  ///< 2 pi sqrt(12)/1.875^2: period of the first swing of a beam held at one end, over L^2/(t c)
constexpr double kRoom = 0.25;       ///< of the time until the bodies have to rest or are formed on: for more of it nothing fades
constexpr double kBeforeTools = 0.05;  ///< of a stage in which tools move away, by .1 % of their way until then: what boundaries held is balanced by what the tools bear, and goes before they do
constexpr double kSqueezed = 0.1;    ///< of the forces of tools that are let go: less that balances itself does not squeeze
constexpr double kNext = 0.01;       ///< to nothing, of the energy that a squeezed body had: what is left to fade may do as much in any case
constexpr double kMoving = 0.3;      ///< of the forces that are let go: more than this sets the body in motion as a whole
constexpr double kSwings = 0.9;      ///< of the moments of what is let go: with less of them beside a swing what is at rest is worth keeping

/// Size squared, m2, of what swings, however it lies: of a box the squares of its lengths together, which are 12 times the second moments of its
/// volume about its middle. A sheet is held by a plane of symmetry at one end; a compact body goes on beyond one that ends it on one side, where its moments are about that plane.
double swinging_size_squared(const BodyModel& body) {
  constexpr double kAlong = 0.99;  // cosine
  const Mesh& mesh = body.mesh;
  const int corners = mesh.dimension + 1;
  double V = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();  // of a simplex V/((D + 1)(D + 2)) (sum_a x_a x_a + sum_a x_a sum_b x_b)
  for (const std::array<int, 4>& simplex : mesh.simplices()) {
    const double v = signed_volume(mesh.nodes, simplex, mesh.dimension);
    Vec3 sum = Vec3::Zero();
    Mat3 products = Mat3::Zero();
    for (int a = 0; a < corners; ++a) {
      const Vec3 x = mesh.nodes[simplex[a]] - mesh.nodes.front();
      sum += x;
      products += x * x.transpose();
    }
    V += v;
    first += v / corners * sum;
    second += v / (corners * (corners + 1)) * (products + sum * sum.transpose());
  }
  const Vec3 middle = first / V;
  double moments = second.trace() / V - middle.squaredNorm();
  if (is_sheet(mesh, body.thickness)) return 12 * moments;
  struct Plane {
    Vec3 normal;
    double away;  ///< of the middle, m
    bool both = false;  ///< it ends on the other side too
  };
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < body.cut.size(); ++i) {
    if (!body.cut[i]) continue;
    const Facet& facet = mesh.surface[i];
    const Vec3 normal = area_vector(mesh, facet).normalized();
    const auto known = std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return std::abs(plane.normal.dot(normal)) > kAlong; });
    if (known != planes.end()) known->both = known->both || known->normal.dot(normal) < 0;
    else planes.push_back({normal, normal.dot(mesh.nodes[facet.nodes[0]] - mesh.nodes.front() - middle)});
  }
  for (const Plane& plane : planes)
    if (!plane.both) moments += plane.away * plane.away;
  return 12 * moments;
}

/// Projector of the directions along which a body goes on beyond no plane of symmetry, nor round an axis.
Mat3 alone(const BodyModel& body, bool axisymmetric) {
  constexpr double kOther = 0.2;  // of a normal, across those before it
  Mat3 P = Mat3::Identity();
  const auto take_out = [&P](const Vec3& normal) {
    const Vec3 beyond = P * normal;
    if (beyond.norm() > kOther) P -= beyond.normalized() * beyond.normalized().transpose();
  };
  if (axisymmetric) take_out(Vec3::UnitX());
  for (std::size_t i = 0; i < body.cut.size(); ++i)
    if (body.cut[i]) take_out(area_vector(body.mesh, body.mesh.surface[i]).normalized());
  return P;
}

bool any(const std::vector<char>& of) { return std::find(of.begin(), of.end(), 1) != of.end(); }

/// Of the stages from the one at `begin` to the next settle stage, and at most until the next form stage begins, s.
double time_to_rest(const std::vector<StageConfig>& stages, int begin) {
  std::vector<StageConfig> until;
  for (int k = begin; k < static_cast<int>(stages.size()); ++k) {
    if (k > begin && stages[k].kind == "form") break;
    until.push_back(stages[k]);
    if (stages[k].kind == "settle") break;
  }
  return longest_time(until);
}
}  // namespace

Simulation::Impl::Together Simulation::Impl::together() const {
  Together found(model.bodies.size());
  for (std::size_t b = 0; b < found.size(); ++b) found[b] = {static_cast<int>(b)};
  if (!contact) return found;
  for (const auto& [a, b] : contact->bodies_that_hold_each_other()) {
    if (std::find(found[a].begin(), found[a].end(), b) != found[a].end()) continue;
    std::vector<int> all = found[a];
    all.insert(all.end(), found[b].begin(), found[b].end());
    for (int body : all) found[body] = all;
  }
  return found;
}

double Simulation::Impl::stored_in(const std::vector<int>& bodies) const {
  double sum = 0;
  for (int b : bodies) sum += elements.stored_energy_of(model.bodies[b], x);
  return sum;
}

double Simulation::Impl::slowness(const BodyModel& body) const {
  const double speed = std::sqrt(body.material.E() / body.material.density / plan.time_step.mass_scaling);
  return swinging_size_squared(body) / (body.thickness * speed);
}

bool Simulation::Impl::lets_go_slowly() const {
  const StageConfig& stage = stages.stage();
  if (stage.release == "sudden") return false;
  return stage.release_time > 0 || std::any_of(model.bodies.begin(), model.bodies.end(), [](const BodyModel& body) { return body.material.yields(); });  // what is elastic ends where it would anyhow
}

std::vector<char> Simulation::Impl::borne_by_leaving_tools() const {
  std::vector<char> borne(model.bodies.size(), 0);
  const StageConfig& stage = stages.stage();
  if (!contact || stage.kind != "withdraw" || stage.displacement.isZero(0)) return borne;
  std::vector<char> leaving;
  for (int k = 0; k < static_cast<int>(model.tools.size()); ++k) leaving.push_back(stages.leaves(stage, k));
  for (const Contact::ActedOn& on : contact->acted_on(leaving)) {
    if (on.impulse.isZero(0)) continue;
    for (std::size_t b = 0; b < borne.size(); ++b)
      if (on.node >= model.bodies[b].first_node && on.node < model.bodies[b].first_node + model.bodies[b].node_count) borne[b] = 1;
  }
  return borne;
}

double Simulation::Impl::release_time(double slowest, bool balanced) const {
  const StageConfig& stage = stages.stage();
  if (stage.release_time > 0) return stage.release_time;
  const double time = std::min(kCantilever * slowest, kRoom * time_to_rest(plan.stages, stages.index()));
  return balanced ? std::min(time, kBeforeTools * stage.duration) : time;
}

// What holds a node of a body at rest balances all other forces on it, f: so it is -f where tools pressed, and along the directions in
// which a boundary lets go. Where something else acts on the node as well it is what the tools did in the last step.
void Simulation::Impl::let_go(const BoundarySet& held_before, const std::vector<Vec3>& impulses_on_held, bool boundaries_ended) {
  if (!any(stages.left()) && !boundaries_ended) return;
  if (!lets_go_slowly()) return;
  NodeField f(x.size());
  sum_nodes(elements.node_team(), forces(), f);
  NodeField held_by(x.size(), Node::Zero());
  const Together with = together();
  std::vector<char> pressed_by_others(x.size(), 0);
  const auto is_free = [&](std::size_t b) {
    const int begin = model.bodies[b].first_node, end = begin + model.bodies[b].node_count;
    const auto held = std::lower_bound(boundaries.nodes().begin(), boundaries.nodes().end(), begin);
    const auto others = pressed_by_others.begin();
    return (held == boundaries.nodes().end() || *held >= end) && std::find(others + begin, others + end, 1) == others + end && with[b].size() == 1;
  };
  const auto free_part = [](const BoundarySet& set, int n, const Node& force) -> Node {
    const auto found = std::lower_bound(set.nodes().begin(), set.nodes().end(), n);
    if (found == set.nodes().end() || *found != n) return force;
    return node(Vec3(set.projector(static_cast<int>(found - set.nodes().begin())) * vec3(force)));
  };
  if (boundaries_ended)
    for (std::size_t k = 0; k < impulses_on_held.size(); ++k) {
      const int n = held_before.nodes()[k];
      const Node all = f[n] + node(Vec3(impulses_on_held[k] / previous_kick));
      held_by[n] = free_part(boundaries, n, Node(free_part(held_before, n, all) - all));
    }
  std::vector<char> pressed_on(x.size(), 0);
  std::vector<double> pressed_area(x.size(), 0);  // m2
  if (contact) {
    for (int n : touchable) pressed_on[n] = std::abs(contact_force[n]) > least_press() * contact->nodal_area()[n];
    for (const Contact::ActedOn& on : contact->acted_on(stages.left())) {
      const int n = on.node;
      pressed_on[n] = pressed_on[n] || on.others;
      pressed_by_others[n] = on.others;
      if (!on.asked || !pressed_on[n]) continue;
      held_by[n] = free_part(boundaries, n, on.others ? Node(on.impulse / previous_kick) : Node(-f[n]));
      pressed_area[n] = contact->nodal_area()[n];
    }
  }
  std::map<int, std::vector<Vec3>> around;  // of nodes that are pressed, the areas of the faces there
  for (const Face& face : faces)
    for (int k = 0; k < face.corners; ++k)
      if (pressed_area[face.nodes[k]] > 0) around[face.nodes[k]].push_back(area_share(face, k, x, model.axisymmetric));
  std::vector<std::vector<Held>> forces_on(model.bodies.size());
  double slowest = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const int end = body.first_node + body.node_count;
    double held = 0, held_moment = 0;
    Vec3 middle = Vec3::Zero();  // of what holds
    for (int n = body.first_node; n < end; ++n) {
      held += held_by[n].norm();
      middle += held_by[n].norm() * vec3(x[n]);
    }
    if (held > 0) middle /= held;
    Vec3 moving = Vec3::Zero(), turning = Vec3::Zero();  // what accelerates nodes that nothing presses on, all together, and its moment
    for (int n = body.first_node; n < end; ++n) {
      const Vec3 arm = vec3(x[n]) - middle;
      held_moment += arm.cross(vec3(held_by[n])).norm();
      if (pressed_on[n]) continue;
      const Vec3 free = vec3(free_part(held_before, n, f[n]));
      moving += free;
      turning += arm.cross(free);
    }
    // It flies or gathers speed: there is no rest that could be kept.
    if (moving.norm() > kMoving * held) continue;
    // Nothing holds it any more, and what did held a swing and nothing else.
    if (is_free(b) && turning.norm() > kSwings * held_moment) continue;
    std::vector<Held>& forces = forces_on[b];
    for (int n = body.first_node; n < end; ++n) {
      if (held_by[n].isZero(0)) continue;
      const std::vector<Vec3> parts = pressed_area[n] > 0 ? parts_by_face(vec3(held_by[n]), around[n]) : std::vector<Vec3>{vec3(held_by[n])};
      for (const Vec3& part : parts) forces.push_back({{n, node(part)}, pressed_area[n] / parts.size(), 1. / parts.size()});
    }
    if (!forces.empty()) slowest = std::max(slowest, slowness(body));
  }
  const std::vector<char> borne = borne_by_leaving_tools();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const std::vector<Held>& forces = forces_on[b];
    if (forces.empty()) continue;
    const long of_tools = std::count_if(forces.begin(), forces.end(), [](const Held& held) { return held.area > 0; });
    const double duration = release_time(slowest, of_tools == 0 && borne[b]);
    const bool by_itself = of_tools > 0 || stages.stage().release_time > 0;  // and not with what lets go of these bodies already
    if (!by_itself && supports.join(with[b], x, forces)) continue;
    if (const double squeeze = RecedingSupports::squeeze(forces, alone(body, model.axisymmetric)); squeeze > kSqueezed) {
      supports.begin({static_cast<int>(b), with[b], body.thickness, body.material.E(), elements.stored_energy_of(body, x), time, duration}, squeeze, std::max(previous_dt, full_dt()), elements.nodal_mass(), x, forces);
    } else {
      std::vector<HoldingForce> to_fade;
      for (const Held& held : forces) to_fade.push_back(held.by);
      const double stored = stored_in(with[b]);
      if (by_itself || !fading.join(with[b], stored, to_fade)) fading.begin(time, duration, with[b], stored, std::move(to_fade));
    }
  }
}

void Simulation::Impl::go_on_letting_go() {
  fading.forget(time);
  for (RecedingSupports::Receded& receded : supports.take(time))
    if (!receded.forces.empty())
      fading.begin(time, receded.of.fade, receded.of.together, std::max(stored_in(receded.of.together), kNext * receded.of.stored), std::move(receded.forces));
}

}  // namespace forming_sim
