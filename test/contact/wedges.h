#pragma once
// Ridges and wedges: bodies and tools that meet edge on edge.
#include "contact/point_bodies.h"

namespace contact_test {

/// A ridge along x, its crest at height 0, turned by `angle` about z.
inline Mesh ridge(double half_length, double half_width, double depth, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto at = [&](double x, double y, double z) { return Vec3(c * x - s * y, s * x + c * y, z); };
  return triangles({at(-half_length, 0, 0), at(half_length, 0, 0), at(-half_length, -half_width, -depth), at(half_length, -half_width, -depth),
                    at(-half_length, half_width, -depth), at(half_length, half_width, -depth)},
                   {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}});
}

/// A body whose lowest feature is one straight edge along x from -half to half
/// at height z: a wedge of lumped nodes held together by springs. Upside down and
/// turned by a right angle: its highest feature, along y.
inline void add_wedge(World& world, double half, double z, double stiffness, bool upside_down = false) {
  const int first = static_cast<int>(world.x.size());
  const double p[6][3] = {{-half, 0, 0}, {half, 0, 0}, {-half, -.3, .4}, {half, -.3, .4}, {-half, .3, .4}, {half, .3, .4}};
  for (const auto& q : p) {
    world.x.push_back(upside_down ? Node(q[1], q[0], z - q[2], 0) : Node(q[0], q[1], z + q[2], 0));
    world.mass.push_back(10);
  }
  world.v.resize(world.x.size(), Node::Zero());
  ContactSurface s;
  s.name = "wedge" + std::to_string(world.bodies.size());
  for (std::array<int, 3> c : {std::array<int, 3>{0, 3, 2}, {0, 1, 3}, {0, 5, 1}, {0, 4, 5}, {2, 5, 4}, {2, 3, 5}, {0, 2, 4}, {1, 5, 3}}) {
    Facet f;
    for (int k = 0; k < 3; ++k) f.nodes[k] = first + c[k];
    s.facets.push_back(f);
  }
  world.bodies.push_back(s);
  for (int a = first; a < first + 6; ++a)
    for (int b = a + 1; b < first + 6; ++b) world.springs.push_back({a, b, (world.x[a] - world.x[b]).norm(), stiffness});
}

}  // namespace contact_test
