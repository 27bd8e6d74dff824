#pragma once
// What a pair is given before it can act: its stiffness E A h0, the inverse mass
// that it feels, its friction.
#include <vector>

#include "forming_sim/contact/features.h"
#include "forming_sim/contact/pair.h"

namespace forming_sim {

struct PairConstants {
  const Features& features;
  const Workspace& work;
  double modulus, layer;  ///< E, Pa; h0, m

  /// Sets stiffness, tool, w and, where the surfaces rub, adds a Rub. A is the mean
  /// area of the pair's deformable nodes. A pair that nothing can move gets
  /// stiffness 0 and w 0.
  void set(ContactPair& pair, std::vector<Rub>& rubs) const;
};

}  // namespace forming_sim
