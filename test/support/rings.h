#pragma once
// Small axisymmetric bodies for tests.
#include "support/bodies.h"

namespace forming_sim {

inline ElementOptions rings() {
  ElementOptions options;
  options.axisymmetric = true;
  return options;
}

/// The block of support/bodies.h from radius `inner` on; 0: it reaches the axis.
inline Mesh ring_block(CellKind kind, double inner, int n = 2) {
  Mesh mesh = block_of(kind, n);
  for (Vec3& X : mesh.nodes) X.x() += inner;
  return mesh;
}

/// Moves every node by up to `size`, those on the axis along it.
inline void shake_rings(NodeField& x, double size, unsigned seed) {
  NodeField shaken = x;
  shake(shaken, 2, size, seed);
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (x[n][0] == 0) shaken[n][0] = 0;
    x[n] = shaken[n];
  }
}

inline NodeField ring_forces(Elements& elements, const NodeField& x) {
  NodeField f(x.size()), v(x.size(), Node::Zero());
  elements.forces(x, v, 0, 0, f);
  return f;
}

}  // namespace forming_sim
