#pragma once
// One body moved by hand: Elements and symplectic Euler (3.39), for runs of many
// short steps in which a figure of the paper compares two laws.
#include <Eigen/Geometry>
#include <array>

#include "support/bodies.h"

namespace forming_sim::bench {

class SteppedBody {
 public:
  SteppedBody(const Mesh& mesh, const MaterialConfig& material, const std::string& average = "cell", const ElementOptions& options = {})
      : X(positions_of(mesh)),
        x(X),
        v(X.size(), Node::Zero()),
        load(v),
        free(X.size(), Node(1, 1, mesh.dimension == 3 ? 1 : 0, 0)),
        elements_({body_of(mesh, material, average)}, mesh.dimension, X, options, 1),
        before_(v),
        force_(v) {}

  const NodeField X;              ///< initial positions, m
  NodeField x, v;                 ///< x^n; v^(n-1/2), which led there, and after accelerate() v^(n+1/2)
  NodeField load;                 ///< N
  std::vector<Node> free;         ///< 0: the component of the node is held
  double damping = 0;             ///< 1/s: takes damping m v from each node's force

  /// Stable step at the start, s.
  double stable_step() const {
    double dt = 0;
    int element = 0;
    elements_.stable_step(x, v, dt, element);
    return dt;
  }
  void accelerate(double dt) {
    before_ = v;
    elements_.forces(x, v, last_dt_, last_dt_, force_);
    const double keep = (1 - 0.5 * damping * dt) / (1 + 0.5 * damping * dt), kick = dt / (1 + 0.5 * damping * dt);
    for (std::size_t i = 0; i < x.size(); ++i)
      v[i] = (keep * v[i] + kick / mass()[i] * (force_[i] + load[i])).cwiseProduct(free[i]);
  }
  void move(double dt) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * v[i];
    last_dt_ = dt;
  }
  void step(double dt) {
    accelerate(dt);
    move(dt);
  }

  const std::vector<double>& mass() const { return elements_.nodal_mass(); }
  const Elements& elements() const { return elements_; }

  /// Area or volume over that of the start.
  double volume_ratio() const {
    double V = 0, V0 = 0;
    for (const auto& s : elements_.simplices()) {
      V += volume(x, s);
      V0 += volume(X, s);
    }
    return V / V0;
  }
  /// Mean stress of all elements by volume, Pa: xx yy zz xy yz zx. Between accelerate() and move().
  Sym mean_stress() const {
    const ElementFields fields = elements_.observe(x);
    Sym sum = Sym::Zero();
    double V = 0;
    for (std::size_t e = 0; e < fields.stress.size(); ++e) {
      const double Ve = volume(x, elements_.simplices()[e]);
      sum += Ve * fields.stress[e];
      V += Ve;
    }
    return sum / V;
  }
  /// Kinetic and stored energy at x^n, J, the kinetic one of the mean of v^(n-1/2) and v^(n+1/2).
  /// Between accelerate() and move().
  double energy() const {
    double sum = elements_.stored_energy(x);
    for (std::size_t i = 0; i < x.size(); ++i) sum += 0.125 * mass()[i] * (before_[i] + v[i]).squaredNorm();
    return sum;
  }
  /// Sum of m x^n x v^(n+1/2), about the origin.
  Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) sum += mass()[i] * vec3(x[i]).cross(vec3(v[i]));
    return sum;
  }

 private:
  double volume(const NodeField& at, const std::array<int, 4>& s) const {
    const Vec3 a = vec3(at[s[1]] - at[s[0]]), b = vec3(at[s[2]] - at[s[0]]);
    return s[3] < 0 ? 0.5 * a.cross(b).z() : a.cross(b).dot(vec3(at[s[3]] - at[s[0]])) / 6;
  }
  Elements elements_;
  NodeField before_, force_;
  double last_dt_ = 0;
};

}  // namespace forming_sim::bench
