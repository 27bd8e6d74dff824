// What lets go of a body: tools that leave while they press on it, boundaries that end. Taken away in one step their forces would send
// a wave through the body, which makes it flow anew where it was about to. So they stay as forces on its nodes, and fade.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/simulation/stage_times.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {
constexpr double kCantilever = 6.2;  ///< 2 pi sqrt(12)/1.875^2: period of the first swing of a beam held at one end, over L^2/(t c)
constexpr double kRoom = 0.25;       ///< of the time until the bodies have to rest or are formed on: for more of it nothing fades
constexpr double kMoving = 0.3;      ///< of the forces that are let go: more than this sets the body in motion as a whole

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
/// The projector on the directions in which no node of the body is held; a ring cannot go outward as a whole.
Mat3 free_ways(const BoundarySet& held, const BodyModel& body, bool axisymmetric) {
  Mat3 all = Mat3::Zero();
  if (axisymmetric) all(0, 0) = 1;
  for (std::size_t i = 0; i < held.nodes().size(); ++i)
    if (held.nodes()[i] >= body.first_node && held.nodes()[i] < body.first_node + body.node_count) all += Mat3::Identity() - held.projector(static_cast<int>(i));
  const Eigen::SelfAdjointEigenSolver<Mat3> directions(all);
  Mat3 free = Mat3::Zero();
  for (int k = 0; k < 3; ++k)
    if (directions.eigenvalues()[k] < 1e-9) free += directions.eigenvectors().col(k) * directions.eigenvectors().col(k).transpose();
  return free;
}
}  // namespace

double Simulation::Impl::slowness() const {
  double slowest = 0;
  for (const BodyModel& body : model.bodies) {
    const double size = bounds(body.mesh).diagonal().norm(), speed = std::sqrt(body.material.E() / body.material.density / plan.time_step.mass_scaling);
    slowest = std::max(slowest, size * size / (thickness_of(body.mesh, model.axisymmetric) * speed));
  }
  return slowest;
}

double Simulation::Impl::release_time() const {
  const StageConfig& stage = stages.stage();
  if (stage.release == "sudden") return 0;
  if (stage.release_time > 0) return stage.release_time;
  const auto flows = [](const BodyModel& body) { return body.material.hardening || !body.material.layers.empty(); };
  if (std::none_of(model.bodies.begin(), model.bodies.end(), flows)) return 0;  // what is elastic ends where it would anyhow
  return std::min(kCantilever * slowness(), kRoom * time_to_rest(plan.stages, stages.index()));
}

// What holds a node of a body at rest balances all other forces on it, f: so it is -f where tools pressed, and along the directions in
// which a boundary lets go. Where something else acts on the node as well it is what the tools did in the last step.
void Simulation::Impl::let_go(const BoundarySet& held_before, bool boundaries_ended) {
  if (!any(stages.left()) && !boundaries_ended) return;
  const double duration = release_time();
  if (duration == 0) return;
  NodeField f(x.size());
  sum_nodes(elements.team(), forces(), f);
  NodeField held_by(x.size(), Node::Zero());
  const auto free_part = [](const BoundarySet& set, int n, const Node& force) -> Node {
    const auto found = std::lower_bound(set.nodes().begin(), set.nodes().end(), n);
    if (found == set.nodes().end() || *found != n) return force;
    return node(Vec3(set.projector(static_cast<int>(found - set.nodes().begin())) * vec3(force)));
  };
  if (boundaries_ended)
    for (int n : held_before.nodes()) held_by[n] = free_part(held_before, n, f[n]) - free_part(boundaries, n, f[n]);
  std::vector<char> on_surface(x.size(), 0), pressed_on(x.size(), 0);
  if (contact) {
    for (int n : touchable) pressed_on[n] = std::abs(contact_force[n]) > least_press() * contact->nodal_area()[n];
    for (const Contact::ActedOn& on : contact->acted_on(stages.left())) {
      const int n = on.node;
      pressed_on[n] = pressed_on[n] || on.others;
      if (!on.asked || !pressed_on[n]) continue;
      held_by[n] = free_part(boundaries, n, on.others ? Node(on.impulse / previous_kick) : Node(-f[n]));
      on_surface[n] = 1;
    }
  }
  for (const BodyModel& body : model.bodies) {
    Node moving = Node::Zero();  // what accelerates nodes that nothing presses on, all together
    double held = 0;
    const int end = body.first_node + body.node_count;
    for (int n = body.first_node; n < end; ++n) {
      held += held_by[n].norm();
      if (!pressed_on[n]) moving += free_part(held_before, n, f[n]);
    }
    if (moving.norm() > kMoving * held) continue;  // it flies, or gathers speed: there is no rest that could be kept
    std::vector<HoldingForce> forces;
    for (int n = body.first_node; n < end; ++n)
      if (!held_by[n].isZero(0)) forces.push_back({n, on_surface[n] != 0, held_by[n]});
    if (forces.empty()) continue;
    const auto mass = elements.nodal_mass().begin();
    fading.begin(time, duration, elements.stored_energy_of(body, x), {body.first_node, body.node_count, std::accumulate(mass + body.first_node, mass + end, 0.0), free_ways(boundaries, body, model.axisymmetric)}, std::move(forces), faces, x);
  }
}

}  // namespace forming_sim
