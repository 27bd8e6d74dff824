#pragma once
// Points of a feature that lie nearly at its held nodes, while others of it are free: a corner of a tool flush with a clamped end, two bodies that meet in a plane of
// symmetry. What presses there has next to no lever on the free nodes, b << 1, and to move them as it asks would take 1/b times the impulse it can mean, which the
// held nodes would take up. There the held nodes alone count for the point: what they can move for moves them, and what they cannot ends the run by its name.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "forming_sim/contact/pair.h"

namespace forming_sim {

constexpr double kLever = 0.01;  ///< of the weights

/// Of the link's nodes from first to before end, those of one feature. Whether that has changed their weights.
inline bool leave_to_held(const Workspace& work, int first, int end, Link& link) {
  double held = 0, free = 0;
  for (int k = first; k < end; ++k) (work.share[link.node[k]].held != 0 ? held : free) += std::abs(link.weight[k]);
  if (free == 0 || !(free < kLever * held)) return false;
  const double whole = (held + free) / held;
  for (int k = first; k < end; ++k) link.weight[k] *= work.share[link.node[k]].held != 0 ? whole : 0;
  return true;
}

/// Calls visit(d) for the unit vectors d along which next to nothing of the pair can move: its nodes are held along them.
template <class Visit> void each_closed_direction(const Workspace& work, const ContactPair& pair, Visit&& visit) {
  Mat3 W = Mat3::Zero();  // inverse mass of the pair, 1/kg
  double free = 0;        // were nothing held
  for (int k = 0; k < pair.nodes; ++k) {
    const double b2m = pair.weight[k] * pair.weight[k] * work.share[pair.node[k]].inverse_mass;
    const Mat3* projector = work.projector[pair.node[k]];
    W += b2m * (projector ? *projector : Mat3(Mat3::Identity()));
    free += b2m;
  }
  Eigen::SelfAdjointEigenSolver<Mat3> along;
  along.computeDirect(W);
  for (int i = 0; i < 3; ++i)
    if (along.eigenvalues()[i] < kLever * kLever * free) visit(along.eigenvectors().col(i));
}

/// The part of an impulse on the pair that moves something. Along closed directions sweeps would leave it at whatever it was.
inline Node moving_part(const Workspace& work, const ContactPair& pair, const Node& impulse) {
  Vec3 moving = vec3(impulse);
  each_closed_direction(work, pair, [&](const Vec3& d) { moving -= d.dot(moving) * d; });
  return node(moving);
}

/// A normal that is nearly across a closed direction is put right across it, as it is where a surface meets a plane of symmetry. Else friction, which goes across the
/// normal, would have to be very large to have a small part along what can move.
inline void straighten(const Workspace& work, ContactPair& pair) {
  constexpr double kNearly = 0.2;
  Vec3 normal = vec3(pair.normal);
  each_closed_direction(work, pair, [&](const Vec3& d) {
    if (std::abs(d.dot(normal)) < kNearly) normal = (normal - d.dot(normal) * d).normalized();
  });
  pair.normal = node(normal);
}

}  // namespace forming_sim
