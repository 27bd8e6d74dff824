#include "forming_sim/contact/body_motion.h"

#include <Eigen/Dense>
#include <algorithm>

namespace forming_sim {

namespace {
constexpr double kHold = 1e6;  ///< of the masses: what is held counts so much more

/// So many of `count` that no more than `most` are asked; the nodes of structured cells repeat, and a prime stride does not fall in with them.
std::size_t stride_of(std::size_t count, std::size_t most) {
  const auto is_prime = [](std::size_t n) {
    for (std::size_t d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return true;
  };
  std::size_t stride = (count + most - 1) / most;
  while (stride > 1 && !is_prime(stride)) ++stride;
  return std::max<std::size_t>(stride, 1);
}

Mat3 cross_matrix(const Vec3& r) {
  Mat3 R;
  R << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0;
  return R;
}
}  // namespace

MovingBody::MovingBody(int first_node, int nodes, bool axisymmetric) : first_node_(first_node), nodes_(nodes), axisymmetric_(axisymmetric) {
  for (std::size_t n = 0, stride = stride_of(nodes, kAsked); n < static_cast<std::size_t>(nodes); n += stride) asked_.push_back(first_node + static_cast<int>(n));
}

void MovingBody::hold(const std::vector<HeldNode>& held) {
  std::vector<const HeldNode*> own;
  for (const HeldNode& h : held)
    if (h.node >= first_node_ && h.node < first_node_ + nodes_) own.push_back(&h);
  held_.clear();
  for (std::size_t i = 0, stride = stride_of(own.size(), kHeldAsked); i < own.size(); i += stride) held_.push_back(*own[i]);
}

// Least squares of V, w:  sum m |V + w x r - v|^2 + K sum |H (V + w x r - v)|^2,  r = x - c, c the masses' centre, H: across.
BodyMotion MovingBody::nearest(const Mass* masses, int count, const std::vector<Hold>& holds) const {
  using Six = Eigen::Matrix<double, 6, 1>;
  BodyMotion motion;
  double mass = 0;
  const Mass* const last = masses + count;
  for (const Mass* s = masses; s != last; ++s) {
    mass += s->m;
    motion.c += s->m * s->x;
    motion.v += s->m * s->v;
  }
  if (mass > 0) {
    motion.c /= mass;
    motion.v /= mass;
  } else if (!holds.empty()) {
    motion.c = holds[0].x;
  }
  motion.c[3] = motion.v[3] = 0;
  const double K = kHold * (mass > 0 ? mass : 1);
  if (axisymmetric_) {
    double held = 0, change = 0;
    for (const Hold& h : holds) {
      held += K * h.across(1, 1);
      change += K * (h.across(1, 0) * h.v[0] + h.across(1, 1) * (h.v[1] - motion.v[1]));
    }
    motion.v = Node(0, motion.v[1] + (mass + held > 0 ? change / (mass + held) : 0), 0, 0);
    return motion;
  }
  Vec3 L = Vec3::Zero();
  Mat3 J = Mat3::Zero();
  for (const Mass* s = masses; s != last; ++s) {
    const Vec3 r = vec3(s->x - motion.c);
    L += s->m * r.cross(vec3(s->v - motion.v));
    J += s->m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  // What lies on a line does not turn about it.
  if (holds.empty()) {
    if (J.trace() > 0) motion.w = (J + 1e-12 * J.trace() * Mat3::Identity()).ldlt().solve(L);
    return motion;
  }
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Six b = Six::Zero();  // of the change against V
  A.topLeftCorner<3, 3>() = (mass > 0 ? mass : 1e-9 * K) * Mat3::Identity();
  b.tail<3>() = L;
  double length2 = 0;
  for (const Hold& h : holds) {
    const Vec3 r = vec3(h.x - motion.c);
    length2 = std::max(length2, r.squaredNorm());
    Eigen::Matrix<double, 3, 6> B;
    B << Mat3::Identity(), -cross_matrix(r);
    const Eigen::Matrix<double, 3, 6> HB = K * h.across * B;
    A += B.transpose() * HB;
    b += HB.transpose() * vec3(h.v - motion.v);
  }
  A.bottomRightCorner<3, 3>() += J + 1e-9 * (mass > 0 ? J.trace() : K * length2) * Mat3::Identity();
  const Six q = A.ldlt().solve(b);
  motion.v += Node(q[0], q[1], q[2], 0);
  motion.w = q.tail<3>();
  return motion;
}

}  // namespace forming_sim
