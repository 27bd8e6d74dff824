#include "forming_sim/contact/sweeps.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/law.h"

namespace forming_sim {

void prepare_pair(const Workspace& work, ContactPair& pair) {
  pair.w = pair.w_slip = 0;
  for (int k = 0; k < pair.nodes; ++k) {
    const int n = pair.node[k];
    const double b2m = pair.weight[k] * pair.weight[k] * work.inverse_mass[n];
    pair.w_slip += b2m;
    pair.w += work.projector[n] ? b2m * dot3(pair.normal, project(*work.projector[n], pair.normal)) : b2m;
  }
  // Held against the normal up to rounding is held.
  if (pair.w <= 1e-12 * pair.w_slip) pair.w = pair.stiffness = 0;
}

double sweep(double dt, Workspace& work, std::vector<ContactPair>& pairs) {
  double change = 0;
  for (ContactPair& pair : pairs) {
    if (pair.w == 0) continue;
    Node u = relative(pair, work.v);
    const double vn = dot3(pair.normal, u);
    const double now = pair.gap + dt * vn;              // the end gap as things stand
    const double g = now - dt * pair.w * pair.impulse;  // without this pair
    if (g >= pair.layer && pair.impulse == 0) continue;
    double h;
    const double p = end_impulse(g, pair.layer, pair.stiffness, pair.w, dt, h);
    Node impulse = (p - pair.impulse) * pair.normal;
    pair.impulse = p;
    change = std::max(change, std::abs(h - now));
    if (pair.friction > 0) {
      const Node slip = u - vn * pair.normal;
      Node q = pair.slip - slip / pair.w_slip;
      const double size = std::sqrt(dot3(q, q)), most = pair.friction * p;
      if (size > most) q *= most / size;
      const Node difference = q - pair.slip;
      pair.slip = q;
      impulse += difference;
      change = std::max(change, std::sqrt(dot3(difference, difference)) * pair.w_slip * dt);
    }
    push(pair, impulse, work, work.v);
  }
  return change;
}

SweepResult solve_pairs(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, std::vector<ContactPair>& pairs) {
  SweepResult result;
  for (;;) {
    double change = 0;
    for (TiePair& tie : ties) change = std::max(change, sweep_tie(dt, work, tie));
    change = std::max(change, sweep(dt, work, pairs));
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

namespace {

// Books what the impulse of a link does to a tool and against what is held;
// returns the relative velocity, mean of before and after.
Node book(const Workspace& work, const Link& link, const Node& impulse, PairWork& sum) {
  Node mean = Node::Zero();
  for (int k = 0; k < link.nodes; ++k) {
    const int n = link.node[k];
    const Node v = 0.5 * (work.before[n] + work.v[n]);
    mean += link.weight[k] * v;
    if (n >= work.body_entries)
      sum.tool -= link.weight[k] * dot3(impulse, v);
    else if (work.projector[n])
      sum.held += link.weight[k] * dot3(impulse - project(*work.projector[n], impulse), v);
  }
  return mean;
}

}  // namespace

PairWork work_of(const Workspace& work, const std::vector<TiePair>& ties, const std::vector<ContactPair>& pairs) {
  PairWork sum;
  for (const TiePair& tie : ties) sum.normal += dot3(tie.impulse, book(work, tie, tie.impulse, sum));
  for (const ContactPair& pair : pairs) {
    if (pair.impulse == 0) continue;
    const Node mean = book(work, pair, pair.impulse * pair.normal + pair.slip, sum);
    sum.normal += pair.impulse * dot3(pair.normal, mean);
    sum.friction -= dot3(pair.slip, mean);
  }
  return sum;
}

}  // namespace forming_sim
