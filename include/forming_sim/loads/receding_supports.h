#pragma once
// What bears a body in the place of tools that are gone, while what they squeezed it by is let out.
#include <vector>

#include "forming_sim/loads/fading_forces.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What held a node when it was let go. A tool pressed on its area, m2; 0: a boundary held it. Where it has more parts than one, each has its share of the node.
struct Held {
  HoldingForce by;
  double area = 0, share = 1;
};

/// A force on a node by what presses on it from the faces around it, whose area vectors A n (outward) are given: one part where these are level within 30 degrees, up to three
/// at edges and corners, as in a closed die. Parts along their normals, as near to F as such can be, and what is left of F with the largest.
std::vector<Vec3> parts_by_face(const Vec3& F, const std::vector<Vec3>& areas);

/// Two tools that close on a sheet squeeze it by far more than its bending asks for. Forces that kept that would squeeze on while the sheet springs back, where it no
/// longer is as it was: they bend it on, or make it buckle. Tools that open let go of the squeeze in a few thousandths of the thickness, and then bear just what bends. So do these:
///   f = F max(0, 1 - (s + d)/give),  s = (x - place).F/|F|,  d = (kDepth p t/E + 2 sum |F|/sum k) (3 u^2 - 2 u^3),  u = (t - start)/opening,
/// p = squeeze sum |F|/sum area, the mean pressure that balances itself: all recede as far, as tools do.
/// A node that moves against its support meets more, one that moves along it leaves it behind, as it would the tool. With d as it is, it is the force of an energy, convex in x.
/// give = F/k with k = m (kStiffness/dt)^2: as stiff as the time step bears, m the mass of the node, or its share of it. What a boundary held stays F.
class RecedingSupports {
 public:
  static constexpr double kStiffness = 0.3;    ///< the fastest swing is one of 2/dt: it becomes faster by 1 %
  static constexpr double kOpening = 1. / 3;   ///< of the time in which what is left fades: long enough for what bends to follow
  static constexpr double kNearlyOpen = 0.6;   ///< of the opening: from here on nothing is squeezed, and what they bear is meant
  static constexpr double kDepth = 3;          ///< what presses on both faces of a sheet asks for 1/2, of two sheets between them for 1
  /// A body of thickness t, m, and Young's modulus E, Pa, in which `stored`, J, are, is let go from `start` on, s: the supports recede in kOpening of the time `fade`, s, and in that what they then still bear is to fade.
  /// together: bodies that hang together with it, itself among them.
  struct OfBody {
    int body = 0;
    std::vector<int> together;
    double t = 0, E = 0, stored = 0, start = 0, fade = 0;
  };
  /// Of what holds a body, the part of the forces of tools that balances itself, (sum |F| - |P sum F|)/sum |F|; 0 where none presses.
  /// P, `alone`: projector of the directions along which the body is all there is; what presses across a plane of symmetry is balanced beyond it.
  static double squeeze(const std::vector<Held>& held, const Mat3& alone = Mat3::Identity());
  /// Nodes have these masses, kg, are at x, and move on by steps of dt, s. squeeze: squeeze() of what held them.
  void begin(const OfBody& body, double squeeze, double dt, const std::vector<double>& mass, const NodeField& x, const std::vector<Held>& held);
  /// What a boundary held that lets go meanwhile of one of the bodies that hang together: it balances what the supports of any of them bear, and so goes with them; whether there are any.
  bool join(const std::vector<int>& together, const NodeField& x, const std::vector<Held>& held);
  /// f += what they bear at time t, of nodes at x.
  void add(double t, const NodeField& x, NodeField& f);
  /// What they could still do if d stayed as it is at time t, J; but for what boundaries held. Their gradient, for tests.
  double energy(double t, const NodeField& x) const;
  /// Of those of a body that were added.
  struct Done {
    int body;
    double work;  ///< J
  };
  /// What they do for `kick` s at the mean of two velocities.
  std::vector<Done> work(double kick, const NodeField& v_before, const NodeField& v) const;
  bool empty() const { return sets_.empty(); }
  double end() const;  ///< when what the last still bear has faded, s

  /// What those of a body that have receded at time t bore in the mean since they were nearly open; they are gone then.
  struct Receded {
    OfBody of;
    std::vector<HoldingForce> forces;
  };
  std::vector<Receded> take(double t);

  template <class Archive> void exchange(Archive& a) {
    a.each(sets_, [&](Set& set) {
      for (double* value : {&set.of.t, &set.of.E, &set.of.stored, &set.of.start, &set.of.fade}) a.number(*value);
      a.number(set.of.body);
      a.list(set.of.together);
      for (double* value : {&set.depth, &set.added, &set.meant}) a.number(*value);
      a.each(set.supports, [&](Support& support) {
        a.number(support.node);
        a.numbers(support.way.data(), 3);
        for (double* value : {&support.force, &support.start, &support.give, &support.impulse}) a.number(*value);
      });
    });
  }

 private:
  struct Support {
    int node = -1;
    Node way = Node::Zero();      ///< of the force, of length 1
    double force = 0;             ///< |F|, N
    double start = 0;             ///< place.way, m
    double give = 0;              ///< m; 0: a boundary's
    double impulse = 0;           ///< in the time over which they are meant, N s
    double bore = 0;              ///< by the last add(), N
  };
  struct Set {
    OfBody of;
    double depth = 0;             ///< the largest d, m
    double added = 0, meant = 0;  ///< when they were added last; time over which they are meant, s
    std::vector<Support> supports;
    double open() const { return of.start + kOpening * of.fade; }  ///< when they have receded, s
    double receded(double t) const;                                ///< d, m
  };
  std::vector<Set> sets_;
  static Support support_of(const Held& held, const NodeField& x);  ///< that gives nothing
  static double bears(const Support& support, double d, const Node& x);  ///< N
};

}  // namespace forming_sim
