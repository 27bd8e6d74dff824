#include "forming_sim/simulation/settle.h"

#include <algorithm>
#include <cmath>

namespace forming_sim {
namespace {

constexpr double kTurn = 0.5;    ///< omega T of a window
constexpr double kLongest = 2;   ///< T of a window, of the time for which a body must be quiet
constexpr double kDrift = 0.25;  ///< of kTurn: what moves as a whole and turns by less in its window drifts
constexpr double kSteady = 0.1;  ///< by which a force that a body falls by may change from half to half
constexpr double kFall = 10;     ///< times the slowest swing: when what it gives the body counts

double omega_of(double d_dF, double d_Md) { return d_Md > 0 && d_dF < 0 ? std::sqrt(-d_dF / d_Md) : 0; }

}  // namespace

bool Settle::over(std::size_t mover, const Way& way, double dt, bool led) {
  Swing& swing = swing_of_[mover];
  const double slower = kTurn / way.T;
  const bool drifts = !led && omega_of(way.rigid_dF, way.rigid_Md) < kDrift * slower;
  const double own_dF = way.d_dF - (drifts ? way.rigid_dF : 0), own_Md = way.d_Md - (drifts ? way.rigid_Md : 0), omega = omega_of(own_dF, own_Md);
  // A steady force drives it on, and will have given it what is no rest any more.
  const bool falls = drifts && way.rigid_dF_MdF < kSteady * kSteady * way.rigid_F_MF && 0.5 * way.rigid_F_MF * std::pow(kFall * slowest_of(mover), 2) > swing.below;
  const bool flies = falls || (drifts && 2 * way.rigid_Md > swing.below * way.T * way.T);
  const bool turned = led ? omega > 0 : omega >= slower;
  if (turned || (!led && slower < swing.omega)) {
    swing.omega = std::min(led ? omega : std::max(omega, slower), 0.5 / dt);
    swing.v_Mv = 4 * (flies ? way.d_Md : own_Md) / (way.T * way.T);
    swing.v_Kv = swing.v_Mv * (flies ? std::max(0.0, -way.d_dF / way.d_Md) : swing.omega * swing.omega);
  } else if (swing.omega > 0) {
    return led;
  }
  swing.F_MF = way.F_MF - (drifts ? way.rigid_F_MF : 0);
  swing.falls = falls;
  return led || turned || way.T >= kLongest * slowest_of(mover);
}

void Settle::take_together(double dt) {
  double v_Kv = 0, v_Mv = 0;
  for (const Swing& swing : swing_of_) v_Kv += swing.v_Kv, v_Mv += swing.v_Mv;
  if (v_Mv > 0) omega_ = std::min(std::sqrt(v_Kv / v_Mv), 0.5 / dt);
}

bool Settle::at_rest(double t, const std::vector<Energies>& bodies, const std::vector<double>& of_tools) {
  restless_ = quiet_ = 0;
  bool quiet = true;
  double elastic = 0, most = 0, least = 0;
  const auto judge = [&](double kinetic, std::size_t mover, double beside, double had, double least) {
    Swing& swing = swing_of_[mover];
    const double omega = swing.omega > 0 ? swing.omega : 1 / slowest_of(mover);  // while nothing is known of it
    const double restless = kinetic + 0.5 * swing.F_MF / (omega * omega), below = std::max(fraction_ * std::max(beside, 1e-6 * had), least);
    swing.below = below;
    if ((swing.omega == 0 && kinetic > 0) || swing.falls || restless > below) quiet = false;
    if (quiet_ == 0 || restless * quiet_ > restless_ * below) restless_ = restless, quiet_ = below, mover_ = static_cast<double>(mover);
  };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    most_of_[b] = std::max(most_of_[b], bodies[b].elastic + bodies[b].kinetic);
    judge(bodies[b].kinetic, b, bodies[b].elastic, most_of_[b], least_of_[b]);
    elastic += bodies[b].elastic;
    most += most_of_[b];
    least += least_of_[b];
  }
  for (std::size_t k = 0; k < of_tools.size(); ++k) judge(of_tools[k], bodies.size() + k, elastic, most, least);
  const bool was_quiet = is_quiet();
  looked_ = t;
  if (!quiet) quiet_since_ = t;
  return was_quiet && t - quiet_since_ > shortest();
}

}  // namespace forming_sim
