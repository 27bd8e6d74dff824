#pragma once
// What a Simulation holds: its state, its running sums and the parts of a step.
#include <optional>
#include <vector>

#include "forming_sim/contact/contact.h"
#include "forming_sim/element/nodes.h"
#include "forming_sim/loads/boundary.h"
#include "forming_sim/loads/dead_load.h"
#include "forming_sim/loads/fading_forces.h"
#include "forming_sim/loads/pressure.h"
#include "forming_sim/loads/receding_supports.h"
#include "forming_sim/simulation/settle.h"
#include "forming_sim/simulation/simulation.h"
#include "forming_sim/simulation/steady_step.h"
#include "simulation/damage.h"
#include "simulation/departure.h"
#include "simulation/global_limit.h"
#include "simulation/stages.h"
#include "simulation/step_control.h"

namespace forming_sim {

struct Simulation::Impl {
  RunPlan plan;
  Model model;
  NodeField X;                      ///< initial positions
  NodeField reference;              ///< where the elements were free of stress: X, but of formed parts
  NodeField x, v, v_before;         ///< v at the half step
  NodeField external;               ///< pressure, dead loads, gravity and what holds on fading at x, N; empty where there is none
  Elements elements;
  Damage damage;
  std::vector<Facet> surface;       ///< joined
  std::vector<Face> faces;          ///< likewise
  std::vector<double> physical_mass;
  std::vector<ResolvedBoundary> all_boundaries;
  BoundarySet boundaries;           ///< that hold in the running stage
  std::vector<std::size_t> holding;  ///< which of all do
  std::vector<int> once_held;       ///< nodes that a boundary holds or has held, increasing
  std::vector<Reaction> reactions;  ///< of once_held, since the start
  std::vector<char> kept;           ///< of once_held: its reaction is asked for
  struct Booked { int held, once; };
  std::vector<Booked> booked;       ///< places in boundaries.nodes() and once_held of those that are driven or asked for, once -1: not asked
  bool any_kept = false;            ///< of those
  bool takes_hold = false;          ///< a boundary has begun since the last step: it stops what it holds, or sets it in motion, and does work by that
  std::vector<Vec3> held_impulse;   ///< of contact on boundaries.nodes() along what holds them, in a step, N s
  PressureSet pressures;
  DeadLoadSet dead_loads;
  RecedingSupports supports;        ///< in the place of tools that have let go
  FadingForces fading;              ///< of what has let go
  StageRunner stages;
  std::optional<Contact> contact;
  std::vector<double> contact_force, node_impulse;     ///< per node, normal: running mean, N; of a step, N s
  std::vector<int> touchable;                          ///< nodes that contact can press on
  bool pressed = false;                                ///< some contact pressure is not zero
  std::vector<ToolStatus> tools;
  std::vector<std::string> warnings;
  bool ledger_told = false;
  std::vector<Observer*> observers;

  double time = 0, dt = 0, previous_dt = 0, previous_kick = 0;
  long steps = 0;
  StepControl control;
  SteadyStep steady;
  GlobalLimit global;
  Departure departure;              ///< watched where a step may come near the true limit
  CellRates rates;                  ///< when the stable step was last asked for
  StepLimit limit, smallest;
  AddedMass added;
  std::vector<RestingBody> resting_bodies;
  long resting = 1;                 ///< nodes that the last kick left at rest; 1 before the first, which looks for them
  long longer_steps = 0;            ///< than time_step.limit node allows
  double first_dt = 0;
  double first_element_dt = 0;  ///< stable step of the limiting element at the start, s
  double farthest = 0;          ///< coordinate of a node at the start, m
  Settle settle;                    ///< of the running stage
  std::string unsettled;            ///< why the last settle stage that was to rest and ran into its limit did; empty: none has
  Ways ways, tool_ways;             ///< of the bodies and of the tools in the running settle stage
  bool rests = false;               ///< a settling body has come to rest
  double wall = 0, observed = 0;  ///< s

  // the ledger's running sums, J
  double work = 0, damping = 0, settled_away = 0, friction = 0, contact_dissipated = 0, contact_potential = 0, initial = 0, most = 0;
  long halvings = 0, sweeps = 0, swept_steps = 0, unsettled_steps = 0;
  double min_gap = 1;
  double explicit_stable_dt = 0;
  std::size_t told_at_start = 0;    ///< of the warnings
  bool overstepped = false;         ///< a step was longer than the explicit contact is stable, and it has been told
  bool fall_told = false;           ///< a tool that a force drives had lost what it pressed on
  long active_pairs = 0;
  long crossings = 0;
  double next_crossing_check = 0;

  mutable std::vector<double> damage_now;  ///< of the step damage_step
  mutable long damage_step = -1;
  mutable Energies energies;
  mutable long energies_step = -1;

  Impl(const RunPlan& plan, Model model, int threads);

  // setup.cpp
  void set_up_loads();
  void set_up_contact();
  /// Warns where a press is over within some ways of a wave of shear through the thickness.
  void tell_quick_press();
  /// Those of all boundaries that hold in a stage.
  std::vector<std::size_t> holding_in(int stage) const;
  void hold(std::vector<std::size_t> those);
  /// Leaves those boundaries that hold in the running stage. True where some have ended.
  bool change_boundaries();
  /// Pressures and loads act from the beginning of their stages on.
  void begin_loads();
  void tell_contact_what_is_held();
  /// Which of the held nodes book_reactions() looks at.
  void choose_booked();
  /// Gives those that a force drives a mass, those that turn freely an inertia, where the scene says none. Throws SceneError for one too light.
  void give_tools_inertia();
  /// Where the tools stand, and where they will after a step of this dt; what moves as it is pushed, where it would without contact.
  void tool_motions(double step_dt, std::vector<ToolMotion>& motions) const;
  std::vector<ToolMotion> tools_now() const;
  void place_tools();

  // step_limit.cpp
  /// dt of the coming step: what the mesh bears, the user's limit, the stage's end.
  void choose_dt();
  RestingBody resting_body(const BodyModel& body) const;
  std::pair<double, int> spring_dt() const;  ///< longest step that the springs of tools bear, s, and whose is the stiffest
  double full_dt() const;           ///< what the coming step could be at most, whatever the steps before it were
  void find_stable_step();
  /// The step is the fastest cell's own: neither nodes nor the whole mesh bound it.
  bool by_cells() const { return plan.time_step.limit == "element" && plan.time_step.raise_to == 0; }
  /// Gives mass to the nodes around which the step is below time_step.raise_to. Throws SceneError.
  void raise_step();
  [[noreturn]] void collapse(double stable, int element) const;

  // step.cpp
  /// Of the elements and the loads at x.
  NodalForces forces() const;
  /// (dt_previous + dt)/2 f/m with damping.
  Kick kick_of(double step_dt) const;
  /// v* = v + kick, with prescribed motion.
  void predict(double step_dt, NodeField& v_star);
  void find_loads();
  void take_step();
  void book(const ContactStep& done);
  /// kick: time in which its impulses act as forces do, s.
  void mean_contact_force(double kick);
  double least_press() const { return 1e-12 * contact->stiffness(); }  ///< Pa: no pressure is less
  /// Work of prescribed motion, of `external` and of damping over the kick.
  void book_loads();
  void tell_fall(int tool);
  void tell_landing(int tool);
  void book_reactions(double kick);
  double mass_of_bodies() const;    ///< scaled, kg
  double kinetic() const;
  /// What the first kick takes from the elastic energy that formed parts bear at the start, J.
  double first_kick_energy() const;
  /// Mass-proportional damping now, 1/s.
  double damping_rate() const;

  // settling.cpp
  /// How fast each body swings, and the damping for it.
  void watch_settling();
  /// What moves a tool as it is pushed. mover: the number of the tool, along its guide; with that of all tools added, about its axle. Null: nothing.
  const Drive* drive_of(int mover) const;
  /// Tools that press on the bodies settle with them. Null: this one does not.
  const Drive* settling_drive(int mover) const;
  /// In a settle stage tools that settle have its damping too.
  void slow_tools();
  /// A motion, a pressure or a load is on its way from one knot to another; in the last stage also where that is still to come in it.
  bool driven_on() const;
  /// Likewise, where the stage waits for it, and does not end at its limit.
  bool still_driven() const;
  /// Of the running stage, which has come to its limit.
  std::string why_unsettled() const;
  /// A body that goes as a whole with a kinetic energy of at least that, J, in words; empty: none does.
  std::string what_flies(double least) const;
  /// As a settle stage begins: a body that flies off, not falls, with more than a little of the energy is brought to rest by it.
  void tell_flight(const Energies& energies);
  std::string what_moves() const;  ///< a tool or a set that is driven on, in words; empty: none
  /// Whether the bodies rest.
  void see_rest();

  // letting_go.cpp
  /// L^2/(t c) of a body, c the speed of a wave along a bar, s: about the period of the slowest swing of a free strip.
  double slowness(const BodyModel& body) const;
  /// Whether what lets go at the beginning of the running stage fades, or is gone at once.
  bool lets_go_slowly() const;
  /// The time in which it fades, s; slowest: slowness of the bodies that are let go; balanced: what boundaries held is, by tools that move away in this stage.
  double release_time(double slowest, bool balanced) const;
  std::vector<char> borne_by_leaving_tools() const;  ///< of every body: a tool that moves away in this stage presses on it
  using Together = std::vector<std::vector<int>>;
  Together together() const;  ///< of every body those that it hangs together with, tied or pressed on each other, itself among them
  double stored_in(const std::vector<int>& bodies) const;  ///< elastic energy, J
  /// Keeps what held the bodies until the running stage began, and no longer does, by supports that recede and forces that fade; held_before: the boundaries until then, of which some may have ended.
  void let_go(const BoundarySet& held_before, const std::vector<Vec3>& impulses_on_held, bool boundaries_ended);
  void go_on_letting_go();  ///< what supports that have receded still bear begins to fade
  /// When what has let go is no more, s; 0: nothing has.
  double let_go_until() const { return std::max(supports.end(), fading.end()); }

  // simulation.cpp
  void begin_stage();
  /// True when the running stage has come to its end.
  bool stage_over();
  void check_crossings();
  void check_passages();  ///< of bodies through themselves
  /// Warns, once, of energies that do not add up at the end of a stage; residual, J, and error: of Simulation.
  void check_ledger(double residual, double error);
  /// Warns where the running stage, which ends, was to end when a tool stops, and that has not.
  void tell_unstopped();
  double least_energy(double mass) const;  ///< of bodies of so much mass, J

  // checkpoint.cpp
  template <class Archive> void exchange(Archive& a);
};

}  // namespace forming_sim
