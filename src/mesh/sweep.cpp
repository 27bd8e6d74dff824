#include "forming_sim/mesh/sweep.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/arc.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

constexpr double kOnAxis = 1e-9;  // of the section's size

[[noreturn]] void refuse(const std::string& where, const Vec3& point, const std::string& what) {
  throw Error(Code::mesh_error, "profile" + where + ": given " + place(point) + "; " + what);
}

/// z of the point becomes y of the section.
Vec3 in_section(const Vec3& point, const std::string& where) {
  if (point.y() != 0) refuse(where, point, "in dimension 3 a profile lies in y = 0: give [x, 0, z]");
  return Vec3(point.x(), point.z(), 0);
}

Mesh section_of(const ProfileConfig& profile, double longest) {
  ProfileConfig section = profile;
  section.start = in_section(profile.start, ".start");
  for (std::size_t i = 0; i < profile.pieces.size(); ++i)
    section.pieces[i].to = in_section(profile.pieces[i].to, ".pieces[" + std::to_string(i) + "].to");
  return mesh_profile(section, longest);
}

/// Two triangles between neighbouring copies of each segment, of which those that collapse are left out. node(k, n): of node n of the
/// section in its copy k.
template <class Node> void add_facets(const Mesh& section, int strips, Node&& node, Mesh& swept) {
  for (int k = 0; k < strips; ++k)
    for (const Facet& segment : section.surface) {
      const int a = node(k, segment.nodes[0]), b = node(k, segment.nodes[1]);
      const int next_a = node(k + 1, segment.nodes[0]), next_b = node(k + 1, segment.nodes[1]);
      if (a != next_a) swept.surface.push_back({{a, next_a, b}, -1});
      if (b != next_b) swept.surface.push_back({{next_a, next_b, b}, -1});
    }
}

Mesh sweep_straight(const Mesh& section, double width) {
  Mesh swept;
  for (const double y : {-width / 2, width / 2})
    for (const Vec3& p : section.nodes) swept.nodes.push_back({p.x(), y, p.y()});
  const int count = static_cast<int>(section.nodes.size());
  add_facets(section, 1, [&](int k, int n) { return k * count + n; }, swept);
  return swept;
}

/// A node on the axis is there once.
Mesh turn(const Mesh& section, double chord_error, double longest) {
  const double near = kOnAxis * size_of(section);
  double largest = 0;
  for (const Vec3& p : section.nodes) {
    if (p.x() < -near) refuse("", Vec3(p.x(), 0, p.y()), "it is turned about the axis z: give the section at x >= 0");
    largest = std::max(largest, p.x());
  }
  if (largest <= near) throw Error(Code::mesh_error, "profile: all of it lies on the axis z about which it is turned");
  const int parts = 4 * segments_of_arc(M_PI / 2, largest, chord_error, longest);
  Mesh swept;
  std::vector<int> first(section.nodes.size());  // of the copies of each node
  for (std::size_t n = 0; n < section.nodes.size(); ++n) {
    const Vec3& p = section.nodes[n];
    first[n] = static_cast<int>(swept.nodes.size());
    if (p.x() <= near) swept.nodes.push_back({0, 0, p.y()});
    else
      for (int k = 0; k < parts; ++k) {
        const int quarter = k / (parts / 4);
        const double angle = 2 * M_PI * (k % (parts / 4)) / parts, c = p.x() * std::cos(angle), s = p.x() * std::sin(angle);
        const Vec3 quarters[] = {{c, s, p.y()}, {-s, c, p.y()}, {-c, -s, p.y()}, {s, -c, p.y()}};  // the planes x = 0 and y = 0 hold their nodes exactly
        swept.nodes.push_back(quarters[quarter]);
      }
  }
  add_facets(section, parts, [&](int k, int n) { return section.nodes[n].x() <= near ? first[n] : first[n] + k % parts; }, swept);
  return swept;
}

}  // namespace

Mesh sweep_profile(const ProfileConfig& profile, double longest) {
  const Mesh section = section_of(profile, longest);
  return profile.sweep == "turned" ? turn(section, profile.chord_error, longest) : sweep_straight(section, profile.width);
}

}  // namespace forming_sim
