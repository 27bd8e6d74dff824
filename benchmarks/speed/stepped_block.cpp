#include "speed/stepped_block.h"

#include <cmath>
#include <limits>

#include "forming_sim/element/nodes.h"
#include "forming_sim/parallel/stage_clock.h"
#include "forming_sim/simulation/config.h"
#include "rows.h"

namespace forming_sim::bench {
namespace {

constexpr double kDt = 1e-8;         // s, of no consequence here
constexpr double kTurnTime = 0.015;  // s, about how long a turn lasts

int cells_along(CellKind kind, double elements) {
  const CellShape& shape = shape_of(kind);
  const double in_a_cell = kind == CellKind::tetrahedron ? 6 : kind == CellKind::triangle ? 2 : shape.points;
  const double cells = elements / in_a_cell;
  return std::max(2, static_cast<int>(std::lround(shape.dimension == 2 ? std::sqrt(cells) : std::cbrt(cells))));
}

MaterialConfig layered(int layers, const char* curve) {
  MaterialConfig material = aluminium_by(curve);
  if (layers == 1) return material;
  for (int k = 0; k < layers; ++k) material.layers.push_back({1.0 / layers, material.hardening});
  material.hardening.reset();
  return material;
}

}  // namespace

SteppedBlock::SteppedBlock(const SpeedFamily& family, const SpeedMotion& motion, long elements, int threads, int layers, const char* curve)
    : motion_(motion), nodal_pressure_(std::string(family.average) == "node") {
  BodyModel body = body_of(block_of(family.kind, cells_along(family.kind, static_cast<double>(elements))), layered(layers, curve), family.average);
  const int dimension = body.mesh.dimension;
  const NodeField X = positions_of(body.mesh);
  x_ = v_ = X;
  mass_.assign(X.size(), std::numeric_limits<double>::infinity());
  ElementOptions options;
  options.axisymmetric = family.ring;
  engine_ = std::make_unique<Elements>(std::vector<BodyModel>{std::move(body)}, dimension, X, options, threads);
  for (const GroupPlan& group : engine_->plan()) elements_ += group.elements;
  const Vec3 start = stretches(family, dimension, motion.start), rate = (stretches(family, dimension, motion.per_step) - Vec3::Ones()) / kDt;
  const int up = dimension - 1;
  double height = 0;
  for (const Node& at : X) height = std::max(height, at[up]);
  for (std::size_t i = 0; i < X.size(); ++i) {
    x_[i] = node(start.cwiseProduct(vec3(X[i])));
    v_[i] = node(rate.cwiseProduct(vec3(X[i])));
    const double turned = motion.bending / kDt * X[i][0] / height;  // of the section at x, 1/s
    v_[i][0] -= turned * X[i][up];
    v_[i][up] += 0.5 * turned * X[i][0];
  }
  v_before_ = v_;
  turn(2);  // the memory follows the first stretch
  engine_->time_stages(&times_);
}

StepTimes SteppedBlock::turn(long steps) {
  times_ = StepTimes();
  double dt;
  int element;
  engine_->stable_step(x_, v_, dt, element);
  for (long step = 0; step < steps; ++step) {
    engine_->find_forces(x_, v_, kDt, kDt);
    StageClock clock(&times_);
    v_.swap(v_before_);
    kick_and_move_nodes(engine_->node_team(), Kick(kDt, 0), v_before_, engine_->nodal_forces(), mass_, [](long, long) {}, kDt, nullptr, v_, x_);
    clock.ends(&StepTimes::nodes);
  }
  const double share = 1 / static_cast<double>(steps);
  return {times_.bound / kLongestBoundInterval, times_.pressure * share, times_.cells * share, times_.nodes * share};
}

StepTimes SteppedBlock::measure(int turns) {
  const double one = whole(turn(1));
  const long steps = std::clamp(std::lround(kTurnTime / one), 2L, 60L);
  StepTimes best = turn(steps);
  for (int k = 1; k < turns; ++k) {
    const StepTimes next = turn(steps);
    if (whole(next) < whole(best)) best = next;
  }
  return best;
}

double SteppedBlock::step_bytes() const {
  const double nodes = static_cast<double>(x_.size()), field = nodes * sizeof(Node), numbers = nodes * sizeof(double);
  double bytes = 0;
  for (const GroupPlan& g : engine_->plan()) {
    bytes += g.memory_bytes + (motion_.yields() ? g.state_bytes : 0) + g.index_bytes + 2 * g.force_bytes;
    bytes += (g.memory_bytes + 0.5 * g.index_bytes) / kLongestBoundInterval;
    bytes += g.pressure_bytes;  // volumes, in the slots of the forces
  }
  bytes += field;                                           // cells read x
  bytes += (2 * field + numbers + nodes * sizeof(int)) + 2 * field;  // kick: where the slots of a node begin, v, m to v; move, with v still at hand: x to x
  bytes += field / kLongestBoundInterval;
  if (nodal_pressure_) bytes += field + 4 * numbers;        // x; initial volume, modulus, the pressure written and read
  return bytes;
}

}  // namespace forming_sim::bench
