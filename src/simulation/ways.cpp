#include "forming_sim/simulation/ways.h"

#include <Eigen/QR>

namespace forming_sim {
namespace {

/// Sum and moment of what acts at the nodes.
struct Whole {
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  void add(const Vec3& part, const Vec3& r) { sum += part, moment += r.cross(part); }
};

}  // namespace

Way Ways::of(double t, std::size_t b, const BodyModel& body, const NodeField& x, const NodeField& v, const std::vector<double>& mass) const {
  const Window& window = windows_[b];
  const double T1 = window.middle - window.begins, T2 = t - window.middle;
  Way way;
  way.T = t - window.begins;
  double m = 0;
  Vec3 mx = Vec3::Zero();
  const int end = body.first_node + body.node_count;
  for (int i = body.first_node; i < end; ++i) m += mass[i], mx += mass[i] * vec3(x[i]);
  const Vec3 centre = mx / m;
  Mat3 inertia = Mat3::Zero();
  Whole d_whole, dF_whole;  // M d and dF
  for (int i = body.first_node; i < end; ++i) {
    const Node d = 0.5 * (x[i] - begins_.x[i]);
    const Node F1 = (middle_.u[i] - begins_.u[i]) / T1, F2 = (v[i] + dragged_[i] - middle_.u[i]) / T2, dF = F2 - F1;  // over m
    way.d_dF += mass[i] * d.dot(dF);
    way.d_Md += mass[i] * d.squaredNorm();
    way.F_MF += mass[i] * F2.squaredNorm();
    const Vec3 r = vec3(x[i]) - centre;
    inertia += mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    d_whole.add(mass[i] * vec3(d), r);
    dF_whole.add(mass[i] * vec3(dF), r);
  }
  const Vec3 turn = inertia.completeOrthogonalDecomposition().solve(d_whole.moment);
  way.rigid_dF = d_whole.sum.dot(dF_whole.sum) / m + turn.dot(dF_whole.moment);
  way.rigid_Md = d_whole.sum.squaredNorm() / m + turn.dot(d_whole.moment);
  return way;
}

}  // namespace forming_sim
