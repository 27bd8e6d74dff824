#include "forming_sim/mesh/profile.h"

#include <cmath>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/arc.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

constexpr double kSamePoint = 1e-9;  // of the profile's size

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw Error(Code::mesh_error, "profile" + where + ": " + what);
}

std::string piece_name(std::size_t i) { return ".pieces[" + std::to_string(i) + "]"; }

void check_point(const std::string& where, const Vec3& x) {
  if (!x.allFinite()) refuse(where, "given " + place(x) + "; every coordinate must be a finite number");
  if (x.z() != 0) refuse(where, "given " + place(x) + "; a profile lies in z = 0");
}

// Appends the nodes of the arc after its start; positive radius: centre on the left.
void append_arc(std::vector<Vec3>& nodes, const Vec3& to, double radius, double chord_error, double longest, const std::string& where) {
  const Vec3 from = nodes.back(), chord = to - from;
  const double half = chord.norm() / 2, r = std::abs(radius);
  if (r < half * (1 - 1e-6)) {  // half a circle may be given in six digits
    std::ostringstream text;
    text << "given a radius of " << r << " m for an arc from " << place(from) << " to " << place(to)
         << "; at least half their distance, " << half << " m, is needed";
    refuse(where, text.str());
  }
  const double height = std::sqrt(std::max(0.0, r * r - half * half));  // of the centre over the chord
  const Vec3 left = Vec3(-chord.y(), chord.x(), 0).normalized();
  const double turn = radius > 0 ? 1 : -1;
  const Vec3 centre = (from + to) / 2 + turn * height * left;
  const double angle = 2 * std::atan2(half, height);
  const int segments = segments_of_arc(angle, r, chord_error, longest);
  const Vec3 arm = from - centre;
  for (int k = 1; k < segments; ++k) {
    const double a = turn * angle * k / segments, c = std::cos(a), s = std::sin(a);
    nodes.push_back(centre + Vec3(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y(), 0));
  }
  nodes.push_back(to);
}

}  // namespace

Mesh mesh_profile(const ProfileConfig& profile, double longest) {
  if (profile.pieces.empty()) refuse(".pieces", "given none; at least one line or arc is needed");
  if (!std::isfinite(profile.chord_error) || profile.chord_error < 0)
    refuse(".chord_error", "given " + std::to_string(profile.chord_error) + "; a length of at least 0 m is needed");
  check_point(".start", profile.start);
  Eigen::AlignedBox3d box(profile.start);
  for (std::size_t i = 0; i < profile.pieces.size(); ++i) {
    check_point(piece_name(i) + ".to", profile.pieces[i].to);
    box.extend(profile.pieces[i].to);
  }
  const double same = kSamePoint * box.diagonal().norm();

  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes.push_back(profile.start);
  for (std::size_t i = 0; i < profile.pieces.size(); ++i) {
    const ProfilePieceConfig& piece = profile.pieces[i];
    if (!std::isfinite(piece.radius)) refuse(piece_name(i) + ".radius", "given a number that is not finite; give 0 for a line or a radius");
    if ((piece.to - mesh.nodes.back()).norm() <= same)
      refuse(piece_name(i), "ends at " + place(piece.to) + ", where it starts; a piece needs a length");
    if (piece.radius == 0)
      mesh.nodes.push_back(piece.to);
    else
      append_arc(mesh.nodes, piece.to, piece.radius, profile.chord_error, longest, piece_name(i) + ".radius");
  }
  // A way that returns to its start shares the node there.
  const bool returns = (mesh.nodes.back() - mesh.nodes.front()).norm() <= same;
  if (returns) mesh.nodes.pop_back();
  if (profile.closed && mesh.nodes.size() < 3) refuse("", "a closed profile needs at least two pieces that enclose an area");
  const int count = static_cast<int>(mesh.nodes.size());
  for (int n = 0; n + 1 < count; ++n) mesh.surface.push_back({{n, n + 1, -1}, -1});
  if (returns || profile.closed) mesh.surface.push_back({{count - 1, 0, -1}, -1});
  return mesh;
}

}  // namespace forming_sim
