// Section 2.4: Wilkins' contact, which puts a node found inside back onto the
// surface: where it works, and where it lets something through; beside it the
// package's own contact on the same scenes. Crossings are counted by the
// independent check of all edges against all facets.
//
// The paper gives no scene for this. Chosen: the impact of figure 14; a wedge
// (half angle 1.1 degrees) whose tip meets a coarse block between two nodes; the
// same block falling half over a ledge; the corner of a block driven into a groove.
#include <cmath>

#include "forming_sim/config/fault.h"
#include "paper/figures.h"
#include "paper/two_bodies.h"
#include "support/runs.h"

namespace forming_sim::bench {
namespace {

struct Found {
  long crossings = 0, halvings = 0;
  double momentum = 0;     ///< of the body along y at the end, over that at the start
  double energy = 0;       ///< kinetic + elastic at the end over that at the start, less 1
  double wall_time = 0;    ///< s
  std::string error;
  NodeField x;
  Model model;
};

/// The body falls with `speed` on the tool for `duration`.
Found fall(BodyModel body, double speed, const std::vector<Vec3>& tool, const char* method, double layer, double duration) {
  const Clock clock;
  OneBody run(std::move(body), duration);
  run.plan.contact = mild(method, layer);
  run.plan.bodies[0].initial_velocity = Vec3(0, -speed, 0);
  ToolModel rigid;
  rigid.name = "tool";
  rigid.mesh.dimension = 2;
  rigid.mesh.nodes = tool;
  for (int i = 0, n = static_cast<int>(tool.size()); i < n; ++i) {
    Facet side;
    side.nodes = {i, (i + 1) % n, -1};
    rigid.mesh.surface.push_back(side);
  }
  run.model.tools.push_back(rigid);
  Found found;
  found.model = run.model;
  auto sim = run.start();
  double mass = 0;
  for (double m : sim->nodal_mass()) mass += m;
  try {
    while (sim->step()) {}
  } catch (const Error& e) {
    found.error = e.what();
  }
  for (std::size_t i = 0; i < sim->velocities().size(); ++i) found.momentum -= sim->nodal_mass()[i] * sim->velocities()[i][1] / (mass * speed);
  const Energies& e = sim->energies();
  found.energy = (e.kinetic + e.elastic) / e.initial - 1;
  found.crossings = sim->contact_status().crossings;
  found.halvings = sim->contact_status().halvings;
  found.x = sim->positions();
  found.wall_time = clock.seconds();
  return found;
}

/// The surface of the body and the tool, at the end.
void draw(const std::string& name, const std::string& title, const Found& found, const std::vector<Vec3>& tool, const std::string& directory) {
  Figure figure(name, title, "x, m", "y, m");
  for (const Facet& f : found.model.bodies[0].mesh.surface) {
    for (int k : {0, 1}) figure.add("block", found.x[f.nodes[k]][0], found.x[f.nodes[k]][1]);
    figure.add("block", NAN, NAN);  // lifts the pen
  }
  for (std::size_t i = 0; i <= tool.size(); ++i) figure.add("tool", tool[i % tool.size()].x(), tool[i % tool.size()].y());
  figure.write(directory);
}

Row crossings(const std::string& name, const Found& found) {
  Row row = at_most(name, "crossings", static_cast<double>(found.crossings), 0, found.wall_time);
  row.holds = row.holds && found.error.empty();
  row.note = found.error;
  if (row.note.empty() && found.crossings > 0) row.note = "only nodes of the body are looked at: the tool's corner goes through the side between two of them";
  return row;
}

BodyModel block(const Vec3& low, double length, double height, int along, int through, double angle) {
  BlankConfig blank = strip_of(length, height, along, through);
  blank.pattern = "coarse";
  Mesh mesh = generate_blank(blank);
  for (Vec3& X : mesh.nodes) X = low + Vec3(std::cos(angle) * X.x() - std::sin(angle) * X.y(), std::sin(angle) * X.x() + std::cos(angle) * X.y(), 0);
  return body_of(std::move(mesh), aluminium(), "cell");
}

}  // namespace

std::vector<Row> section_2_4(const Request& request) {
  std::vector<Row> rows;
  const std::string section = "section 2.4";

  for (const char* method : {"geometric", "implicit"})
    for (int left : {20, 23}) {
      ImpactCase two;
      two.contact = mild(method, 0.01);
      two.through_left = left;
      const ImpactFound found = collide(two);
      const std::string name = section + ", " + (left == 20 ? "same meshes" : "20 on 23 cells") + (method[0] == 'g' ? ", geometric" : ", own");
      rows.push_back(near(name, "mean stress, Pa", found.mean, kImpactStress, 0.02, found.wall_time));
      rows.push_back(at_most(name, "crossings", static_cast<double>(found.crossings), 0, found.wall_time));
      rows.push_back(just(name, "energy at the end / start - 1", found.energy, found.wall_time));
      rows.push_back(at_most(name, "error of the ledger", found.balance, 0.01, found.wall_time));
      if (!rows.back().holds) rows.back().note = "the places of nodes that face no node are corrected twice, by the pass of each body, and their velocities know nothing of it";
    }

  const std::vector<Vec3> wedge{Vec3(.21, -1, 0), Vec3(.25, -1, 0), Vec3(.23, 0, 0)};
  const std::vector<Vec3> ledge{Vec3(.15, -1, 0), Vec3(.15, 0, 0), Vec3(-1.5, 0, 0), Vec3(-1.5, -1, 0)};
  const double slope = std::tan(M_PI / 6);
  const std::vector<Vec3> groove{Vec3(0, 0, 0), Vec3(1.5, 1.5 * slope, 0), Vec3(2.5, 1.5 * slope, 0), Vec3(2.5, -1, 0), Vec3(-2.5, -1, 0), Vec3(-2.5, 1.5 * slope, 0), Vec3(-1.5, 1.5 * slope, 0)};
  for (const char* method : {"geometric", "implicit"}) {
    const std::string by = method[0] == 'g' ? ", geometric" : ", own";
    const Found tip = fall(block(Vec3(-1, .01, 0), 2, 1, 4, 2, 0), 50, wedge, method, 1e-3, 8e-3);
    rows.push_back(crossings(section + ", tip between nodes" + by, tip));
    rows.push_back(just(section + ", tip between nodes" + by, "momentum left / at the start", tip.momentum, tip.wall_time));
    draw(std::string("section_2_4_tip_") + method, "A tip meets a block between two nodes" + by, tip, wedge, request.directory);
    const Found step = fall(block(Vec3(-1, .01, 0), 2, 1, 4, 2, 0), 20, ledge, method, 1e-3, 8e-3);
    rows.push_back(crossings(section + ", block half over a ledge" + by, step));
    const Found corner = fall(block(Vec3(.02, .1, 0), .4, .4, 4, 4, M_PI / 4), 500, groove, method, 1e-4, 1.2e-3);
    rows.push_back(crossings(section + ", corner in a groove" + by, corner));
    rows.push_back(just(section + ", corner in a groove" + by, "energy at the end / start - 1", corner.energy, corner.wall_time));
  }
  return rows;
}

}  // namespace forming_sim::bench
