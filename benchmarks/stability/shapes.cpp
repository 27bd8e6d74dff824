// Elements of bad shape: slivers, cells of 50 to 1, a sheet of one cell through its
// thickness. A free body that was set swinging must keep its energy.
#include <cmath>

#include "speed_error/flange.h"
#include "stability/stability.h"
#include "stepped_body.h"

namespace forming_sim::bench {
namespace {

/// Set swinging along x, elastic, for so many steps: largest change of the energy.
void swung(std::vector<Row>& rows, const std::string& name, const Mesh& mesh, long steps, const std::string& average) {
  const Clock clock;
  SteppedBody body(mesh, aluminium(), average);
  double dt = 0.9 * body.stable_step();
  double length = 0;
  for (const Node& X : body.X) length = std::max(length, X[0]);
  for (std::size_t n = 0; n < body.v.size(); ++n) body.v[n] = Node(20 * (body.X[n][0] / length - 0.5), 5 * std::sin(7 * body.X[n][0] / length), 0, 0);
  double start = 0, off = 0;
  std::string broken;
  try {
    for (long n = 0; n < steps; ++n) {
      if (n % 100 == 0) dt = std::min(dt, 0.9 * body.stable_step());
      body.accelerate(dt);
      if (n == 1) start = body.energy();
      if (n > 1 && n % 7 == 0) off = std::max(off, std::abs(body.energy() / start - 1));
      body.move(dt);
    }
  } catch (const Error& error) {
    broken = error.what();
  }
  rows.push_back(at_most(name, "false inversions", broken.empty() ? 0 : 1, 0, clock.seconds()));
  rows.back().note = broken;
  // The energy of the leapfrog's half steps swings by (w dt)^2/8 of the fastest motion's share, and must not grow.
  rows.push_back(at_most(name, "largest change of energy / energy", off, 0.05, clock.seconds()));
}

/// A block whose inner nodes are moved until the smallest simplex has `part` of its volume, or less.
Mesh with_slivers(double part) {
  Mesh mesh = block_of(CellKind::tetrahedron, 3);
  const auto simplices = mesh.simplices();
  const auto volume = [&](const std::array<int, 4>& s) {
    const Vec3 a = mesh.nodes[s[1]] - mesh.nodes[s[0]], b = mesh.nodes[s[2]] - mesh.nodes[s[0]], c = mesh.nodes[s[3]] - mesh.nodes[s[0]];
    return a.cross(b).dot(c) / 6;
  };
  const double whole = volume(simplices[0]);
  // Every third simplex: its last node moves towards the opposite face, as far as no other one inverts.
  for (std::size_t e = 0; e < simplices.size(); e += 3) {
    const auto& s = simplices[e];
    const Vec3 before = mesh.nodes[s[3]], normal = (mesh.nodes[s[1]] - mesh.nodes[s[0]]).cross(mesh.nodes[s[2]] - mesh.nodes[s[0]]).normalized();
    mesh.nodes[s[3]] -= (1 - part) * normal.dot(before - mesh.nodes[s[0]]) * normal;
    for (const auto& other : simplices)
      if (volume(other) < 0.5 * part * whole) {
        mesh.nodes[s[3]] = before;
        break;
      }
  }
  return mesh;
}

}  // namespace

std::vector<Row> bad_shapes(const Request&) {
  std::vector<Row> rows;
  for (double part : {0.1, 0.01, 0.001})
    for (const char* average : {"node", "element"}) {
      char name[80];
      std::snprintf(name, sizeof name, "slivers of %g of the volume, p per %s", part, average);
      swung(rows, name, with_slivers(part), 20000, average);
    }
  for (double aspect : {10., 50.})
    for (const char* pattern : {"fine", "coarse"}) {
      BlankConfig flat = strip_of(aspect * 0.01, 0.04, 4, 16);
      flat.length = 4 * aspect * 0.0025;
      flat.pattern = pattern;
      BlankConfig plate = flat;
      plate.shape = "plate";
      plate.width = 2 * aspect * 0.0025;
      plate.cells_across = 2;
      plate.cells_through = 4;
      plate.thickness = 4 * 0.0025;
      char name[80];
      std::snprintf(name, sizeof name, "cells of %g to 1, %s", aspect, pattern);
      swung(rows, std::string(name) + ", 2D", generate_blank(flat), 20000, "cell");
      swung(rows, std::string(name) + ", 3D", generate_blank(plate), 20000, "cell");
    }
  for (int through : {1, 2}) {
    const Flanged flanged = flange(flange_scene(through));
    const std::string name = "scenes/flange.yaml, " + std::to_string(through) + " through";
    rows.push_back(at_most(name, "failures", flanged.failure.empty() ? 0 : 1, 0, flanged.size.wall_time));
    rows.back().note = flanged.failure;
    if (!flanged.failure.empty()) continue;
    rows.push_back(at_most(name, "crossings", static_cast<double>(flanged.crossings), 0, flanged.size.wall_time));
    rows.push_back(at_most(name, "ledger error over work", flanged.ledger, 0.01, flanged.size.wall_time));
  }
  return rows;
}

}  // namespace forming_sim::bench
