#include "forming_sim/contact/shear_waves.h"

#include <Eigen/Dense>
#include <algorithm>

namespace forming_sim {

namespace {
constexpr int kSamples = 64;  ///< nodes of a body from which its rigid motion is told; the nodes of structured cells repeat, a prime stride does not fall in with them

int stride_of(int nodes) {
  const auto is_prime = [](int n) {
    for (int d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return true;
  };
  if (nodes <= kSamples) return 1;
  int stride = nodes / kSamples;
  while (stride > 1 && !is_prime(stride)) --stride;
  return stride;
}

/// How a body moves as a rigid one: v + w x (x - c), the nearest by the masses of the sampled nodes.
struct RigidMotion {
  Node c = Node::Zero(), v = Node::Zero();
  Vec3 w = Vec3::Zero();

  Node at(const Node& x) const {
    const Node r = x - c;
    return v + Node(w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0], 0);
  }
};

/// place(n): where node n was when it had the velocity v. Nodes that are held in all directions do not count.
template <class Place> RigidMotion rigid_motion(const WaveBody& body, const std::vector<double>& inverse_mass, bool axisymmetric, const NodeField& v, Place&& place) {
  RigidMotion motion;
  double mass = 0;
  const int stride = stride_of(body.nodes);
  const auto each = [&](auto&& visit) {
    for (int n = body.first_node; n < body.first_node + body.nodes; n += stride)
      if (inverse_mass[n] > 0) visit(n, 1 / inverse_mass[n]);
  };
  each([&](int n, double m) {
    mass += m;
    motion.c += m * place(n);
    motion.v += m * v[n];
  });
  if (mass == 0) return motion;
  motion.c /= mass;
  motion.v /= mass;
  motion.c[3] = motion.v[3] = 0;
  if (axisymmetric) {
    motion.v[0] = 0;  // away from the axis nothing moves as a rigid body
    return motion;
  }
  Vec3 L = Vec3::Zero();
  Mat3 J = Mat3::Zero();
  each([&](int n, double m) {
    const Vec3 r = vec3(place(n) - motion.c);
    L += m * r.cross(vec3(v[n] - motion.v));
    J += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  });
  const double least = 1e-12 * J.trace();  // what lies on a line does not turn about it
  if (least > 0) motion.w = (J + least * Mat3::Identity()).ldlt().solve(L);
  return motion;
}
}  // namespace

ShearWaves::ShearWaves(std::vector<WaveBody> bodies, std::vector<std::vector<int>> vertices, std::size_t nodes, bool axisymmetric)
    : bodies_(std::move(bodies)), vertices_(std::move(vertices)), nodes_(nodes), axisymmetric_(axisymmetric), pressed_at_(nodes, -1) {}

const WaveBody& ShearWaves::of_pair(int first, int second) const {
  const int bodies = static_cast<int>(bodies_.size());
  if (first >= bodies) return bodies_[second];
  if (second >= bodies) return bodies_[first];
  return bodies_[bodies_[second].impedance < bodies_[first].impedance ? second : first];
}

const WaveBody& ShearWaves::of_node(int n) const {
  return *std::find_if(bodies_.begin(), bodies_.end(), [n](const WaveBody& body) { return n < body.first_node + body.nodes; });
}

void ShearWaves::begin(const NodeField& v) {
  steady_.assign(nodes_, Node::Zero());
  change_ = steady_;
  for (const std::vector<int>& own : vertices_)
    for (const int n : own) steady_[n] = Node(v[n][0], v[n][1], v[n][2], 0);
}

void ShearWaves::follow(double dt, double last_dt, const std::vector<double>& inverse_mass, const NodeField& x, const NodeField& before, const NodeField& after, const std::vector<RubbedNode>& pressed) {
  // A velocity belongs to the middle of its step.
  const auto place_after = [&](int n) -> Node { return x[n] - 0.5 * dt * after[n]; };
  const auto place_before = [&](int n) -> Node { return x[n] - dt * after[n] - 0.5 * last_dt * before[n]; };
  for (std::size_t i = 0; i < pressed.size(); ++i) pressed_at_[pressed[i].node] = static_cast<int>(i);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const WaveBody& body = bodies_[b];
    if (body.impedance == 0) continue;
    const RigidMotion was = rigid_motion(body, inverse_mass, axisymmetric_, before, place_before), is = rigid_motion(body, inverse_mass, axisymmetric_, after, place_after);
    const double part = dt / (body.time + dt);
    for (const int n : vertices_[b]) {
      Node& s = steady_[n];
      const double was_phi = s[3], phi = was_phi + part * ((pressed_at_[n] >= 0) - was_phi);
      change_[n] = is.at(place_after(n)) - was.at(place_before(n));
      change_[n][3] = 0;
      s += change_[n];
      const Node w = after[n] - s;
      s += (1 - was_phi) * part * w;
      if (pressed_at_[n] >= 0) {
        const RubbedNode& rubbed = pressed[pressed_at_[n]];
        const double across = rubbed.normal.squaredNorm();
        if (across > 0) s += was_phi * part * rubbed.normal.dot(w) / across * rubbed.normal;
        if (rubbed.area > 0) s -= 1 / (body.impedance * rubbed.area * body.time) * rubbed.radiated;
      }
      s[3] = phi;
    }
  }
  for (const RubbedNode& rubbed : pressed) pressed_at_[rubbed.node] = -1;
}

NodeField ShearWaves::save() const {
  NodeField saved;
  if (!steady_.empty())
    for (const std::vector<int>& own : vertices_)
      for (const int n : own) {
        saved.push_back(steady_[n]);
        saved.push_back(change_[n]);
      }
  return saved;
}

void ShearWaves::restore(const NodeField& saved) {
  steady_.clear();
  if (saved.empty()) return;
  steady_.assign(nodes_, Node::Zero());
  change_ = steady_;
  std::size_t i = 0;
  for (const std::vector<int>& own : vertices_)
    for (const int n : own) {
      steady_[n] = saved[i++];
      change_[n] = saved[i++];
    }
}

}  // namespace forming_sim
