// Section 3.1: without the rotation of stresses a step does not cost more.
//
// Forces of a body whose nodes move to and fro, the laws in alternating turns on the
// same bodies; a turn of one law is compared with the turns of the others beside it.
#include <algorithm>
#include <cmath>

#include "paper/figures.h"
#include "support/bodies.h"

namespace forming_sim::bench {
namespace {

constexpr int kCallsOfATurn = 20, kTurns = 60;
constexpr double kStep = 1e-8;

class Timed {
 public:
  Timed(CellKind kind, int cells, bool plastic, const std::string& law, double stretch)
      : X_(positions_of(block_of(kind, cells))), x_(X_), v_(X_.size(), Node::Zero()), f_(v_), stretch_(stretch) {
    MaterialConfig material = aluminium(plastic);
    material.law = law;
    const Mesh mesh = block_of(kind, cells);
    elements_ = std::make_unique<Elements>(std::vector<BodyModel>{body_of(mesh, material)}, mesh.dimension, X_, ElementOptions(), 1);
  }

  /// ns an element and step, the mean of one turn.
  double turn() {
    double time = 0;
    for (int call = 0; call < kCallsOfATurn; ++call) {
      const double stretch = 1 + stretch_ * std::sin(0.05 * static_cast<double>(calls_++));
      for (std::size_t i = 0; i < x_.size(); ++i) {
        v_[i][0] = (stretch * X_[i][0] - x_[i][0]) / kStep;
        x_[i][0] = stretch * X_[i][0];
      }
      const Clock clock;
      elements_->forces(x_, v_, kStep, kStep, f_);
      time += clock.seconds();
    }
    return 1e9 * time / kCallsOfATurn / static_cast<double>(elements_->simplices().size());
  }
  double plastic_work() const { return elements_->plastic_work(); }

 private:
  NodeField X_, x_, v_, f_;
  std::unique_ptr<Elements> elements_;
  double stretch_;
  long calls_ = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::vector<Row> rotation_cost(const Request&) {
  struct Family {
    CellKind kind;
    int cells;  ///< along each side: about 4000 elements, which a cache holds
    const char* name;
  };
  const Family families[] = {{CellKind::crossed, 32, "crossed"}, {CellKind::hex6, 9, "hex6"}, {CellKind::hex24, 5, "hex24"}};
  const std::vector<std::string> laws{"classical", "paper", "green_elastic"};
  std::vector<Row> rows;
  for (const Family& family : families)
    for (const bool plastic : {false, true}) {
      const Clock clock;
      std::vector<Timed> bodies;
      for (const std::string& law : laws) bodies.emplace_back(family.kind, family.cells, plastic, law, plastic ? 0.02 : 0.001);
      std::vector<std::vector<double>> ns(laws.size());
      for (Timed& body : bodies) body.turn();
      for (int turn = 0; turn < kTurns; ++turn)
        for (std::size_t k = 0; k < laws.size(); ++k) ns[k].push_back(bodies[k].turn());
      const std::string name = std::string(family.name) + (plastic ? ", plastic" : ", elastic");
      for (std::size_t k = 0; k < laws.size(); ++k)
        rows.push_back(just("section 3.1", name + ", " + laws[k] + ": ns", *std::min_element(ns[k].begin(), ns[k].end()), clock.seconds()));
      for (std::size_t k = 1; k < laws.size(); ++k) {
        std::vector<double> ratios;
        for (int turn = 0; turn < kTurns; ++turn) ratios.push_back(ns[k][turn] / ns[0][turn]);
        rows.push_back(at_most("section 3.1", name + ": " + laws[k] + " / classical", median(ratios), 1, clock.seconds()));
        if (!rows.back().holds && laws[k] == "green_elastic") rows.back().note = "it takes J^(-5/3), which the printed law does without";
      }
      for (std::size_t k = 0; k < laws.size(); ++k)
        if (plastic != (bodies[k].plastic_work() > 0)) rows.back().note = "the bodies did not yield as they should: not a measurement";
    }
  rows.front().note =
      "least of 60 turns; ratios: median over turns; ~4000 elements, 1 thread. The classical law is a function of its own, called from a kernel that "
      "tells laws apart at run time (a few percent), and gathers velocities and edges once more for (2.11); the new one is compiled into its kernel. Whole steps are compared: what the rotation alone takes is not timed";
  return rows;
}

}  // namespace forming_sim::bench
