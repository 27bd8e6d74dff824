#pragma once
// Scenes that need one safeguard of the contact each.
#include "contact/wedges.h"

namespace contact_test {

/// Two crossed ridges that touch between their nodes: only edge against edge can hold them.
inline World ridges(double speed, double layer) {
  World world;
  world.dimension = 3;
  add_wedge(world, .5, 0, 1e9);
  world.config.layer = layer;
  for (auto& v : world.v) v = Node(.1 * speed, 0, -speed, 0);
  world.add_tool("ridge", ridge(2, .5, .5, M_PI / 2), 0, [](double) { return Vec3(.13, .04, -.05); });
  return world;
}

/// Two ridges at a small angle, off by so much, m.
inline World knives(double angle, double off) {
  World world;
  world.dimension = 3;
  add_wedge(world, .5, 0, 1e9);
  world.config.layer = 2e-5;
  for (auto& v : world.v) v = Node(0, 0, -300, 0);
  world.add_tool("ridge", ridge(2, .1, .5, angle), 0, [off](double) { return Vec3(.03, off, -.02); });
  return world;
}

/// A strip that falls with its corner into a groove.
inline World groove(double half_angle, double layer) {
  World world;
  world.add_strip(Vec3(0, .75, 0), 2, 2, .1, .1, 2700, 3e9, M_PI / 4 + .03);
  world.config.layer = layer;
  for (auto& v : world.v) v = Node(13, -500, 0, 0);
  const double slope = 1 / std::tan(half_angle * M_PI / 180);
  world.add_tool("groove", polyline({Vec3(-1.5, 1.5 * slope, 0), Vec3(0, 0, 0), Vec3(1.5, 1.5 * slope, 0)}), 0, [](double) { return Vec3::Zero(); });
  return world;
}

}  // namespace contact_test
