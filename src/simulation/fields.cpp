// What a Simulation shows of itself.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "forming_sim/simulation/body_of_element.h"
#include "simulation/impl.h"

namespace forming_sim {

std::vector<GroupPlan> Simulation::groups() const { return impl_->elements.plan(); }
std::vector<SurfacePair> Simulation::surface_pairs() const { return impl_->contact ? impl_->contact->surface_pairs() : std::vector<SurfacePair>(); }
const Model& Simulation::model() const { return impl_->model; }
const RunPlan& Simulation::plan() const { return impl_->plan; }
const std::vector<std::array<int, 4>>& Simulation::elements() const { return impl_->elements.simplices(); }
const std::vector<Facet>& Simulation::surface() const { return impl_->surface; }
const std::vector<double>& Simulation::nodal_mass() const { return impl_->elements.nodal_mass(); }
double Simulation::time() const { return impl_->time; }
long Simulation::steps() const { return impl_->steps; }
double Simulation::dt() const { return impl_->dt; }
int Simulation::stage() const { return impl_->stages.index(); }
double Simulation::began(const std::string& since) const { return impl_->stages.began(since); }
double Simulation::progress() const { return impl_->stages.progress(impl_->time); }
bool Simulation::quiet() const { return impl_->stages.settling() && impl_->settle.is_quiet(); }
double Simulation::wall_time() const { return impl_->wall; }
double Simulation::observed_time() const { return impl_->observed; }
const NodeField& Simulation::initial_positions() const { return impl_->X; }
const NodeField& Simulation::positions() const { return impl_->x; }
const NodeField& Simulation::velocities() const { return impl_->v; }
double Simulation::first_dt() const { return impl_->first_dt; }
const std::vector<ToolStatus>& Simulation::tools() const { return impl_->tools; }
std::vector<Contact::PressedInside> Simulation::pressed_inside() const { return impl_->contact ? impl_->contact->pressed_inside() : std::vector<Contact::PressedInside>(); }
std::vector<int> Simulation::tools_on(int body) const { return impl_->contact ? impl_->contact->tools_on(body) : std::vector<int>(); }
bool Simulation::once_held(int node) const { return std::binary_search(impl_->once_held.begin(), impl_->once_held.end(), node); }
void Simulation::keep_reactions(const std::vector<int>& nodes) {
  Impl& s = *impl_;
  s.kept.assign(s.once_held.size(), false);
  for (int node : nodes) {
    const auto place = std::lower_bound(s.once_held.begin(), s.once_held.end(), node);
    if (place != s.once_held.end() && *place == node) s.kept[place - s.once_held.begin()] = true;
  }
  s.choose_booked();
}
int Simulation::reactions_kept() const { return static_cast<int>(std::count(impl_->kept.begin(), impl_->kept.end(), true)); }
Reaction Simulation::reaction(const std::vector<int>& nodes) const {
  Reaction sum;
  for (int node : nodes) {
    const auto place = std::lower_bound(impl_->once_held.begin(), impl_->once_held.end(), node);
    if (place == impl_->once_held.end() || *place != node) continue;
    Reaction one = impl_->reactions[place - impl_->once_held.begin()];
    if (impl_->model.axisymmetric && impl_->X[node][0] == 0) one.impulse.x() = 0;  // of the axis itself
    sum += one;
  }
  return impl_->model.axisymmetric ? around_circle(sum) : sum;
}
const std::vector<std::string>& Simulation::warnings() const { return impl_->warnings; }

namespace {
StepLimit described(StepLimit limit, const Model& model) {
  if (limit.node >= 0)
    for (const BodyModel& body : model.bodies)
      if (limit.node < body.first_node + body.node_count) {
        limit.reason = "node " + std::to_string(limit.node) + " of body " + body.name;
        break;
      }
  if (limit.element >= 0) limit.reason = "element " + std::to_string(limit.element) + " of body " + body_of_element(model, limit.element).name;
  return limit;
}
}  // namespace

StepLimit Simulation::step_limit() const { return described(impl_->limit, impl_->model); }
StepLimit Simulation::smallest_step() const { return described(impl_->smallest, impl_->model); }
const AddedMass& Simulation::added_mass() const { return impl_->added; }
StepLimitCost Simulation::step_limit_cost() const {
  const Impl& s = *impl_;
  return {s.global.estimates, s.global.products, s.steps > 0 ? static_cast<double>(s.longer_steps) / static_cast<double>(s.steps) : 0};
}

// The leapfrog keeps 1/2 v.(M - dt^2/4 K) v + U at the middle of a step, not 1/2 v.M v + U: of a swing of frequency omega the kinetic
// energy is less by (omega dt/2)^2, next to nothing of a slow one, .8 of the fastest that a mesh bears at a safety of .9. So the
// kinetic energy of every swing is on the mean its elastic one, as it should, and what the ledger is open by was really made or lost.
//   dt^2/4 v.K v = U(x - dt v) + U(x) - 2 U(x - dt v/2)
const Energies& Simulation::energies() const {
  constexpr double kRounding = 1e-12;  // of the three sums over the mesh: at rest it is all there is
  const Impl& s = *impl_;
  if (s.energies_step == s.steps) return s.energies;
  const bool moved = s.steps > 0;
  NodeField at(s.x.size());
  using Numbers = Eigen::Matrix4Xd;
  const auto nodes = static_cast<Eigen::Index>(s.x.size());
  const Eigen::Map<const Numbers> x(s.x.data()->data(), 4, nodes), v(s.v.data()->data(), 4, nodes);
  Eigen::Map<Numbers> before_end(at.data()->data(), 4, nodes);
  const auto stored_after = [&](double part) {  // of the last step, at whose start memories were kept
    before_end = x - (1 - part) * s.dt * v;
    return s.elements.stored_energy(at, &s.v, part * s.dt);
  };
  Energies& e = s.energies;
  e.elastic = moved ? stored_after(0.5) : s.elements.stored_energy(s.x);
  e.kinetic = s.kinetic();
  if (moved) {
    const double less = 0.5 * (stored_after(0) + stored_after(1)) - e.elastic;
    if (std::isfinite(less)) e.kinetic -= less;  // else x lies where the next step will fail
    if (e.kinetic < 0 && -e.kinetic < kRounding * e.elastic) e.kinetic = 0;
  }
  e.plastic = s.elements.plastic_work();
  e.contact = s.contact_potential + s.contact_dissipated;
  e.friction = s.friction;
  e.viscosity = s.elements.viscous_work();
  e.settling = s.settled_away;
  e.damping = s.damping + e.viscosity;
  e.work = s.work;
  e.initial = s.initial;
  s.energies_step = s.steps;
  return e;
}

// What positions cannot tell: the energy of a strain of 1e-11, and far from the origin of what rounding of the places is for the smallest cell, c dt high, a thousand times:
// it gathers over the steps. mass: scaled as that of which c is, so that mass c^2 is E V whatever the scaling.
double Simulation::Impl::least_energy(double mass) const {
  const double c = elements.slowest_wave();
  const double rounding = 0.5 * std::numeric_limits<double>::epsilon() * farthest / (c * first_element_dt), strain = 1e-11 + 1e3 * rounding;
  return strain * strain * mass * c * c;
}

// Where nothing happens there is no other energy to refer to.
double Simulation::balance_error() const {
  const Impl& s = *impl_;
  return std::fabs(energies().residual()) / std::max(s.most, s.least_energy(s.mass_of_bodies()));
}

ContactStatus Simulation::contact_status() const {
  const Impl& s = *impl_;
  ContactStatus c;
  c.halvings = s.halvings;
  c.sweeps = s.sweeps;
  c.swept_steps = s.swept_steps;
  c.unsettled_steps = s.unsettled_steps;
  c.crossings = s.crossings;
  c.min_gap_over_layer = s.min_gap;
  c.active_pairs = s.active_pairs;
  c.explicit_stable_dt = s.explicit_stable_dt;
  if (s.contact) {
    c.layer = s.contact->layer();
    c.listed_pairs = s.contact->listed_pairs();
  }
  return c;
}

FormedMemory Simulation::memory_of(const BodyModel& body) const {
  FormedMemory memory = impl_->elements.memory_of(body, impl_->x);
  memory.reference = body.reference();
  if (!body.material.damage) return memory;
  const std::vector<double> damage = this->damage();
  const double* of_element = &damage[body.first_element];
  for (std::size_t k = 0; k < memory.cells.size(); ++k) {
    const Cells& cells = body.mesh.cells[k];
    const int simplices = shape_of(cells.kind).simplices;
    for (int cell = 0; cell < cells.count(); ++cell, of_element += simplices)
      memory.cells[k].damage.insert(memory.cells[k].damage.end(), of_element, of_element + memory.cells[k].points);
  }
  return memory;
}
std::vector<double> Simulation::damage() const {
  const Impl& s = *impl_;
  if (!s.damage.any()) return {};
  if (s.damage_step != s.steps) s.damage_now = s.damage.at(plastic_strain(), stress());
  s.damage_step = s.steps;
  return s.damage_now;
}
std::vector<double> Simulation::plastic_strain() const { return impl_->elements.plastic_strain(); }
std::vector<Sym> Simulation::stress(const std::vector<int>& elements) const { return impl_->elements.stress_of(elements, impl_->x, impl_->previous_dt); }
std::vector<int> Simulation::pressed_cells() const { return impl_->elements.pressed_cells(impl_->x); }
ElementFields Simulation::element_fields() const { return impl_->elements.observe(impl_->x, impl_->previous_dt); }
std::vector<Sym> Simulation::stress() const { return element_fields().stress; }
std::vector<double> Simulation::volume_ratio() const { return element_fields().volume_ratio; }

std::vector<double> Simulation::contact_pressure() const {
  const Impl& s = *impl_;
  std::vector<double> pressure(s.x.size(), 0.0);
  if (!s.pressed) return pressure;
  constexpr double kTouches = 1e-3;  // of the largest force on a face: what is less than that has left
  const auto touches = [&](const Face& face) {
    double least = std::numeric_limits<double>::max(), most = 0;
    for (int n : face) {
      const double force = std::abs(s.contact_force[n]);
      least = std::min(least, force), most = std::max(most, force);
    }
    return least > kTouches * most;
  };
  // Every node's share of the area vectors of its faces: of those that touch with all their nodes, and of all.
  std::vector<Vec3> touching(s.x.size(), Vec3::Zero()), all = touching;
  const auto each_share = [&](auto&& work) {
    for (const Face& face : s.faces) {
      if (std::none_of(face.begin(), face.end(), [&](int n) { return s.contact_force[n] != 0; })) continue;
      const bool whole = touches(face);
      for (int k = 0; k < face.corners; ++k) work(face.nodes[k], whole, area_share(face, k, s.x, s.model.axisymmetric));
    }
  };
  each_share([&](int n, bool whole, const Vec3& share) {
    all[n] += share;
    if (whole) touching[n] += share;
  });
  std::vector<double> area(s.x.size(), 0.0);
  each_share([&](int n, bool whole, const Vec3& share) {
    const Vec3& towards = touching[n].isZero(0) ? all[n] : touching[n];
    if (whole || share.dot(towards) > 0.5 * share.norm() * towards.norm()) area[n] += share.norm();
  });
  for (int n : s.touchable)
    if (area[n] > 0) pressure[n] = s.contact_force[n] / area[n];
  return pressure;
}

std::vector<double> Simulation::contact_gap() const {
  const Impl& s = *impl_;
  return s.contact ? s.contact->gaps(s.x, s.tools_now()) : std::vector<double>();
}

const std::vector<double>& Simulation::contact_slip() const {
  static const std::vector<double> none;
  return impl_->contact ? impl_->contact->slip() : none;
}

std::vector<SurfaceStrain> Simulation::surface_strain() const {
  const Impl& s = *impl_;
  std::vector<SurfaceStrain> strain;
  strain.reserve(s.surface.size());
  for (const Facet& facet : s.surface) {
    std::array<Vec3, 3> X, x;
    for (int k = 0; k < s.model.dimension; ++k) X[k] = vec3(s.reference[facet.nodes[k]]), x[k] = vec3(s.x[facet.nodes[k]]);
    strain.push_back(s.model.dimension == 2 ? strain_of_segment(X, x, s.model.axisymmetric) : strain_of_triangle(X, x));
  }
  return strain;
}

}  // namespace forming_sim
