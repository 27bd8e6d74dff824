#pragma once
// A body of few cells that tests move by hand.
#include <functional>

#include "support/bodies.h"

namespace forming_sim {

struct Moved {
  BodyModel body;
  NodeField X, x, v, f;
  Elements elements;
  double dt = 0;  ///< s, of a step, for laws that ask for it
  Moved(const Mesh& mesh, const MaterialConfig& material)
      : body(body_of(mesh, material)), X(positions_of(mesh)), x(X), v(X.size(), Node::Zero()), f(v), elements({body}, mesh.dimension, X, {}, 1) {}

  void place(const std::function<Vec3(const Vec3&)>& at) {
    for (std::size_t n = 0; n < X.size(); ++n) x[n] = node(at(vec3(X[n])));
  }
  const NodeField& forces() {
    elements.forces(x, v, dt, 0, f);
    return f;
  }
  /// Bends a body between x = 0 and 2, whose height along axis t is 1, to the curvature k; the moment that the forces at its end bear, N m.
  double bend(double k, int t) {
    place([&](const Vec3& at) { return Vec3(at + (at.x() - 1) * (at[t] - 0.5) * -k * Vec3::UnitX()); });
    forces();
    double moment = 0;
    for (std::size_t n = 0; n < X.size(); ++n)
      if (X[n][0] > 1) moment += f[n][0] * (X[n][t] - 0.5);
    return moment;
  }
  double energy() const { return elements.stored_energy(x); }
  /// Goes to at(1 / steps), at(2 / steps), ..., at(1), positions of the nodes; the work that is done against its forces, J.
  double work_along(int steps, const std::function<NodeField(double)>& at) {
    double work = 0;
    NodeField before = forces();
    for (int step = 1; step <= steps; ++step) {
      const NodeField from = x;
      x = at(step / double(steps));
      forces();
      for (std::size_t n = 0; n < x.size(); ++n) work -= 0.5 * (f[n] + before[n]).dot(x[n] - from[n]);
      before = f;
    }
    return work;
  }
};

inline double largest(const NodeField& f) {
  double most = 0;
  for (const Node& n : f) most = std::max(most, n.norm());
  return most;
}

/// One cell in the place of the box [0, size], its corners moved by `distort`.
inline Mesh cell_of(CellKind kind, const Vec3& size, const std::function<Vec3(const Vec3&)>& distort = nullptr) {
  Mesh mesh = block_of(kind, 1);
  for (Vec3& X : mesh.nodes) {
    X = Vec3(X.x() > 0.5 ? size.x() : 0, X.y() > 0.4 ? size.y() : 0, X.z() > 0.4 ? size.z() : 0);
    if (distort) X = distort(X);
  }
  check_volumes(mesh);
  return mesh;
}

inline MaterialConfig perfectly_plastic() {
  MaterialConfig m = aluminium(true);
  m.hardening->curve = "perfect";
  return m;
}

}  // namespace forming_sim
