#pragma once
// How thick the layer of each pair is: the soft start of pairs that are born
// inside it, the raise for fast closing, and what is kept from step to step.
#include <vector>

#include "forming_sim/contact/pair.h"
#include "forming_sim/parallel/team.h"

namespace forming_sim {

/// Kept of a pair that ended a step inside its layer.
struct PairRecord {
  PairKey key;
  std::int32_t own, surface;  ///< surfaces of the first and of the second feature
  double layer;  ///< h0 of the pair, m
  double gap;    ///< h at the end of the step, m
  double force = 0;             ///< mean of the step along the normal, N
  double drag[3] = {0, 0, 0};   ///< of friction, N
};

/// Sets `layer` of all pairs, and impulse and slip of known ones to those of the step before, from which
/// the sweeps start, or where the step was `tried` already to those that this found; all lists in the order of the keys.
///  known            as it was; never more than half a layer for edges out of their wedge
///  new, h >= base   base, or .1 of the closing motion of the step where that is more, but not above h or `ceiling`
///  new, h < base    h: no force at first. Where the vertex or edge of either side has just left another
///                   feature of the other surface, that pair's layer goes over, to one new pair, so that
///                   the potential, a function of h/h0, does not rise.
/// dt: of the step; last_dt: of the step before; work.v: predicted velocities. full: h0. The force that stops things in
/// a short step is not that of a longer one: a pair starts from no more than the impulse that the step before had.
void assign_layers(const std::vector<PairRecord>& before, const std::vector<PairRecord>& tried, const Workspace& work, double dt, double last_dt, double full, double ceiling, Team& team,
                   std::vector<ContactPair>& pairs, std::vector<Rub>& rubs);

/// What is known of a pair at the end of a step of dt.
PairRecord record_of(const ContactPair& pair, const std::vector<Rub>& rubs, double dt);

/// Potential of pairs at their end gaps, J, before and after relax_layer;
/// the difference is the work of the layers' growth.
struct RelaxedPotential {
  double before = 0, after = 0;
};
/// Lets the layer of a pair grow (or shrink) to its base by at most `growth`, adds its
/// potential, and keeps the pair in `after` where it is inside. dt: of the step that ends.
void relax_layer(double dt, double growth, const std::vector<Rub>& rubs, ContactPair& pair, RelaxedPotential& potential, std::vector<PairRecord>& after);

}  // namespace forming_sim
