#pragma once
// Ridges and wedges: bodies and tools that meet edge on edge.
#include "contact/point_bodies.h"

namespace contact_test {

// A ridge along x on the z = 0 plane side, its crest at height 0, turned by `angle` about z.
inline Mesh ridge(double half_length, double half_width, double depth, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto at = [&](double x, double y, double z) { return Vec3(c * x - s * y, s * x + c * y, z); };
  return triangles({at(-half_length, 0, 0), at(half_length, 0, 0), at(-half_length, -half_width, -depth), at(half_length, -half_width, -depth),
                    at(-half_length, half_width, -depth), at(half_length, half_width, -depth)},
                   {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}});
}

// A body whose lowest feature is one straight edge along x from -half to half
// at height z: a wedge of lumped nodes held together by springs.
inline void add_wedge(World& world, double half, double z, double stiffness) {
  const double p[6][3] = {{-half, 0, z}, {half, 0, z}, {-half, -.3, z + .4}, {half, -.3, z + .4}, {-half, .3, z + .4}, {half, .3, z + .4}};
  for (const auto& q : p) {
    world.x.push_back(Node(q[0], q[1], q[2], 0));
    world.mass.push_back(10);
  }
  world.v.resize(6, Node::Zero());
  ContactSurface s;
  s.name = "wedge";
  for (std::array<int, 3> c : {std::array<int, 3>{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}}) {
    Facet f;
    f.nodes = c;
    s.facets.push_back(f);
  }
  world.bodies.push_back(s);
  for (int a = 0; a < 6; ++a)
    for (int b = a + 1; b < 6; ++b) world.springs.push_back({a, b, (world.x[a] - world.x[b]).norm(), stiffness});
}

}  // namespace contact_test
