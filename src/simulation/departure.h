#pragma once
// Whether the mesh may have changed more than the last look at the stable step foresaw.
//
// What the cells did at that look goes on at most as the step's own forecast allows for
// (simulation/step_control.h). What comes on top of it, a body that meets a tool or a support that
// starts, shows in the velocities first: the nodes have since departed from the motion
// that they had by at most sum of dt max |v - v_then|. Few cells are much thinner than the way
// c dt of a wave in a stable step, so that this makes a strain of about
//   sum over the steps of max |v - v_then| / c,
// twice that where two neighbours depart in opposite directions; where the thinnest cell is thinner than a fourth of that way, as the slivers
// that the step of the whole mesh passes over, so many times as much. Velocities alone enter, so that
// the pass that moves the nodes finds it (element/nodes.h).
#include <algorithm>
#include <cmath>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class Departure {
 public:
  static constexpr double kUnforeseenStrain = 0.01;

  /// thinnest: what a wave takes through the thinnest cell, about, s.
  void look(const NodeField& v, double thinnest) {
    then_ = v;
    thinnest_ = thinnest;
    strain_ = 0;
  }
  /// Velocities at the last look.
  const NodeField& then() const { return then_; }
  /// After a step of dt at whose end |v - then|^2 was at most `squared`, m2/s2; wave: the slowest of the bodies' waves, m/s.
  void step(double squared, double wave, double dt) { strain_ += std::sqrt(squared) / wave * std::max(1.0, dt / (kThin * thinnest_)); }
  bool sudden() const { return strain_ > kUnforeseenStrain; }

  template <class Archive> void exchange(Archive& a, std::size_t nodes) {
    then_.resize(nodes, Node::Zero());
    a.numbers(then_.data()->data(), nodes * 4);
    a.number(thinnest_);
    a.number(strain_);
  }

 private:
  static constexpr double kThin = 4;  ///< steps of the mesh over that of its thinnest cell, with no more than which cells are much alike
  NodeField then_;
  double thinnest_ = 0, strain_ = 0;
};

}  // namespace forming_sim
