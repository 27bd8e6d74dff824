#pragma once
// Cells of one kind and one material, in blocks of kLanes cells, and the kernels
// that run over them. Arrays are structures of arrays within a block:
// [block][item][lane]. The last block is filled up with copies of its last cell;
// the copies are computed and never read.
//
// Blocks that follow each other make a tile. The forces of its cells are added up by node in the
// tile's own slots, one a node that its cells have, which the cache of a core holds;
// then a node adds up its slots of all tiles. Tiles depend on nothing but the
// cells, so the order of every sum is the same on any number of threads.
#include "forming_sim/material/constants.h"
#include "forming_sim/tensor/isa.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// Over what the pressure p = K (V/V0 - 1) is averaged.
enum class PressureMode { cell, element, node };

/// Doubles of a slot: the force on a node; the last in 3D is zero.
template <int D> constexpr int kRecord = D == 2 ? 2 : 4;

/// One item of kLanes elements, aligned for the widest kernels.
struct alignas(64) Lane {
  double value[kLanes] = {};
  double& operator[](int l) { return value[l]; }
  double operator[](int l) const { return value[l]; }
};

struct CellGroup {
  int kind = 0;             ///< CellKind
  int dimension = 0;
  bool ring = false;        ///< axisymmetric: the triangles are turned about the y axis
  int cell_nodes = 0, cell_simplices = 0;  ///< simplices: elements with a memory, 1 in a one-point cell; of points at edges no number of nodes, which have as many as there are around an edge
  int cells = 0, blocks = 0;
  int tiles = 0;                   ///< of as many blocks each, but for one more or less
  PressureMode pressure = PressureMode::cell;
  double element_share = 0;        ///< share of the element's own volume in a cell's pressure
  double guard = 0;                ///< theta of element/guard.h, 0 where there is none
  SolidConstants solid;
  int items = 0;                   ///< numbers of memory of a simplex (material/law.h), V0 the last
  double density = 0;              ///< kg/m3, scaled
  double linear_viscosity = 0, quadratic_viscosity = 0;

  const int* nodes = nullptr;      ///< [block][cell node][lane] joined node index; edge points: [row][lane], a block has a row for each node of the point that has most, where others have their last again without weight
  const int* rows = nullptr;       ///< edge points: [block] its first row, and behind the last
  double* memory = nullptr;        ///< [block][simplex][items][lane]
  const double* constants = nullptr;  ///< one-point cells: [set][OnePoint::items][lane]; crossed triangles: [set][kCrossedItems][lane]; edge points: [row][weight][lane]
  const int* constant_set = nullptr;  ///< likewise: [block] its set, shared by blocks of the same shape
  double* hourglass = nullptr;        ///< likewise: [block][hourglass_items][lane], memory
  int hourglass_items = 0;
  const int* slots = nullptr;      ///< as `nodes`: where in `sums` the slot starts that the node has in the tile; of a copy one that no node reads
  double* sums = nullptr;          ///< [slot][kRecord] forces, N; or volumes for nodal pressure, the first of each
  double* plastic_work = nullptr;  ///< [block] dissipated so far, J
  double* viscous_work = nullptr;  ///< [block] dissipated so far by bulk viscosity, J
  double* last_viscosity = nullptr;  ///< with bulk viscosity: [block][2][lane] its q and dV/dt of the last force pass, whose work comes with the next
  bool* upright = nullptr;         ///< [block] V/V0 > 0 everywhere in the last force pass
  bool* pressed = nullptr;         ///< one-point cells: [block] a corner is so far in the range of its guard, likewise, that its stiffness grows fast (element/corner_guard.h)
  bool at_edges = false;           ///< the cells are points of element/edge_points.h
  const double* node_share = nullptr;  ///< edge points: [row][lane] V_e's share of each node, for the time step
  const double* edge_omega2 = nullptr; ///< simplices whose law is at their edges: [block][simplex][lane] mean of the edges' bounds, likewise
};

/// Nodal fields as the kernels read them: four doubles a node.
struct NodalView {
  const double* x = nullptr;          ///< positions
  const double* v = nullptr;          ///< velocities, read only with bulk viscosity or Law::classical
  const double* inertia = nullptr;    ///< [node] of rings: equal shares of the mass over the node's own, read in the time step only
  const double* pressure = nullptr;   ///< [node] nodal pressure, read only in PressureMode::node
  double last_kick = 0;               ///< s, in which the forces of the last pass acted, for the viscous work
  double last_dt = 0;                 ///< s, in which v led to x, for Law::classical and plastic rates
  const double* growth = nullptr;     ///< [node] theta_n of element/even_pressure.h, read in growths only
};

/// What bounds the step of the cells of one block (element/time_step.h).
struct BlockRates {
  Lane omega2;   ///< 1/s2
  Lane damping;  ///< 1/s, of bulk viscosity
};

/// Of simplices with pressures in their nodes. What they have beside the pressure is at their edges.
struct NodalKernels {
  /// Shares of the current volume of the cell nodes are added to `sums`.
  void (*volumes)(const CellGroup&, const NodalView&, int first, int last);
  /// Shares of V_s0 theta_s of element/even_pressure.h, likewise.
  void (*growths)(const CellGroup&, const NodalView&, int first, int last);
  /// The pressures' forces on the nodes, likewise.
  void (*forces)(const CellGroup&, const NodalView&, int first, int last);
  /// As in Kernels, of the pressure alone; energy: the share of the simplices' own pressures.
  void (*observe)(const CellGroup&, const NodalView&, int first, int last, double* stress, double* ratio, double* energy);
};

/// Of the points of element/edge_points.h: stress is the deviator S, energy the deviatoric one.
struct EdgeKernels {
  void (*forces)(const CellGroup&, const NodalView&, int first, int last);
  void (*observe)(const CellGroup&, const NodalView&, int first, int last, double* stress, double* ratio, double* energy);
  /// The bounds omega_e^2 of element/time_step.h, 1/s2, [block][lane].
  void (*rates)(const CellGroup&, const NodalView&, int first, int last, double* omega2);
};

/// The kernels of one vector width, for blocks [first, last) of a group.
struct Kernels {
  const char* name;
  /// Stress, plastic flow; nodal forces are added to `sums`.
  void (*forces)(const CellGroup&, const NodalView&, int first, int last);
  /// The bounds of element/time_step.h, [block].
  void (*rates)(const CellGroup&, const NodalView&, int first, int last, BlockRates* out);
  /// Cauchy stress [block][simplex][6][lane], V/V0 [block][simplex][lane] and stored
  /// deviatoric plus volumetric energy [block], of block `first` first, without changing the memory. Without `stress` the energy alone.
  void (*observe)(const CellGroup&, const NodalView&, int first, int last, double* stress, double* ratio,
                  double* energy);
  NodalKernels nodal;
  EdgeKernels edge;
};

/// The kernels of an instruction set that this processor has.
const Kernels& kernels_of(Isa isa);

namespace sse2 { const Kernels& kernels(); }
namespace avx2 { const Kernels& kernels(); }
namespace avx512 { const Kernels& kernels(); }

}  // namespace forming_sim
