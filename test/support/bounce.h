#pragma once
// A rigid areal mass m falls at speed v on a mild layer, p = c (1/h - 1/h0): VERIFICATION 10. With phi = m v^2 / (2 c) the
// least gap solves h/h0 - 1 - ln(h/h0) = phi, the contact lasts 2 int dh / sqrt(v^2 - 2 c/m [h/h0 - 1 - ln(h/h0)]), and the rebound has speed v.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "contact/point_bodies.h"
#include "support/run_size.h"

namespace forming_sim::bounce {

struct Exact {
  double phi, least;   ///< h_min/h0
  double duration;     ///< contact time T v/h0
};
constexpr Exact kExact[] = {{.1, .616817, 1.150815}, {.5, .301710, 1.959688}, {1, .158594, 2.227655}, {2, .052469, 2.303254}};

struct Found {
  double least, duration, rebound;  ///< h_min/h0, T v/h0, speed after over that before
  double closure;                   ///< of the ledger over the work that contact did
  RunSize run;
};

/// A row of nodes (2D) or a plate (3D) of 1 kg to each node's 1 m2 (1 m), on a plane. method: explicit | implicit;
/// dt in parts of h0/v. The nodes inside are looked at, which have their full area.
inline Found fall(const std::string& method, int dimension, double phi, double dt) {
  contact_test::World world;
  world.dimension = dimension;
  const double speed = 2, h0 = 1e-3;
  const Vec3 start(0, dimension == 2 ? 1.5 * h0 : 0, dimension == 3 ? 1.5 * h0 : 0);
  if (dimension == 2)
    world.add_strip(start, 4, 1, 1, 1, 1, 0);
  else
    world.add_box(start, 4, 4, 1, 1, 1, 0);
  for (double& m : world.mass) m = 1;
  const int inside = dimension == 2 ? 2 : 12, up = dimension - 1;  // in the middle of the lower face
  world.config.method = method;
  world.config.layer = h0;
  world.config.stiffness = speed * speed / (2 * phi * h0);
  for (auto& v : world.v) v = node(-speed * Vec3::Unit(up));
  world.add_plane("plane", Vec3::Zero(), Vec3::Unit(up), 0, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  Found found{1, 0, 0, 0, {}};
  const auto began = std::chrono::steady_clock::now();
  double touched = 0;
  while ((world.v[inside][up] < 0 || world.last.active > 0) && world.time < 100 * h0 / speed) {
    world.step(contact, dt * h0 / speed, false);
    ++found.run.steps;
    // The plane stands back by the layer from the surface that was given.
    found.least = std::min(found.least, 1 + world.x[inside][up] / h0);
    if (world.x[inside][up] < 0) touched += world.last.dt;
  }
  found.run.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  found.run.unknowns = static_cast<long>(world.x.size()) * dimension;
  found.duration = touched * speed / h0;
  found.rebound = world.v[inside][up] / speed;
  found.closure = std::abs(world.closure()) / world.exchanged;
  return found;
}

}  // namespace forming_sim::bounce
