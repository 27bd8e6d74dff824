#pragma once
// What a step does node by node, compiled once per vector width. Fields hold four doubles a node.
#include "forming_sim/tensor/isa.h"

namespace forming_sim {

/// For nodes [first, last).
struct NodeKernels {
  /// f = sum of the slots of each node (element/cell_group.h); those of node n are index[start[n]] to index[start[n + 1] - 1].
  void (*sum)(int dimension, const int* start, const int* index, const double* slots, long first, long last, double* f);
  /// to = keep v + push/m f; mass: one number a node.
  void (*kick)(double keep, double push, const double* v, const double* f, const double* mass, long first, long last, double* to);
  /// x += dt v
  void (*move)(double dt, const double* v, long first, long last, double* x);
};

const NodeKernels& node_kernels_of(Isa isa);

namespace sse2 { const NodeKernels& node_kernels(); }
namespace avx2 { const NodeKernels& node_kernels(); }
namespace avx512 { const NodeKernels& node_kernels(); }

}  // namespace forming_sim
