// What each stage of a step costs.
#include <cmath>
#include <fstream>

#include "contact_costs.h"
#include "forming_sim/mesh/import.h"
#include "layer_costs.h"
#include "mesh/msh_texts.h"
#include "rows.h"
#include "scratch.h"
#include "support/bodies.h"
#include "support/free_mesh.h"
#include "timed_body.h"

namespace forming_sim::bench {
namespace {

struct Family {
  CellKind kind;
  const char* average;
  double goal;  ///< ns an element and step, elements of the size of a cache
};

BodyModel block(const Family& family, int elements) {
  const CellShape& shape = shape_of(family.kind);
  const double cells = static_cast<double>(elements) / (family.kind == CellKind::tetrahedron ? 6 : family.kind == CellKind::triangle ? 2 : shape.points);
  const int n = std::max(2, static_cast<int>(std::lround(shape.dimension == 2 ? std::sqrt(cells) : std::cbrt(cells))));
  return body_of(block_of(family.kind, n), aluminium(true), family.average);
}

/// Seconds of the forces of a body that is stretched to and fro, so that the material yields in most calls.
double time_of_forces(Elements& engine, const NodeField& X, NodeField& x) {
  const NodeField v(X.size(), Node::Zero());
  NodeField f(X.size());
  long calls = 0;
  return least_time([&] {
    const double stretch = 1 + 0.02 * std::sin(0.05 * static_cast<double>(calls++));
    for (std::size_t i = 0; i < x.size(); ++i) x[i][0] = stretch * X[i][0];
    engine.forces(x, v, 1e-8, 1e-8, f);
  });
}

/// Forces and time step of one block, stretched into yield step by step.
void element_costs(const Family& family, int elements, const char* size, std::vector<Row>& rows) {
  const Clock clock;
  const BodyModel body = block(family, elements);
  const int D = body.mesh.dimension;
  const NodeField X = positions_of(body.mesh);
  double one_thread = 0;
  for (int threads : {1, 2}) {
    Elements engine({body}, D, X, ElementOptions(), threads);
    const double count = static_cast<double>(engine.simplices().size()) / shape_of(family.kind).simplices * shape_of(family.kind).points;
    NodeField x = X;
    const NodeField v(X.size(), Node::Zero());
    const double force = time_of_forces(engine, X, x);
    const std::string name = std::string(shape_of(family.kind).name) + ", p per " + family.average + ", " + size;
    if (threads == 1) {
      one_thread = force;
      rows.push_back(at_most(name, "forces, ns an element", 1e9 * force / count, family.goal, clock.seconds()));
      double dt;
      int element;
      const double bound = least_time([&] { engine.stable_step(x, v, dt, element); });
      rows.push_back(just(name, "time step, ns an element", 1e9 * bound / count, clock.seconds()));
    } else {
      rows.push_back(just(name, "forces, 1 thread over 2", one_thread / force, clock.seconds()));
    }
  }
}

/// A file of tetrahedra as gmsh numbers them.
void file_costs(std::vector<Row>& rows) {
  const Clock clock;
  const Mesh made = free_box(Vec3(1, 1, 0.2), 0.023);
  const Scratch scratch;
  std::ofstream(scratch.path() + "/box.msh") << msh::tetrahedra(made.nodes, made.cells[0].nodes);
  MeshConfig config;
  config.url = "box.msh";
  config.unit_scale = 1;
  const Family free{CellKind::tetrahedron, "node", 0};
  const auto time_of = [&](const BodyModel& body) {
    const NodeField X = positions_of(body.mesh);
    NodeField x = X;
    Elements engine({body}, 3, X, ElementOptions(), 1);
    return 1e9 * time_of_forces(engine, X, x) / static_cast<double>(engine.simplices().size());
  };
  std::vector<std::string> nothing_odd;
  const double of_file = time_of(body_of(load_body_mesh(config, scratch.path(), nothing_odd), aluminium(true), free.average)), of_block = time_of(block(free, made.cells[0].count()));
  const std::string name = std::to_string(made.cells[0].count()) + " tetrahedra of a file by gmsh";
  rows.push_back(just(name, "forces, ns an element", of_file, clock.seconds()));
  rows.push_back(just(name, "forces, of those of a block in order", of_file / of_block, clock.seconds()));
}

/// Forces of a body that waits, over those of one that moves.
void rest_costs(std::vector<Row>& rows) {
  const Clock clock;
  const BodyModel body = block({CellKind::hex24, "cell", 0}, 100000);
  NodeField x = positions_of(body.mesh);
  Elements engine({body}, 3, x, ElementOptions(), 1);
  const NodeField v(x.size(), Node::Zero());
  NodeField f(x.size());
  const double waits = least_time([&] { engine.forces(x, v, 1e-8, 1e-8, f); });
  const double moves = least_time([&] {
    for (Node& n : x) n[0] *= 1 + 1e-12;
    engine.forces(x, v, 1e-8, 1e-8, f);
  });
  rows.push_back(just("a body at rest, hex24", "forces, of those of one that moves", waits / moves, clock.seconds()));
}

/// Forces of a body of this material, over those of plain aluminium, all of which yields.
void law_costs(const std::string& what, const MaterialConfig& special, std::vector<Row>& rows) {
  for (CellKind kind : {CellKind::crossed, CellKind::hex24, CellKind::hex1}) {
    const Clock clock;
    std::vector<TimedBody> bodies;
    for (const MaterialConfig& material : {special, aluminium(true)}) bodies.emplace_back(kind, kind == CellKind::crossed ? 32 : kind == CellKind::hex24 ? 5 : 10, material, 0.02);
    const std::vector<std::vector<double>> ns = alternate(bodies, 30);
    const std::string name = what + ", " + shape_of(kind).name;
    rows.push_back(just(name, "forces, ns an element", *std::min_element(ns[0].begin(), ns[0].end()), clock.seconds()));
    rows.push_back(just(name, "forces, of those without", median_ratio(ns[0], ns[1]), clock.seconds()));
  }
}

MaterialConfig with_r_values() {
  MaterialConfig rolled = aluminium(true);
  rolled.anisotropy.emplace();
  rolled.anisotropy->r0 = 0.7, rolled.anisotropy->r45 = 0.6, rolled.anisotropy->r90 = 0.8;
  return rolled;
}

MaterialConfig raised_by_rate(const std::string& law) {
  MaterialConfig raised = aluminium(true);
  raised.rate_dependence.emplace();
  raised.rate_dependence->law = law;
  raised.rate_dependence->reference_rate = law == "cowper_symonds" ? 6500 : 1;
  raised.rate_dependence->exponent = 4;
  raised.rate_dependence->coefficient = 0.015;
  return raised;
}

/// Bytes a second of a sum over an array that no cache holds.
double bandwidth() {
  std::vector<double> a(32 << 20, 1.0);
  volatile double sink = 0;
  const double time = least_time([&] {
    double sum[8] = {};
    for (std::size_t i = 0; i < a.size(); i += 8)
      for (int k = 0; k < 8; ++k) sum[k] += a[i + k];
    sink = sum[0] + sum[1] + sum[2] + sum[3] + sum[4] + sum[5] + sum[6] + sum[7];
  });
  return static_cast<double>(a.size() * sizeof(double)) / time;
}

}  // namespace

std::vector<Row> costs(const Request&) {
  const Family families[] = {{CellKind::crossed, "cell", 8},      {CellKind::quad2, "cell", 8},        {CellKind::triangle, "node", 8},
                             {CellKind::hex24, "cell", 12},       {CellKind::hex6, "cell", 12},        {CellKind::tetrahedron, "node", 12},
                             {CellKind::quad1, "cell", 20},       {CellKind::hex1, "cell", 40}};
  std::vector<Row> rows;
  const Clock clock;
  const double speed = bandwidth();
  rows.push_back(just("this machine", "memory read, GB/s", 1e-9 * speed, clock.seconds()));
  for (const Family& family : families) {
    element_costs(family, 4000, "4k elements", rows);
    element_costs(family, 400000, "400k elements", rows);
  }
  file_costs(rows);
  rest_costs(rows);
  law_costs("r values", with_r_values(), rows);
  for (const char* law : {"cowper_symonds", "johnson_cook"}) law_costs(law, raised_by_rate(law), rows);
  layer_costs(rows);
  contact_costs(rows);
  return rows;
}

}  // namespace forming_sim::bench
