#pragma once
// What a pair is given before it can act: its stiffness E A h0, the inverse mass
// that it feels, its friction.
#include <algorithm>
#include <vector>

#include "forming_sim/contact/features.h"
#include "forming_sim/contact/levers.h"
#include "forming_sim/contact/pair.h"
#include "forming_sim/contact/pair_shares.h"
#include "forming_sim/contact/shear_waves.h"

namespace forming_sim {

struct PairConstants {
  const Features& features;
  const Workspace& work;
  double modulus, layer;  ///< E, Pa; h0, m
  const ShearWaves* waves = nullptr;  ///< where the workspace has a steady motion

  /// Sets stiffness, w and, where the surfaces rub, adds a Rub. A is the mean
  /// area of the pair's deformable nodes. A pair that nothing can move gets
  /// stiffness 0 and w 0.
  void set(ContactPair& pair, std::vector<Rub>& rubs) const;

  // The same in two steps, the first of which lanes may have made already.
  PairShares<double> shares_of(const Link& link) const;
  void take(double w, double mean_area, double movers, double held, ContactPair& pair) const {
    pair.w = w;
    pair.stiffness = modulus * layer * mean_area;
    pair.movers = static_cast<std::uint16_t>(movers);
    pair.held = held != 0;
  }
  void finish(ContactPair& pair, std::vector<Rub>& rubs) const {
    const Features::Relation& relation = features.relation(pair.own, pair.surface);
    const double any = pair.w;
    if (pair.held) pair.w = held_w(pair);
    if (pair.held && relation.sticks_by >= 0 && pair.w < (1 - 1e-12) * any) {
      straighten(work, pair);
      pair.w = held_w(pair);
    }
    // Held against the normal up to rounding is held.
    if (pair.w <= 1e-12 * any) pair.w = pair.stiffness = 0;
    pair.rub = -1;
    if (!(relation.friction > 0)) return;
    pair.rub = static_cast<int>(rubs.size());
    rubs.push_back({Node::Zero(), relation.friction, any});
    if (!work.steady.empty()) let_waves_leave(pair, rubs.back());
  }
  void let_waves_leave(const ContactPair& pair, Rub& rub) const;
  /// Along the normal, held directions removed.
  double held_w(const ContactPair& pair) const;
};

}  // namespace forming_sim
