#pragma once
// How finely what is round is divided.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "forming_sim/config/fault.h"

namespace forming_sim {

/// Segments that stand for an arc of `angle`, rad, and radius r, m. One over the angle a departs from the arc by r (1 - cos(a/2)): by no
/// more than the chord error; where that is 0, by 1e-3 of the radius, and no segment is longer than `longest`, m. Throws Error(mesh_error) where that takes more than 1e5.
inline int segments_of_arc(double angle, double r, double chord_error, double longest) {
  constexpr double kChordError = 1e-3, kLargestChordError = .25;  // of the radius: an arc never loses its shape
  constexpr double kMost = 1e5;
  const double relative = std::min(chord_error > 0 ? chord_error / r : kChordError, kLargestChordError);
  double largest = 2 * std::acos(1 - relative);
  if (chord_error == 0) largest = std::min(largest, longest / r);
  const double count = std::ceil(angle / largest - 1e-9);
  if (!(count <= kMost)) {
    std::ostringstream text;
    if (chord_error > 0) text << "profile.chord_error: given " << chord_error << " m, for which an arc of radius " << r << " m takes more than " << kMost << " segments; give at least " << 1e-9 * r << " m";
    else text << "profile: an arc of radius " << r << " m, " << angle * r << " m long, takes more than " << kMost << " segments of at most " << longest << " m (two edges of the bodies' cells, of what turns freely 3e-3 of its radius); give a smaller radius, or a chord_error";
    throw Error(Code::mesh_error, text.str());
  }
  return std::max(1, static_cast<int>(count));
}

}  // namespace forming_sim
