#pragma once
// Cells of one kind and one material, in blocks of kLanes cells, and the kernels
// that run over them. Arrays are structures of arrays within a block:
// [block][item][lane]. The last block is filled up with copies of its last cell;
// the copies are computed and never read.
#include "forming_sim/material/constants.h"
#include "forming_sim/tensor/isa.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// Over what the pressure p = K (V/V0 - 1) is averaged.
enum class PressureMode { cell, element, node };

/// Doubles of a force record: the last of a record in 3D is zero.
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
  int cell_nodes = 0, cell_simplices = 0;  ///< simplices: elements with a memory, 1 in a one-point cell
  int cells = 0, blocks = 0;
  PressureMode pressure = PressureMode::cell;
  double element_share = 0;        ///< theta: share of the element's own volume in a cell's pressure
  SolidConstants solid;
  int items = 0;                   ///< numbers of memory of a simplex (material/law.h), V0 the last
  double density = 0;              ///< kg/m3, scaled
  double linear_viscosity = 0, quadratic_viscosity = 0;

  const int* nodes = nullptr;      ///< [block][cell node][lane] joined node index
  double* memory = nullptr;        ///< [block][simplex][items][lane]
  const double* constants = nullptr;  ///< one-point cells: [block][OnePoint::items][lane]
  double* hourglass = nullptr;        ///< likewise: [block][hourglass_items][lane], memory
  int hourglass_items = 0;
  double* records = nullptr;       ///< [block][cell node][lane][kRecord]: forces, N; or volumes for nodal pressure
  double* plastic_work = nullptr;  ///< [block] dissipated so far, J
  double* viscous_work = nullptr;  ///< [block] dissipated so far by bulk viscosity, J
  double* lowest_ratio = nullptr;  ///< [block] smallest V/V0 of the last force pass
};

/// Nodal fields as the kernels read them: four doubles a node.
struct NodalView {
  const double* x = nullptr;          ///< positions
  const double* v = nullptr;          ///< velocities, read only with bulk viscosity or Law::classical
  const double* inertia = nullptr;    ///< [node] of rings: equal shares of the mass over the node's own, read in the time step only
  const double* pressure = nullptr;   ///< [node] nodal pressure, read only in PressureMode::node
  double dt = 0;                      ///< s, for the viscous work
  double last_dt = 0;                 ///< s, in which v led to x, for Law::classical
};

/// What bounds the step of the cells of one block (element/time_step.h).
struct BlockRates {
  Lane omega2;   ///< 1/s2
  Lane damping;  ///< 1/s, of bulk viscosity
};

/// The kernels of one vector width, for blocks [first, last) of a group.
struct Kernels {
  const char* name;
  /// Stress, plastic flow, nodal forces into `records`.
  void (*forces)(const CellGroup&, const NodalView&, int first, int last);
  /// Share of the current volume of each cell node into `records` ([block][cell node][lane]).
  void (*volumes)(const CellGroup&, const NodalView&, int first, int last);
  /// The bounds of element/time_step.h, [block].
  void (*rates)(const CellGroup&, const NodalView&, int first, int last, BlockRates* out);
  /// Cauchy stress [block][simplex][6][lane], V/V0 [block][simplex][lane] and stored
  /// deviatoric plus volumetric energy [block], without changing the memory.
  void (*observe)(const CellGroup&, const NodalView&, int first, int last, double* stress, double* ratio,
                  double* energy);
};

/// The kernels of an instruction set that this processor has.
const Kernels& kernels_of(Isa isa);

namespace sse2 { const Kernels& kernels(); }
namespace avx2 { const Kernels& kernels(); }
namespace avx512 { const Kernels& kernels(); }

}  // namespace forming_sim
