#pragma once
// All elements of a model: their memory, their forces on the nodes, their time
// step. Results do not depend on the number of threads: a node adds up the forces
// of its cells in a fixed order.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/element/cell_group.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/element/body.h"
#include "forming_sim/element/nodal_forces.h"
#include "forming_sim/element/node_team.h"
#include "forming_sim/element/step_bounds.h"
#include "forming_sim/element/step_times.h"
#include "forming_sim/element/stillness.h"
#include "forming_sim/parallel/team.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

using Sym = Eigen::Matrix<double, 6, 1>;  ///< xx yy zz xy yz zx

struct ElementFields {
  std::vector<Sym> stress;             ///< Cauchy, Pa
  std::vector<double> volume_ratio;    ///< V / V0
};

/// Cells of one body and kind, and what they own.
struct GroupPlan {
  std::string body;
  CellKind kind;
  PressureMode pressure;
  int layers = 1;            ///< of the law
  long cells = 0, elements = 0;
  long edge_points = 0;      ///< points of the law at the edges (element/edge_points.h), 0 where the elements have it
  double memory_bytes = 0;   ///< state of the law, of all elements; of one-point cells and edge points their constants too
  double state_bytes = 0;    ///< the part of it that plastic flow writes
  double force_bytes = 0;    ///< sums of the cells' forces, one a node of each tile (element/cell_group.h)
  double pressure_bytes = 0; ///< with pressures in the nodes: what the volumes of the nodes ask for besides, numbers of nodes and sums
  double index_bytes = 0;    ///< which nodes the cells have, in which slot of a tile they add to them, and which slots a node has
};

struct ElementOptions {
  double mass_scaling = 1;
  double linear_viscosity = 0, quadratic_viscosity = 0;
  bool shares = false;        ///< keep what each cell has of its nodes' masses: sum_rates()
  bool axisymmetric = false;  ///< the section of dimension 2 is turned about the y axis: x is the radius, volumes, masses and forces are those of the whole circle
};

class Elements {
 public:
  /// x: initial positions in the joined numbering; the memory starts there, free of stress, but of bodies with BodyModel::formed:
  /// x holds the places that it names as their reference, and they go on from what it remembers.
  /// kernels: see choose_isa. Throws Error(mesh_error) for a volume that is not positive,
  /// and for a node of an axisymmetric body with x < 0.
  Elements(const std::vector<BodyModel>& bodies, int dimension, const NodeField& x, const ElementOptions& options, int threads,
           const char* kernels = nullptr);
  ~Elements();

  const std::vector<std::array<int, 4>>& simplices() const { return simplices_; }
  const std::vector<double>& nodal_mass() const { return mass_; }  ///< kg, scaled
  std::vector<GroupPlan> plan() const;
  /// From now on the stages of every call are booked there; null: no more. Not owned.
  void time_stages(StepTimes* times) { times_ = times; }

  /// Internal forces at x (N) of the cells, for nodal_forces(); updates the memory of what yields.
  /// v: the velocities that led to x in last_dt (0: nothing has moved yet), for Law::classical, plastic rates
  /// and bulk viscosity; last_kick: the time in which the forces of the last call acted to give v, and for which
  /// the work of their viscosity is booked now. Throws Error(mesh_error)
  /// naming an element whose volume is not positive or not a number, or a node that has
  /// crossed the axis.
  void find_forces(const NodeField& x, const NodeField& v, double last_dt, double last_kick);
  /// What the cells found last, as the nodes have it; until forces are found again.
  NodalForces nodal_forces() const { return {dimension_, slot_start_.data(), slot_index_.data(), slots_, nullptr}; }
  /// Throws Error(mesh_error) as find_forces() does, for positions that it does not come to: those of the end of a run.
  void check_upright(const NodeField& x) const;
  /// Both: f = internal forces at x.
  void forces(const NodeField& x, const NodeField& v, double last_dt, double last_kick, NodeField& f);
  /// Stable time step at x, without a safety factor: dt and the simplex' cell.
  void stable_step(const NodeField& x, const NodeField& v, double& dt, int& element) const;
  /// In the last force pass a corner of a one-point cell was so far in the range of its guard that every step asks for its limit.
  bool corners_pressed() const;
  /// The cells of which that is so, at x where that pass was or behind it: an element of each.
  std::vector<int> pressed_cells(const NodeField& x) const;

  // element/step_bounds.h
  void find_rates(const NodeField& x, const NodeField& v, CellRates& rates) const;
  CellLimit slowest_cell(const CellRates& rates, const BodyModel* of = nullptr) const;  ///< of one body; null: of all
  /// Sums over the cells at each node; only with ElementOptions::shares.
  NodalRates sum_rates(const CellRates& rates) const;
  /// Of slivers, free simplices that bear nothing until their guard acts (element/guard.h) and are stiff then: a bound on what guards add to omega^2 of the mesh
  /// at x, 1/s2, and the largest |dJ/dt| of those whose own bound is above `thin`, 1/s2, in 1/s. rates: at x.
  struct GuardLimit {
    double omega2 = 0, change = 0;
  };
  GuardLimit guard_limit(const NodeField& x, const NodeField& v, const CellRates& rates, double thin) const;
  /// The weights of crossed triangles follow shapes that have left theirs (element/crossed.h), at x: to be asked now and then. Energies stay what they are.
  void renew_weights(const NodeField& x);
  /// kg more on each node, for good. It changes no cell's own rates.
  void add_mass(const std::vector<double>& kg);

  double slowest_wave() const;  ///< sqrt((K + 4 mu/3)/rho) of the slowest material, masses scaled, m/s

  /// f = internal forces at x as if nothing yielded on the way from the last positions: a change of
  /// x gives the elastic tangent. Without viscosity; no memory changes, what nodal_forces() gave is lost. Not of Law::classical.
  void elastic_forces(const NodeField& x, NodeField& f);

  long blocks() const;           ///< of cells, over all groups
  long blocks_at_rest() const;   ///< of those, passed over with their tile by the last forces(): see element/stillness.h
  double plastic_work() const;   ///< dissipated so far, J
  double viscous_work() const;   ///< dissipated so far by bulk viscosity, J
  std::vector<double> plastic_strain() const;
  /// since: the nodes have come to x in this time, s, since the forces were last found: what the rate of flow there is taken of.
  ElementFields observe(const NodeField& x, double since = 0) const;
  /// Of these elements alone, in their order.
  std::vector<Sym> stress_of(const std::vector<int>& elements, const NodeField& x, double since = 0) const;
  /// J. v, since: the nodes have come here with these velocities in this time, s, since the memory was kept, for Law::classical;
  /// without them its stresses are those of the memory.
  double stored_energy(const NodeField& x, const NodeField* v = nullptr, double since = 0) const;
  double stored_energy_of(const BodyModel& body, const NodeField& x) const;  ///< J, of one body

  /// What the elements of the body remember; x: where they stand. Without FormedMemory::reference.
  FormedMemory memory_of(const BodyModel& body, const NodeField& x) const;

  /// Numbers that the next steps depend on, in a fixed order.
  void append_state(std::vector<double>& to) const;
  const double* read_state(const double* from);
  const char* kernel_name() const;
  Team& team() const { return *team_; }  ///< the threads of the run
  const NodeTeam& node_team() const { return *node_team_; }  ///< they, where they go through the nodes

 private:
  struct Group;
  template <int D> struct StandingCell;
  struct Location { int group, cell, simplex; };
  Location locate(int element) const;
  double volume_ratio(const NodeField& x, int element) const;
  [[noreturn]] void report_inversion(const NodeField& x) const;
  /// Throws where a corner of a one-point cell is inside out.
  void report_corner_inversion(const NodeField& x) const;
  /// Throws where a point at an edge is inside out although the simplices around it are not.
  void report_edge_inversion(const NodeField& x) const;
  void check_axis(const NodeField& x) const;
  void nodal_pressure(const NodalView& view, double* slots) const;
  /// Likewise, in room of its own: the forces that the cells found last stay.
  void observe_pressure(const NodalView& view) const;
  double stored_energy(const NodalView& view, const BodyModel* of) const;  // null: of all
  /// What the kernels observe of these blocks; stress and ratio: null where the energy is asked for alone.
  void observe_blocks(const Group& g, long first_block, long last_block, const NodalView& view, double* stress, double* ratio, double* energy) const;
  /// A group of the points at the edges of the body's simplices whose pressures are in the nodes.
  void put_points_at_edges(const BodyModel& body, const NodeField& X);
  /// Of every simplex of g, in the order of its cells, the means over its edges of value[point][components].
  std::vector<double> means_over_edges(const Group& g, const std::vector<double>& value, int components) const;
  /// omega_e^2 of element/time_step.h, of all points at edges.
  std::vector<double> edge_rates(const NodalView& view) const;
  /// Edge vectors of the law of a point at an edge, m, as columns; 2D: the third is e_3, of a ring R e_3.
  Eigen::Matrix3d point_edges(const Group& g, int point, const NodeField& x) const;
  std::vector<double> point_ratios(const Group& g, const NodeField& x) const;  ///< V/V0, [point] at edges
  /// The body goes on from this memory, which was that of its cells at x, and perhaps of more.
  void take_up(const BodyModel& body, const FormedMemory& memory, const NodeField& x);
  void take_up_nodes(const BodyModel& body, const std::vector<double>& ratio, const NodeField& x);
  void take_up_points(const BodyModel& body, const FormedEdges& formed, const NodeField& x, Group& g);
  void keep_shares(const NodeField& X);
  void add_bytes(const Group& group, GroupPlan& plan) const;
  /// Cuts the groups into tiles, gives every node of each tile a slot, and tells the nodes theirs.
  void lay_tiles(int nodes);
  void clear_slots(const Group& group, long tile, double* sums) const;
  /// cells: the group, or what differs from it in its law only.
  void forces_of_tile(const CellGroup& cells, const Group& group, const NodalView& view, long tile) const;
  /// Those of the tiles whose nodes moved, or whose memory the last evaluation changed.
  /// Returns whether some tile has no node that moves.
  bool forces_of_moved(Group& g, const NodalView& view);
  long eights_of_a_block(const Group& group) const;
  long blocks_of_a_thread(const Group& group) const;
  long tiles_of_a_thread(const Group& group) const;
  template <class Asked, class Work> void over_tiles(Asked&& asked, Work&& work) const;

  const Isa isa_;
  const Kernels& kernels_;
  int dimension_;
  bool axisymmetric_;
  std::unique_ptr<Team> team_;
  std::unique_ptr<NodeTeam> node_team_;
  std::vector<Group> groups_;
  std::vector<std::array<int, 4>> simplices_;
  std::vector<double> mass_;
  std::vector<double> inertia_;                      ///< axisymmetric only: NodalView::inertia
  std::vector<int> slot_start_, slot_index_;         ///< slots of a node, those of cells with nodal pressure first
  std::vector<int> nodal_slots_;                     ///< of a node: behind the last of the latter
  int points_ = 0;                                   ///< lanes of the points at edges
  LargeArray<Lane> slot_storage_;
  double* slots_ = nullptr;                          ///< [slot][kRecord]
  mutable LargeArray<Lane> volume_storage_;          ///< likewise, of nodal pressure only
  int record_size_ = 0;
  mutable std::vector<double> pressure_, growth_;  ///< nodal pressure only: p_n, theta_n (element/even_pressure.h)
  std::vector<double> nodal_volume0_, nodal_bulk_, nodal_rough_bulk_;
  bool any_nodal_ = false, any_even_ = false;  ///< any_even_: some have K_r < K
  bool may_sleep_ = true;                            ///< forces follow from positions and memory alone
  Stillness stillness_;
  StepTimes* times_ = nullptr;
};

}  // namespace forming_sim
