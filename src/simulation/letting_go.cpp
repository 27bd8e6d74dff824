// What lets go of a body: tools that leave while they press on it, boundaries that end. Taken away in one step their forces would send
// a wave through the body, which makes it flow anew where it was about to. So they stay as forces on its nodes, and fade.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forming_sim/scene/stage_times.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {
constexpr double kCantilever = 6.2;  ///< 2 pi sqrt(12)/1.875^2: period of the first swing of a beam held at one end, over L^2/(t c)
constexpr double kRoom = 0.25;       ///< of the time until the bodies have to rest: for more of it nothing fades

bool any(const std::vector<char>& of) { return std::find(of.begin(), of.end(), 1) != of.end(); }
}  // namespace

double Simulation::Impl::slowness() const {
  double size = 0, thin = 1e300, speed = 1e300;
  for (const BodyModel& body : model.bodies) {
    Eigen::AlignedBox3d box;
    for (const Vec3& X_i : body.mesh.nodes) box.extend(X_i);
    size = std::max(size, box.diagonal().norm());
    thin = std::min(thin, thickness_of(body, model.axisymmetric));
    speed = std::min(speed, std::sqrt(body.material.E() / body.material.density / plan.time_step.mass_scaling));
  }
  return size * size / (thin * speed);
}

double Simulation::Impl::release_time() const {
  const StageConfig& stage = stages.stage();
  if (stage.release == "sudden") return 0;
  if (stage.release_time > 0) return stage.release_time;
  const auto begin = plan.stages.begin() + stages.index();
  auto end = std::find_if(begin, plan.stages.end(), [](const StageConfig& s) { return s.kind == "settle"; });
  if (end != plan.stages.end()) ++end;
  return std::min(kCantilever * slowness(), kRoom * longest_time({begin, end}));
}

// What held a node is what balanced all other forces on it, f: so -f where tools pressed, and along the directions in which a boundary
// lets go. What else presses on a node or holds it goes on doing so, and its part is unknown: such nodes are let go at once.
void Simulation::Impl::let_go(const BoundarySet& held_before) {
  if (!any(stages.left()) && held_before.nodes() == boundaries.nodes()) return;
  const double duration = release_time();
  if (duration == 0) return;
  NodeField f(x.size());
  sum_nodes(elements.team(), forces(), f);
  NodeField held_by(x.size(), Node::Zero());
  const auto free_part = [&](const BoundarySet& set, int n) -> Node {
    const auto found = std::lower_bound(set.nodes().begin(), set.nodes().end(), n);
    if (found == set.nodes().end() || *found != n) return f[n];
    return node(Vec3(set.projector(static_cast<int>(found - set.nodes().begin())) * vec3(f[n])));
  };
  for (int n : held_before.nodes()) held_by[n] = free_part(held_before, n) - free_part(boundaries, n);
  if (contact && pressed)
    for (int n : contact->touched_by(stages.left()))
      if (std::abs(contact_force[n]) > least_press() * contact->nodal_area()[n]) held_by[n] = -free_part(boundaries, n);
  std::vector<int> nodes;
  std::vector<Node> forces;
  for (std::size_t n = 0; n < x.size(); ++n)
    if (!held_by[n].isZero(0)) {
      nodes.push_back(static_cast<int>(n));
      forces.push_back(held_by[n]);
    }
  if (!nodes.empty()) fading.begin(time, duration, std::move(nodes), std::move(forces));
}

}  // namespace forming_sim
