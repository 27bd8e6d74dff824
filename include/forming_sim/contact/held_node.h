#pragma once
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A node with held or prescribed directions. Contact changes its velocity
/// only within the range of the projector (identity minus the held directions).
struct HeldNode {
  int node = -1;
  Mat3 projector = Mat3::Zero();  ///< symmetric, P P = P
};

}  // namespace forming_sim
