#pragma once
// How finely what is round is divided.
#include <algorithm>
#include <cmath>

namespace forming_sim {

/// Segments that stand for an arc of `angle`, rad, and radius r, m. One over the angle a departs from the arc by r (1 - cos(a/2)): by no
/// more than the chord error; where that is 0, by 1e-3 of the radius, and no segment is longer than `longest`, m.
inline int segments_of_arc(double angle, double r, double chord_error, double longest) {
  constexpr double kChordError = 1e-3, kLargestChordError = .25;  // of the radius: an arc never loses its shape
  const double relative = std::min(chord_error > 0 ? chord_error / r : kChordError, kLargestChordError);
  double largest = 2 * std::acos(1 - relative);
  if (chord_error == 0) largest = std::min(largest, longest / r);
  return std::max(1, static_cast<int>(std::ceil(angle / largest - 1e-9)));
}

}  // namespace forming_sim
