// What each stage of a step costs.
#include <cmath>

#include "contact_costs.h"
#include "layer_costs.h"
#include "rows.h"
#include "support/bodies.h"

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
    NodeField x = X, v(X.size(), Node::Zero()), f(X.size());
    long calls = 0;
    const double force = least_time([&] {
      // To and fro, so that the material yields in most calls.
      const double stretch = 1 + 0.02 * std::sin(0.05 * static_cast<double>(calls++));
      for (std::size_t i = 0; i < x.size(); ++i) x[i][0] = stretch * X[i][0];
      engine.forces(x, v, 1e-8, 1e-8, f);
    });
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
  rest_costs(rows);
  layer_costs(rows);
  contact_costs(rows);
  return rows;
}

}  // namespace forming_sim::bench
