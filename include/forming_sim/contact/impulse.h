#pragma once
// Relative motion at a pair, and what an impulse on it does to its nodes.
#include <algorithm>
#include <cmath>
#include <vector>

#include "forming_sim/contact/pair.h"

namespace forming_sim {

inline Node relative(const Link& pair, const NodeField& v) {
  Node u = pair.weight[0] * v[pair.node[0]];
  for (int k = 1; k < pair.nodes; ++k) u += pair.weight[k] * v[pair.node[k]];
  return u;
}

inline Node project(const Mat3& p, const Node& j) { return node(p * vec3(j)); }

/// What an impulse on the pair is on its k-th node.
inline Node on_node(const Link& pair, int k, const Node& impulse) { return pair.weight[k] * impulse; }

/// Adds to `field` of every node of the pair what the impulse is on it over its mass, held directions removed: to velocities an impulse, to places one
/// times a time.
template <class AnyLink> void push_nodes(const AnyLink& pair, const Node& impulse, const Workspace& work, NodeField& field) {
  for (int k = 0; k < pair.nodes; ++k) {
    const int n = pair.node[k];
    const Node j = work.share[n].inverse_mass * on_node(pair, k, impulse);
    if (const Mat3* projector = work.projector[n])
      field[n] += project(*projector, j);
    else
      field[n] += j;
  }
}
inline void push(const Link& pair, const Node& impulse, const Workspace& work, NodeField& field) { push_nodes(pair, impulse, work, field); }

/// Of every node of bodies the normal impulses of its pairs that rub, by their weights, N s.
inline void sum_impulses(const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<double>& sum) {
  sum.assign(work.body_entries, 0.0);
  for (const ContactPair& pair : pairs)
    if (pair.rub >= 0 && pair.impulse > 0) work.each_of_bodies(pair, [&](int i, double b) { sum[i] += std::abs(b) * pair.impulse; });
}

/// The impulse by which friction comes nearest to ending the slip of the pair
/// within the Coulomb cone of its normal impulse and the limit of its shear stress, N s; into rub.slip and
/// added to the velocities.
inline void end_slip(const ContactPair& pair, Rub& rub, Workspace& work) {
  if (pair.impulse == 0) return;
  const Node u = relative(pair, work.v);
  Node q = -(u - pair.normal.dot(u) * pair.normal) / rub.w;
  const double size = q.norm(), most = std::min(rub.friction * pair.impulse, rub.most);
  if (size > most) q *= most / size;
  rub.slip = q;
  push(pair, q, work, work.v);
}

}  // namespace forming_sim
