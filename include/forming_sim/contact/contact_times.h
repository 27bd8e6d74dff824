#pragma once
// Where contact spends its time, for who asks for it.

namespace forming_sim {

/// Wall time of the parts of contact, s, summed over the steps (method implicit).
struct ContactTimes {
  double list = 0;    ///< bounds on the motion, and which features are near
  double narrow = 0;  ///< from listed features to pairs: places, closest points, constants, layers
  double lanes = 0;   ///< pairs into tiles and lanes, and back
  double sweeps = 0;
  double check = 0;   ///< the continuous check
  double books = 0;   ///< energies, tool forces, layers that grow
};

}  // namespace forming_sim
