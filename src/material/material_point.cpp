#include "forming_sim/material/material_point.h"

#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/material/law.h"

namespace forming_sim {
namespace {

Vector<double, 3> column(const Mat3& F, int m) { return {{F(0, m), F(1, m), F(2, m)}}; }

}  // namespace

MaterialPoint::MaterialPoint(const SolidConstants& solid) : solid_(solid) { start(); }

MaterialPoint::MaterialPoint(const MaterialConfig& config) : solid_(solid_constants(config, *tables_)) { start(); }

void MaterialPoint::start() {
  memory_.resize(memory_items<3>(solid_));
  const std::vector<double> axes = axes_at_start(solid_.orthotropy, 3, Mat3::Identity());
  start_memory<3>(solid_, {{1, 1, 1, 0, 0, 0}}, axes.data(), [&](int item, double value) { memory_[item] = value; });
  memory_.back() = 1.0 / 6;
}

MaterialPoint::Answer MaterialPoint::step(const Mat3& F, bool keep) {
  Edges<double, 3> e;
  Vector<double, 3> moved[3];
  for (int m = 0; m < 3; ++m) {
    e.x[m] = column(F, m);
    moved[m] = column(F - F_, m);
  }
  find_reciprocal(e);
  const double J = F.determinant();
  std::vector<double> tried = memory_;
  const auto r = point_step(solid_, e, moved, J, tried.data(), Keep::yes);
  Answer answer;
  double pressure = solid_.K * (J - 1), stored = 0.5 * solid_.K * (J - 1) * (J - 1);
  if (solid_.law == Law::classical) {
    double& p = tried[kClassicalPressure<3>];
    p += solid_.K * Increment<double, 3>(e, moved).divergence();  // (2.11)
    pressure = p;
    stored = 0.5 * J * p * p / solid_.K;
  }
  answer.stress << r.S[0] + pressure, r.S[3], r.S[5], r.S[3], r.S[1] + pressure, r.S[4], r.S[5], r.S[4], r.S[2] + pressure;
  answer.energy = stored + point_energy(solid_, e, J, tried.data());
  if (keep) {
    memory_ = std::move(tried);
    F_ = F;
    dissipated_ += r.dissipation;
  }
  return answer;
}

MaterialPoint::Answer MaterialPoint::step_with_free(Mat3 F, const std::array<bool, 3>& free) {
  std::vector<int> unknown;
  for (int i = 0; i < 3; ++i)
    if (free[i]) {
      unknown.push_back(i);
      F(i, i) = F_(i, i);
    }
  const int n = static_cast<int>(unknown.size());
  const double h = 1e-7, scale = solid_.K + solid_.mu;
  const auto normal = [&](const Mat3& at) {
    const Mat3 stress = step(at, false).stress;
    Eigen::VectorXd s(n);
    for (int k = 0; k < n; ++k) s[k] = stress(unknown[k], unknown[k]);
    return s;
  };
  Eigen::VectorXd s = normal(F);
  for (int i = 0; n > 0; ++i) {
    Eigen::MatrixXd slope(n, n);
    for (int k = 0; k < n; ++k) {
      Mat3 plus = F, minus = F;
      plus(unknown[k], unknown[k]) += h;
      minus(unknown[k], unknown[k]) -= h;
      slope.col(k) = (normal(plus) - normal(minus)) / (2 * h);
    }
    const Eigen::VectorXd change = slope.partialPivLu().solve(s);
    // A step that does not bring the stresses down is halved: yielding has kinks.
    double part = 1;
    Mat3 next = F;
    Eigen::VectorXd found;
    for (int halving = 0; halving < 20; ++halving, part /= 2) {
      for (int k = 0; k < n; ++k) next(unknown[k], unknown[k]) = F(unknown[k], unknown[k]) - part * change[k];
      if (next.determinant() <= 0) continue;
      found = normal(next);
      if (found.norm() < s.norm() || found.norm() < 1e-13 * scale) break;
    }
    if (found.size() > 0) {
      F = next;
      s = found;
      if (s.norm() < 1e-13 * scale || part * change.norm() < 1e-14) break;
    }
    if (i == 100 || found.size() == 0) {
      std::ostringstream what;
      what << "no free stretches found at the deformation gradient (" << F.row(0) << "; " << F.row(1) << "; " << F.row(2)
           << "), where the free normal stresses are " << s.transpose() << " Pa: give smaller steps of the history";
      throw Error(Code::invalid_scene, what.str());
    }
  }
  return step(F);
}

double MaterialPoint::plastic_strain() const {
  return plastic_strain_of<3>(solid_, [&](int item) { return memory_[item]; });
}

}  // namespace forming_sim
