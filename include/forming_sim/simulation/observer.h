#pragma once
// Observers watch a run; none changes a number of it.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class Simulation;

/// The energy ledger, J (J per metre of width in plane strain).
/// kinetic + elastic + contact + plastic + friction + damping = work + initial.
struct Energies {
  double kinetic = 0;   ///< of the leapfrog: 1/2 v.(M - dt^2/4 K) v
  double elastic = 0;
  double plastic = 0;   ///< dissipated by plastic flow
  double contact = 0;   ///< potential of the mild layer plus what its implicit step dissipated, less what layers that grow (soft start) have pushed
  double friction = 0;  ///< dissipated by Coulomb friction
  double damping = 0;   ///< dissipated by viscosity, damping and settling
  double viscosity = 0; ///< the part of damping that bulk viscosity took
  double settling = 0;  ///< the part of damping that the settle stage took
  double work = 0;      ///< of tools, prescribed motion, pressure, dead loads, gravity and what holds on fading when tools and boundaries let go
  double initial = 0;   ///< kinetic + elastic at the start, as the leapfrog has it: of a formed part that is let go at rest less by dt^2/8 f.M^-1 f
  double residual() const { return kinetic + elastic + contact + plastic + friction + damping - work - initial; }
};

/// What holds or drives nodes, or touches a tool, has pushed with so far (per metre of width in plane strain).
struct Reaction {
  Vec3 impulse = Vec3::Zero();  ///< N s
  Vec3 angular = Vec3::Zero();  ///< about the origin, N m s
  double radial = 0;            ///< axisymmetric: outward, summed around the circle, where `impulse` has nothing radial and `angular` is 0; N s

  Reaction& operator+=(const Reaction& more) {
    impulse += more.impulse;
    angular += more.angular;
    radial += more.radial;
    return *this;
  }
};

/// Of a section what the whole circle feels: what is radial cancels, and so do the moments.
inline Reaction around_circle(const Reaction& section) { return {Vec3(0, section.impulse.y(), 0), Vec3::Zero(), section.impulse.x()}; }

/// What limits the time step.
struct StepLimit {
  double dt = 0;          ///< s, safety included
  int element = -1;       ///< simplex that limits it, -1: none (a node, the whole mesh or maximum)
  int node = -1;          ///< node that limits it, likewise
  std::string reason;     ///< "element 17 of body sheet", "node 12 of body sheet", "the whole mesh", "time_step.maximum"
};

/// What time_step.raise_to has added to the masses.
struct AddedMass {
  std::vector<double> bodies;  ///< kg (kg/m in plane strain); empty: raise_to was not given
  double total = 0;            ///< kg
  double fraction = 0;         ///< of the mass of all bodies before
  int node = -1;               ///< that has got most, -1: none got any
  double most = 0;             ///< kg on it
};

/// What the step cost: the runs that look for the fastest swing of the mesh (time_step.limit global).
struct StepLimitCost {
  long estimates = 0, products = 0;  ///< a product costs one evaluation of the forces
  double share = 0;                  ///< of the steps, those that were longer than time_step.limit node allows
};

struct ContactStatus {
  long halvings = 0;      ///< steps halved by the continuous check so far
  long sweeps = 0;        ///< contact.method implicit: in all steps so far
  long swept_steps = 0;   ///< with any
  long unsettled_steps = 0;  ///< that ended at contact.max_sweeps, with forces that still changed
  long crossings = 0;     ///< found by the independent check of all pairs, 200 times in a run and at the end of each stage; must be 0
  double min_gap_over_layer = 1;  ///< smallest gap / h0 so far; 1 where nothing ever touched
  double layer = 0;       ///< h0, m
  long active_pairs = 0, listed_pairs = 0;
  double explicit_stable_dt = 0;  ///< contact.method explicit: smallest step so far up to which its layer was stable, s; 0: it never was in use
};

/// Where a rigid tool stands and what it feels.
struct ToolStatus {
  Vec3 position = Vec3::Zero();            ///< of the tool's frame, m
  Mat3 rotation = Mat3::Identity();        ///< tool frame to world
  Vec3 velocity = Vec3::Zero();
  double turned = std::numeric_limits<double>::quiet_NaN();  ///< about its axle, rad; NaN: it has none
  Vec3 way = Vec3::Zero();                 ///< direction in which its centre of rotation moves, or last moved; 0: it has not moved
  Vec3 force = Vec3::Zero();               ///< on the tool by the bodies, running mean over about 50 steps; N (N/m in plane strain); axisymmetric: along the axis
  Vec3 moment = Vec3::Zero();              ///< about `position`
  double radial_force = 0;                 ///< axisymmetric: likewise outward, summed around the circle, N: what bursts a ring or clamps a punch
  Reaction felt;                           ///< of all contact so far: differences give the mean force of an interval
  Vec3 peak_force = Vec3::Zero();          ///< `force` of greatest magnitude so far
  Vec3 peak_moment = Vec3::Zero();         ///< `moment` of greatest magnitude so far
  double most_against = 0;                 ///< greatest against() so far, N
  double peak_radial_force = 0;
  bool touched = false;                    ///< a body at the start, or contact has acted on it, in whatever direction
  long landings = 0;                       ///< of one that a force drives: how often it has lifted off and come back
  double first_landing = 0;                ///< when it first did, s
  bool pressed = false;                    ///< in the last step too
  bool present = true;                     ///< false once withdrawn
  std::optional<double> stopped;           ///< when it stopped under the force that its motion was to stop under, s

  /// What a press has to bring up, N (N/m in plane strain): the force against its way; all of it where its centre has not moved.
  double against() const { return way.isZero(0) ? force.norm() : -force.dot(way); }
};

class Observer {
 public:
  virtual ~Observer() = default;
  /// Before the first step (also after a resume).
  virtual void on_start(const Simulation&) {}
  /// After every step: decide cheaply whether anything is to be done.
  virtual void on_step(const Simulation&) {}
  /// When stage `index` has just ended.
  virtual void on_stage_end(const Simulation&, int /*index*/) {}
  /// At the end, whatever it was: success, cancel, error.
  virtual void on_end(const Simulation&, Code, const std::string& /*message*/) {}
};

}  // namespace forming_sim
