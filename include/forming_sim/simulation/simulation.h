#pragma once
// A run: the model, its state, the plan of stages and the time loop.
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/contact/contact.h"
#include "forming_sim/element/elements.h"
#include "forming_sim/simulation/model.h"
#include "forming_sim/mesh/surface_strain.h"
#include "forming_sim/simulation/observer.h"
#include "forming_sim/simulation/plan.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {


/// How a run ended.
struct Outcome {
  Code code = Code::none;
  std::string message;
};

class Simulation {
 public:
  /// Builds the state of a scene at its start.
  /// Throws Error (mesh_error, initial_penetration).
  /// threads: 1 or more; results do not depend on it.
  Simulation(const RunPlan& plan, Model model, int threads);
  ~Simulation();

  /// Observers are called in the order of their adding; not owned.
  void add(Observer& observer);

  /// Runs to the end of the last stage, a cancel or an error; never throws for
  /// what happens inside the run: it is in the outcome, told to the observers.
  /// `cancel` is polled every step.
  Outcome run(const std::atomic<bool>& cancel);
  /// One step, for tests and drivers. False when the plan has ended.
  bool step();

  // ---- what does not change
  const Model& model() const;
  const RunPlan& plan() const;
  const std::vector<std::array<int, 4>>& elements() const;  ///< simplices of the joined mesh
  const std::vector<Facet>& surface() const;                ///< of the joined mesh, joined numbering
  const std::vector<double>& nodal_mass() const;            ///< kg (kg/m), scaled

  std::vector<GroupPlan> groups() const;                    ///< of cells: what each is and owns
  std::vector<SurfacePair> surface_pairs() const;                    ///< surfaces that can meet; none: there is no contact

  // ---- state
  double time() const;
  long steps() const;
  double dt() const;                 ///< of the last step; before the first, of that to come
  double began(const std::string& since) const;  ///< s, when what has this `since` began; infinity: it has not
  int stage() const;                 ///< index of the running stage; number of stages at the end
  double progress() const;           ///< 0..1, by simulated time; a settle stage counts by its limit
  bool quiet() const;                ///< a settle stage runs and has nearly done: its bodies rest if they stay as they are
  double wall_time() const;          ///< s spent stepping and checking, observers excluded
  double observed_time() const;      ///< s that observers and the change of stages took between the steps
  const NodeField& initial_positions() const;
  const NodeField& positions() const;
  const NodeField& velocities() const;   ///< at the half step before time()
  StepLimit step_limit() const;
  double first_dt() const;
  StepLimit smallest_step() const;
  const AddedMass& added_mass() const;
  StepLimitCost step_limit_cost() const;
  /// The ledger at the half step before time(), where every term of it is known to
  /// second order, but for the work of bulk viscosity over the last kick, which the forces of the next step book;
  /// evaluated when asked, at the cost of about one pass over the elements.
  const Energies& energies() const;
  double balance_error() const;      ///< |residual| now over the largest of what was put in so far (work + initial, and what contact has given if it gave), and no less than the energy of a strain of 1e-11, far from the origin of what rounding of the places makes
  ContactStatus contact_status() const;
  const std::vector<ToolStatus>& tools() const;
  std::vector<Contact::PressedInside> pressed_inside() const;  ///< where edges and corners of tools pressed on the inside of faces in the last step
  std::vector<int> tools_on(int body) const;  ///< that pressed on it in the last step, or whose ties to it act
  /// Sum over those of the nodes that boundaries hold or drive, or have, and that keep_reactions() names; axisymmetric: what goes along the axis.
  Reaction reaction(const std::vector<int>& nodes) const;
  /// The reactions of these nodes alone are kept from now on: those that nobody asks for cost time in every step. Before it is called, all are.
  void keep_reactions(const std::vector<int>& nodes);
  int reactions_kept() const;        ///< of so many nodes
  bool once_held(int node) const;    ///< a boundary holds or drives it, in part or in all directions, or has
  const std::vector<std::string>& warnings() const;  ///< "tool die was backed off by 1.2e-6 m"

  // ---- fields per element, computed when asked
  std::vector<double> plastic_strain() const;
  std::vector<double> damage() const;      ///< material/damage.h; NaN of bodies without, empty where none has it
  std::vector<int> pressed_cells() const;  ///< an element of each one-point cell that is kept from turning inside out at a corner (element/corner_guard.h)
  ElementFields element_fields() const;         ///< the two below at the cost of one
  std::vector<Sym> stress() const;              ///< Cauchy, Pa
  std::vector<Sym> stress(const std::vector<int>& elements) const;  ///< of these alone, in their order
  std::vector<double> volume_ratio() const;     ///< V / V0
  /// Of each surface facet (same order as surface()), since it was free of stress: the stretch of the facet itself, hence on the surface; also of those in planes of symmetry.
  std::vector<SurfaceStrain> surface_strain() const;

  /// Normal contact pressure on the surface per node, Pa: the force, a running mean as the tool forces are, over what the node has now
  /// of its faces that touch with all their nodes and of those within 60 degrees of these; where none does, of the mean of all.
  /// 0 inside, below 0 where a tie pulls.
  std::vector<double> contact_pressure() const;
  /// Per node, m, as Contact::gaps and Contact::slip have them; empty where nothing can meet, or rub.
  /// The gaps are searched at every call.
  std::vector<double> contact_gap() const;
  const std::vector<double>& contact_slip() const;

  /// What the elements of a body remember, for a next run.
  FormedMemory memory_of(const BodyModel& body) const;

  // ---- checkpoint: every number that the next steps depend on
  std::vector<char> save() const;
  /// Throws Error(resume_error) when the data is not of this model.
  void restore(const std::vector<char>& data);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace forming_sim
