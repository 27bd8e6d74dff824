#pragma once
// Points of a feature that lie nearly at its held nodes, while others of it are free: a corner of a tool flush with a clamped end, two bodies that meet in a plane of
// symmetry. What presses there has next to no lever on the free nodes, b << 1, and to move them as it asks would take 1/b times the impulse it can mean, which the
// held nodes would take up. There the held nodes alone count for the point: what they can move for moves them, and what they cannot ends the run by its name.
#include <cmath>

#include "forming_sim/contact/pair.h"

namespace forming_sim {

constexpr double kLever = 0.01;  ///< of the weights; squared of inverse masses

/// Of the link's nodes from first to before end, those of one feature. Whether that has changed their weights.
inline bool leave_to_held(const Workspace& work, int first, int end, Link& link) {
  double held = 0, free = 0;
  for (int k = first; k < end; ++k) (work.share[link.node[k]].held != 0 ? held : free) += std::abs(link.weight[k]);
  if (free == 0 || !(free < kLever * held)) return false;
  const double whole = (held + free) / held;
  for (int k = first; k < end; ++k) link.weight[k] *= work.share[link.node[k]].held != 0 ? whole : 0;
  return true;
}

/// The part of a vector along which next to nothing of the pair can move: its nodes are held there.
Vec3 closed_part(const Workspace& work, const ContactPair& pair, const Vec3& vector);
/// The part of an impulse on the pair that moves something. The rest of it sweeps would leave at whatever it was.
Node moving_part(const Workspace& work, const ContactPair& pair, const Node& impulse);

/// Of bodies that stick whatever it takes a normal whose closed part is small is put right across it, as it is where a surface meets a plane of symmetry. Else friction,
/// which goes across the normal, would have to be very large to have a small part along what can move. The gap stays that of the normal before, up to 2 % more.
void straighten(const Workspace& work, ContactPair& pair);

}  // namespace forming_sim
