#pragma once
// What each body, or tool, has done in a window of time, in two halves: how far its nodes went, and the mean forces that moved
// them, from what became of their velocities. Elements, loads, contact and supports are all in these, damping is not.
// A window is looked at when it has grown to twice what it was. A settle stage judges by them (simulation/settle.h).
#include <vector>

#include "forming_sim/element/nodes.h"

namespace forming_sim {

/// Of a body in a window of T: d, half its way, as the middles of the halves are apart; F1 and F2, the mean forces in these, dF = F2 - F1.
/// As a whole it moves as one that is free in space; in axisymmetry a radial motion is none, and the hoop draws it back.
struct Way {
  double T = 0;           ///< s
  double d_dF = 0;        ///< d . dF, J
  double d_Md = 0;        ///< d . M d, kg m^2
  double rigid_dF = 0;    ///< likewise, of the part of d by which the body moved as a whole
  double rigid_Md = 0;
  double F_MF = 0;        ///< F2 . M^-1 F2, N^2/kg
  double rigid_F_MF = 0;  ///< likewise, of the part of F2 that moves it as a whole
  double rigid_dF_MdF = 0;  ///< and of that of dF
};

class Ways {
 public:
  static constexpr std::size_t kBytesOfNode = 6 * sizeof(Node);
  /// Those of a body.
  struct Nodes {
    int first, count;
  };
  bool empty() const { return windows_.empty(); }
  /// The windows of so many bodies begin at t, with places x and velocities v.
  void begin(double t, std::size_t bodies, const NodeField& x, const NodeField& v) {
    windows_.assign(bodies, {});
    begins_ = middle_ = {x, v};
    last_x_ = x;
    dragged_.assign(x.size(), Node::Zero());
    for (Window& window : windows_) window.begins = window.middle = t;
  }
  /// Counts a look: whether it is one at which a half of the window of body b ends.
  bool ends_half(std::size_t b) {
    const long n = ++windows_[b].looks;
    return (n & (n - 1)) == 0;
  }
  /// The bodies have come to x, damped at the rate alpha since they were last told of.
  void go_on(const NodeField& x, double alpha) {
    for (std::size_t i = 0; i < x.size(); ++i) dragged_[i] += alpha * (x[i] - last_x_[i]);
    last_x_ = x;
  }
  /// Where both halves of the window of body b have been.
  bool whole(std::size_t b) const { return windows_[b].looks > 1; }
  /// Of body b, whose window began earlier and has both halves, up to now. led: the window is of two steps, and the forces of its halves
  /// are those at its beginning and in its middle.
  Way way(double t, std::size_t b, Nodes of, const NodeField& x, const NodeField& v, const std::vector<double>& mass, bool led) const;
  /// The window of body b goes on: what was all of it is its first half.
  void double_up(double t, std::size_t b, Nodes of, const NodeField& x, const NodeField& v) {
    mark(of, x, v, middle_);
    windows_[b].middle = t;
  }
  /// It begins anew.
  void begin_again(double t, std::size_t b, Nodes of, const NodeField& x, const NodeField& v) {
    mark(of, x, v, begins_);
    windows_[b] = {t, t, 0};
  }

  template <class Archive> void exchange(Archive& a, std::size_t nodes) {
    a.each(windows_, [&](Window& window) {
      a.number(window.begins);
      a.number(window.middle);
      a.number(window.looks);
    });
    if (empty()) return;
    for (NodeField* field : {&begins_.x, &begins_.u, &middle_.x, &middle_.u, &dragged_, &last_x_}) {
      field->resize(nodes, Node::Zero());
      a.numbers(field->data()->data(), nodes * 4);
    }
  }

 private:
  struct Window {
    double begins = 0, middle = 0;  ///< s
    long looks = 0;
  };
  struct Mark {
    NodeField x, u;  ///< u = v + int alpha v dt: its changes are of all forces but damping
  };
  void mark(Nodes of, const NodeField& x, const NodeField& v, Mark& at) {
    for (int i = of.first; i < of.first + of.count; ++i) at.x[i] = x[i], at.u[i] = v[i] + dragged_[i];
  }

  std::vector<Window> windows_;
  Mark begins_, middle_;
  NodeField dragged_, last_x_;  ///< int alpha v dt, m/s; places at which it was last added to
};

}  // namespace forming_sim
