#pragma once
// What a step does node by node, compiled once per vector width. Fields hold four doubles a node.
#include "forming_sim/element/nodal_forces.h"
#include "forming_sim/tensor/isa.h"

namespace forming_sim {

/// For nodes [first, last).
struct NodeKernels {
  /// f of element/nodal_forces.h
  void (*sum)(const NodalForces& forces, long first, long last, double* f);
  /// to = keep v + push/m f. With still > 0: 0 instead where v and the load are 0 and |push/m f| <= still (element/nodes.h). Returns of how many nodes that is so; mass: one number a node.
  long (*kick)(double keep, double push, double still, const double* v, const NodalForces& forces, const double* mass, long first, long last, double* to);
  /// x += dt v; the largest |v - then|^2, 0 without `then`.
  double (*move)(double dt, const double* v, const double* then, long first, long last, double* x);
  /// moved = is x other than seen, seen = x; of how many nodes it is. moved: one number a node.
  long (*compare)(const double* x, long first, long last, double* seen, char* moved);
};

const NodeKernels& node_kernels_of(Isa isa);

namespace sse2 { const NodeKernels& node_kernels(); }
namespace avx2 { const NodeKernels& node_kernels(); }
namespace avx512 { const NodeKernels& node_kernels(); }

}  // namespace forming_sim
