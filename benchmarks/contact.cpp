// Two blocks meet: speeds from .5 to 1500 m/s, layers h0 from 1e-1 to 1e-6 of a
// cell, meshes that match or not, tilted, in the plane and in space, elastic, and
// plastic (tilted), and with a cut in the one that the blow closes, so that it meets
// itself. Nothing may cross. And, where they are asked for, the long run of
// benchmarks/contact_shaken.cpp and the exact answers of benchmarks/contact_exact.cpp.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "contact_exact/problems.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/contact/grid.h"
#include "rows.h"
#include "shaken.h"
#include "support/runs.h"

namespace forming_sim::bench {
namespace {

constexpr long kMostSteps = 4000, kMostHalvings = 20000;  // a run that needs more is stopped, and does not hold

struct Scene {
  const char* name;
  int dimension;
  int cells, other_cells;  ///< over the 1 m of a block
  double tilt;             ///< of the other block, rad
  bool plastic;
  bool cut = false;        ///< through half of the left block
};

struct Found {
  long crossings = 0, halvings = 0, steps = 0;
  double linear = 0, angular = 0;  ///< drift of the momenta over the momentum of one block (times 1 m)
  double lost = 0;                 ///< what contact dissipated over the energy at the start
  double balance = 0;              ///< of the ledger
  double least_gap = 1;            ///< over h0
  double step_time = 0, wall_time = 0;  ///< s
  std::string error;
};

/// Cuts a block of five cells a side along a plane of nodes, from its top to the
/// second row, and opens the cut by `gap`.
void cut(Mesh& mesh, double gap) {
  Box box;
  for (const Vec3& X : mesh.nodes) box.add(node(X));
  const double x = box.low[0] + 0.6, y = box.low[1] + 0.4;
  std::map<int, int> twin;
  const int whole = static_cast<int>(mesh.nodes.size());
  for (int i = 0; i < whole; ++i) {
    if (std::abs(mesh.nodes[i].x() - x) > 1e-9 || mesh.nodes[i].y() < y + 1e-9) continue;
    twin[i] = static_cast<int>(mesh.nodes.size());
    mesh.nodes.push_back(mesh.nodes[i] + Vec3(gap, 0, 0));
  }
  for (Cells& cells : mesh.cells) {
    const int corners = shape_of(cells.kind).nodes;
    for (int c = 0; c < cells.count(); ++c) {
      int* nodes = &cells.nodes[c * corners];
      double centre = 0;
      for (int a = 0; a < corners; ++a) centre += mesh.nodes[nodes[a]].x() / corners;
      if (centre < x) continue;
      for (int a = 0; a < corners; ++a)
        if (twin.count(nodes[a])) nodes[a] = twin[nodes[a]];
    }
  }
  find_surface(mesh);
}

BodyModel block(const Scene& scene, int side, double layer) {
  const int n = side == 0 ? scene.cells : scene.other_cells;
  BlankConfig blank;
  blank.shape = scene.dimension == 2 ? "strip" : "plate";
  blank.pattern = scene.dimension == 2 ? "fine" : "coarse";
  blank.length = blank.width = blank.thickness = 1;
  blank.cells_along = blank.cells_across = blank.cells_through = n;
  Mesh mesh = generate_blank(blank);
  if (scene.cut && side == 0) cut(mesh, 1.1 * layer);
  // About all axes in space, so that edges meet edges and corners faces.
  const Vec3 axis = scene.dimension == 2 ? Vec3(0, 0, 1) : Vec3(.3, .5, 1).normalized();
  const Mat3 turn = Eigen::AngleAxisd(side == 0 ? 0 : scene.tilt, axis).toRotationMatrix();
  for (Vec3& X : mesh.nodes) X = turn * X;
  BodyModel body = body_of(std::move(mesh), aluminium(scene.plastic));
  body.name = side == 0 ? "left" : "right";
  body.self_contact = scene.cut && side == 0;
  return body;
}

/// The blocks fly at each other along x, each with `speed`; alone: only that side, free.
Found meet(const Scene& scene, double speed, double layer, int alone = -1) {
  const Clock clock;
  const double sound = 6300, cell = 1.0 / std::max(scene.cells, scene.other_cells);  // m/s, m
  const double gap = 1.02 * layer + 2 * speed * cell / sound;
  Model model;
  RunPlan plan;
  model.dimension = scene.dimension;
  plan.stages.push_back(form_for(gap / (2 * speed) + 5 / sound));
  plan.contact.layer = layer;
  for (int side = 0; side < 2; ++side) {
    if (alone >= 0 && alone != side) continue;
    BodyModel body = block(scene, side, layer);
    double least = 1e300;
    for (const Vec3& X : body.mesh.nodes) least = std::min(least, side == 0 ? -X.x() : X.x());
    for (Vec3& X : body.mesh.nodes) X.x() += side == 0 ? least - gap / 2 : gap / 2 - least;
    add_flying(model, plan, std::move(body), side == 0 ? "left" : "right", Vec3(side == 0 ? speed : -speed, 0, 0));
  }
  Found found;
  Simulation sim(plan, model, 1);
  double mass = 0;
  for (double m : sim.nodal_mass()) mass += m / 2;
  Momenta start;
  try {
    while (sim.step()) {
      const long halvings = sim.contact_status().halvings;
      if (sim.steps() == kMostSteps || halvings >= kMostHalvings) {
        char text[160];
        std::snprintf(text, sizeof text, "stopped at %.0f %% of its time after %ld steps, %ld halvings", 100 * sim.progress(), sim.steps(), halvings);
        found.error = text;
        break;
      }
      const Momenta now = momenta(sim);
      if (sim.steps() == 1) start = now;
      found.linear = std::max(found.linear, (now.linear - start.linear).norm() / (mass * speed));
      found.angular = std::max(found.angular, (now.angular - start.angular).norm() / (mass * speed));
    }
  } catch (const Error& e) {
    found.error = e.what();
  }
  const Energies& e = sim.energies();
  const ContactStatus status = sim.contact_status();
  found.lost = e.contact / e.initial;
  found.balance = sim.balance_error();
  found.crossings = status.crossings;
  found.halvings = status.halvings;
  found.least_gap = status.min_gap_over_layer;
  found.steps = sim.steps();
  found.step_time = sim.wall_time() / static_cast<double>(sim.steps());
  found.wall_time = clock.seconds();
  return found;
}

std::vector<Row> blocks_that_meet() {
  const Scene scenes[] = {{"2D, same meshes", 2, 16, 16, 0, false},      {"2D, 16 on 19", 2, 16, 19, 0, false},
                          {"2D, 16 on 19, tilted", 2, 16, 19, .1, false}, {"2D, 16 on 19, plastic", 2, 16, 19, .1, true},
                          {"3D, same meshes", 3, 5, 5, 0, false},        {"3D, 5 on 6", 3, 5, 6, 0, false},
                          {"3D, 5 on 6, tilted", 3, 5, 6, .1, false}, {"3D, 5 on 6, plastic", 3, 5, 6, .1, true},
                          {"3D, 5 on 6, onto itself", 3, 5, 6, .1, false, true}};
  std::vector<Row> rows;
  for (const Scene& scene : scenes) {
    const double free = meet(scene, 5, 1e-3, 0).step_time + meet(scene, 5, 1e-3, 1).step_time;
    const double cell = 1.0 / std::max(scene.cells, scene.other_cells);
    for (double speed : {.5, 50., 500., 1500.}) {
      if (scene.plastic && speed > 1000) continue;  // 12 GPa: elements that only yield are pressed to nothing
      for (double ratio : {1e-1, 1e-3, 1e-6}) {
        const Found found = meet(scene, speed, ratio * cell);
        char name[96];
        std::snprintf(name, sizeof name, "%s, %g m/s, h0/dx %.0e", scene.name, speed, ratio);
        Row row = at_most(name, "crossings", static_cast<double>(found.crossings), 0, found.wall_time);
        row.holds = row.holds && found.error.empty();
        row.note = found.error;
        rows.push_back(row);
        rows.push_back(just(name, "halvings", static_cast<double>(found.halvings), found.wall_time));
        rows.push_back(just(name, "steps", static_cast<double>(found.steps), found.wall_time));
        rows.push_back(just(name, "least gap / h0", found.least_gap, found.wall_time));
        rows.push_back(at_most(name, "drift of momentum", found.linear, 1e-12, found.wall_time));
        rows.push_back(just(name, "drift of angular momentum", found.angular, found.wall_time));
        rows.push_back(just(name, "energy that contact took / at the start", found.lost, found.wall_time));
        rows.push_back(at_most(name, "energy that contact gave / at the start", std::max(0.0, -found.lost), 1e-6, found.wall_time));
        rows.push_back(at_most(name, "error of the ledger", found.balance, 0.01, found.wall_time));
        rows.push_back(just(name, "time of a step / without contact", found.step_time / free, found.wall_time));
      }
    }
  }
  return rows;
}

}  // namespace

std::vector<Row> contact(const Request& request) {
  const std::string run = request.arguments.empty() ? "" : request.arguments[0];
  if (run == "exact") return contact_exact({request.directory, {request.arguments.begin() + 1, request.arguments.end()}});
  if (run != "" && run != "shaken") throw std::runtime_error(run + " is not one of the runs of contact; give shaken, exact, or nothing for the two blocks");
  if (request.arguments.size() > 1) throw std::runtime_error(request.arguments[1] + ": nothing is chosen after shaken");
  const std::vector<Row> rows = run == "" ? blocks_that_meet() : shaken();
  print(rows);
  return rows;
}

}  // namespace forming_sim::bench
