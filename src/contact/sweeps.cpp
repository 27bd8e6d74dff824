#include "forming_sim/contact/sweeps.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/law.h"

namespace forming_sim {

namespace {

// Returns the change of the pair's gap or slip, m.
inline double visit(double dt, Workspace& work, ContactPair& pair, std::vector<Rub>& rubs) {
  if (pair.w == 0) return 0;
  Node u = relative(pair, work.v);
  const double vn = dot3(pair.normal, u);
  const double now = pair.gap + dt * vn;              // the end gap as things stand
  const double g = now - dt * pair.w * pair.impulse;  // without this pair
  if (g >= pair.layer && pair.impulse == 0) return 0;
  double h;
  const double p = end_impulse(g, pair.layer, pair.stiffness, pair.w, dt, h);
  Node impulse = (p - pair.impulse) * pair.normal;
  pair.impulse = p;
  double change = std::abs(h - now);
  if (pair.rub >= 0) {
    Rub& rub = rubs[pair.rub];
    const Node slip = u - vn * pair.normal;
    Node q = rub.slip - slip / rub.w;
    const double size = std::sqrt(dot3(q, q)), most = rub.friction * p;
    if (size > most) q *= most / size;
    const Node difference = q - rub.slip;
    rub.slip = q;
    impulse += difference;
    change = std::max(change, std::sqrt(dot3(difference, difference)) * rub.w * dt);
  }
  push(pair, impulse, work, work.v);
  return change;
}

}  // namespace

double sweep(double dt, Workspace& work, std::vector<ContactPair>& pairs, std::vector<Rub>& rubs) {
  double change = 0;
  for (ContactPair& pair : pairs) change = std::max(change, visit(dt, work, pair, rubs));
  return change;
}

SweepResult solve_pairs(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, std::vector<ContactPair>& pairs,
                        std::vector<Rub>& rubs) {
  SweepResult result;
  for (;;) {
    double change = 0;
    for (TiePair& tie : ties) change = std::max(change, sweep_tie(dt, work, tie));
    change = std::max(change, sweep(dt, work, pairs, rubs));
    ++result.sweeps;
    if (change >= tolerance && result.sweeps < most) continue;
    result.open = true;
    for (ContactPair& pair : pairs) {
      pair.end_gap = pair.gap + dt * dot3(pair.normal, relative(pair, work.v));
      if (!(pair.end_gap > 0) && pair.w > 0) result.open = false;
    }
    if (result.open || result.sweeps >= most) return result;
  }
}

}  // namespace forming_sim
