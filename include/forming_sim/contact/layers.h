#pragma once
// How thick the layer of each pair is: the soft start of pairs that are born
// inside it, the raise for fast closing, and what is kept from step to step.
#include <algorithm>
#include <vector>

#include "forming_sim/contact/pair.h"

namespace forming_sim {

/// Kept of a pair that ended a step inside its layer, or was pressed in it: a layer that was raised is gone at the end of
/// the step, the force is not.
struct PairRecord {
  PairKey key;
  std::int32_t own, surface;  ///< surfaces of the first and of the second feature
  double layer;      ///< h0 of the pair, m
  double gap;        ///< h at the end of the step, m
  double force = 0;  ///< mean of the step along the normal, N

  /// Whether its layer lasts. base: see ContactPair.
  bool inside(double base) const { return gap < std::max(layer, base); }
};
struct Drag {
  double force[3];  ///< of friction, mean of the step, N
};

/// In the order of their keys.
struct PairRecords {
  LargeArray<PairRecord> pairs;
  LargeArray<Drag> drags;  ///< one a pair; empty where nothing rubs

  bool empty() const { return pairs.empty(); }
  void resize(long count, bool rub) {
    pairs.resize(count);
    drags.resize(rub ? count : 0);
  }
  /// What is known of a pair at the end of a step of dt, at place i.
  void put(long i, const ContactPair& pair, const std::vector<Rub>& rubs, double dt);
  /// So many from one place to another, which is not behind it.
  void move(long from, long to, long count);
};

/// What the pairs of a step are given from the step before: `layer`, and of known ones impulse and slip, from which
/// the sweeps start, or where the step was `tried` already those that this found; all lists in the order of the keys.
///  known            as it was; never more than half a layer for edges out of their wedge
///  new, h >= base   base, or .1 of the closing motion of the step where that is more, but not above h or `ceiling`
///  new, h < base    h: no force at first. Where the vertex or edge of either side has just left another
///                   feature of the other surface, that pair's layer goes over, to one new pair, so that
///                   the potential, a function of h/h0, does not rise.
/// The force that stops things in a short step is not that of a longer one: a pair starts from no more than
/// the impulse that the step before had.
class Layers {
 public:
  /// dt: of the step; last_dt: of the step before; work.v: predicted velocities. full: h0.
  Layers(const PairRecords& before, const PairRecords& tried, const Workspace& work, double dt, double last_dt, double full, double ceiling)
      : before_(before), last_try_(tried.empty() ? before : tried), tried_(!tried.empty()), work_(work), dt_(dt), lasts_(tried.empty() ? std::min(dt, last_dt) : dt), full_(full), ceiling_(ceiling) {}

  /// How far the lists have been gone through.
  struct Place {
    long before = -1, last_try = -1;
  };
  /// Layer of a new pair that closes so fast, m/s, m; not thicker than its gap and not thinner than its base.
  double raised(double closing) const { return std::min(ceiling_, 0.1 * closing * dt_); }
  /// Gives to one pair. Keys rise from call to call with the same `place`. Returns whether the pair is born inside its layer.
  bool give(ContactPair& pair, std::vector<Rub>& rubs, Place& place) const;
  /// Then, once all have been given: from the pairs that are gone to those born inside their layer (`born`: which, rising).
  void hand_over(const std::vector<long>& born, LargeArray<ContactPair>& pairs) const;

 private:
  const PairRecords &before_, &last_try_;
  bool tried_;
  const Workspace& work_;
  double dt_, lasts_, full_, ceiling_;  // lasts: of a force from which the sweeps start, s
};

/// Potential of pairs at their end gaps, J, before and after relax_layer;
/// the difference is the work of the layers' growth.
struct RelaxedPotential {
  double before = 0, after = 0;
};
/// Lets the layer of a pair grow (or shrink) to its base (of a contact whose layer is `full`) by at most `growth`, and adds its
/// potential. Returns whether the pair ended the step inside its layer, which must be remembered.
bool relax_layer(double full, double growth, ContactPair& pair, RelaxedPotential& potential);

}  // namespace forming_sim
