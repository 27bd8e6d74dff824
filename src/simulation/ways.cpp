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

Way Ways::way(double t, std::size_t b, Nodes of, const NodeField& x, const NodeField& v, const std::vector<double>& mass, bool led) const {
  const Window& window = windows_[b];
  const double T1 = window.middle - window.begins, T2 = t - window.middle;
  Way way;
  way.T = t - window.begins;
  double m = 0;
  Vec3 mx = Vec3::Zero();
  const int end = of.first + of.count;
  for (int i = of.first; i < end; ++i) m += mass[i], mx += mass[i] * vec3(x[i]);
  const Vec3 centre = mx / m;
  Mat3 inertia = Mat3::Zero();
  Whole d_whole, dF_whole, F_whole;  // M d, dF and F2
  for (int i = of.first; i < end; ++i) {
    const Node d = led ? Node(middle_.x[i] - begins_.x[i]) : Node(0.5 * (x[i] - begins_.x[i]));
    const Node F1 = (middle_.u[i] - begins_.u[i]) / T1, F2 = (v[i] + dragged_[i] - middle_.u[i]) / T2, dF = F2 - F1;  // over m
    way.d_dF += mass[i] * d.dot(dF);
    way.d_Md += mass[i] * d.squaredNorm();
    way.F_MF += mass[i] * F2.squaredNorm();
    const Vec3 r = vec3(x[i]) - centre;
    inertia += mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    d_whole.add(mass[i] * vec3(d), r);
    dF_whole.add(mass[i] * vec3(dF), r);
    F_whole.add(mass[i] * vec3(F2), r);
  }
  if (of.count == 1) return way;  // no body: a mover that nothing but its own law holds
  const Eigen::CompleteOrthogonalDecomposition<Mat3> by_inertia(inertia);
  const Vec3 turn = by_inertia.solve(d_whole.moment);
  way.rigid_dF = d_whole.sum.dot(dF_whole.sum) / m + turn.dot(dF_whole.moment);
  way.rigid_Md = d_whole.sum.squaredNorm() / m + turn.dot(d_whole.moment);
  const auto moves_whole = [&](const Whole& F) { return F.sum.squaredNorm() / m + F.moment.dot(by_inertia.solve(F.moment)); };
  way.rigid_F_MF = moves_whole(F_whole);
  way.rigid_dF_MdF = moves_whole(dF_whole);
  return way;
}

}  // namespace forming_sim
