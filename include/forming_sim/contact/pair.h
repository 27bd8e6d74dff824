#pragma once
// A pair of features that may carry force, in the form in which the sweeps see
// it: up to four nodes with weights. Whose the nodes are does not matter: a node
// of a rigid tool has inverse mass 0 and a prescribed velocity.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Names a pair for good: the order in which pairs are swept, and by which a
/// pair is found again in the next step, depends on nothing else.
struct PairKey {
  enum Kind : std::uint64_t { plane = 0, vertex_facet = 1, vertex_vertex = 2, edge_edge = 3 };
  std::uint64_t group = 0;    ///< kind << 32 | vertex, or first edge
  std::uint64_t feature = 0;  ///< (Closest::Feature) << 32 | facet or edge; second vertex or edge; tool

  Kind kind() const { return static_cast<Kind>(group >> 32); }
  int first() const { return static_cast<int>(group & 0xffffffffu); }  ///< vertex, or first edge
  int second() const { return static_cast<int>(feature & 0xffffffffu); }  ///< facet, vertex, edge or tool
  static PairKey make(Kind kind, int first, std::uint64_t type, int second) {
    return {static_cast<std::uint64_t>(kind) << 32 | static_cast<std::uint32_t>(first), type << 32 | static_cast<std::uint32_t>(second)};
  }
  bool operator<(const PairKey& o) const { return group != o.group ? group < o.group : feature < o.feature; }
  bool operator==(const PairKey& o) const { return group == o.group && feature == o.feature; }
};

/// Up to four nodes of the workspace, and how an impulse between them is shared.
struct Link {
  double weight[4] = {0, 0, 0, 0};  ///< b: positive on the first feature, negative on the second, sum 0
  int node[4] = {-1, -1, -1, -1};   ///< in the workspace
  std::int16_t nodes = 0;

  /// One b for each node. (An array of them would be written number by number, and wait to be read in halves.)
  template <int N, class... B> void link(const int (&of)[N], B... b) {
    static_assert(sizeof...(B) == N);
    nodes = N;
    for (int k = 0; k < N; ++k) node[k] = of[k];
    double* to = weight;
    ((*to++ = b), ...);
  }
};

/// What acts along the surfaces of a pair that rubs: friction, and what takes waves away (shear_waves.h).
struct Rub {
  Node slip = Node::Zero();    ///< impulse of both, N s; before the sweeps: of friction, to start from
  double friction = 0;
  double w = 0;                ///< inverse mass of the pair, 1/kg
  double most = std::numeric_limits<double>::infinity();  ///< of friction (shear_limit.h), N s
  // Where waves leave
  double lasting = 0;          ///< phi
  double beta = 0;             ///< z phi A times the kick, kg
  Node steady = Node::Zero();  ///< steady motion u_s, m/s
  double memory = 0;           ///< T_N (friction_delay.h), s
  Node radiated = Node::Zero();  ///< the part of slip that takes waves away, N s
  double own = 1, before = 0;  ///< friction follows own j + before, N s
};

/// There are hundreds of thousands of them, written and read once a step: a byte here is time.
struct ContactPair : Link {
  std::uint16_t movers : 4;    ///< bit k: node k can move
  std::uint16_t held : 1;      ///< some directions of some of them cannot
  std::uint16_t askew : 1;     ///< one of its features is not the nearest of its surface
  int rub = -1;                ///< index of its friction, -1: none
  int own = -1, surface = -1;  ///< surfaces of the first and of the second feature
  Node normal = Node::Zero();  ///< from the second feature to the first, length 1
  double gap = 0;              ///< h at the start of the step, m
  double layer = 0;            ///< h0 of this pair, m
  double stiffness = 0;        ///< c, N m
  double w = 0;                ///< inverse mass along the normal, held directions removed, 1/kg
  double impulse = 0;          ///< along the normal, N s; before the sweeps: to start from
  double end_gap = 0;          ///< h at the end of the step, m
  PairKey key;

  ContactPair() : movers(0), held(0), askew(0) {}
  ContactPair(const PairKey& name, int own_surface, int other_surface, double h, bool pushes_askew, const Node& along)
      : movers(0), held(0), askew(pushes_askew), own(own_surface), surface(other_surface), normal(along), gap(h), key(name) {}

  /// The layer that its own tends to, where that of the contact is `full`: pairs that push askew have half of it.
  double base(double full) const { return askew ? full / 2 : full; }
  /// -1: none; surfaces of tools come after those of so many bodies.
  int tool(int bodies) const { return std::max(-1, std::max(own, surface) - bodies); }
};

constexpr double kAtEnd = 0.02;  ///< so much less than 1 is the weight of the end at which an edge meets another, at most

constexpr long kPairsOfAThread = 1200;  ///< fewer are not worth another thread

/// Points of two features that are tied, or a vertex that is tied to a tool; see ties.h. A Link of feature vertices.
struct Tie : Link {
  int tool = -1;                   ///< the one that takes part
  Vec3 kept = Vec3::Zero();        ///< r in the frame of the features, or the vertex' place in that of the tool, m
  Vec3 press = Vec3::Zero();       ///< unit direction in the same frame: an impulse along it presses the surfaces on each other

  bool to_tool() const { return nodes == 1; }
};

/// What a node brings to its pairs: a record of four doubles, which lanes load whole.
struct Share {
  double inverse_mass = 0;          ///< 1/kg; 0: of a tool, or held in all directions
  double area = 0;                  ///< of nodes of bodies: Features::area
  double of_body = 0;               ///< 1: of a body
  double held = 0;                  ///< 1: some directions are held
};

/// The nodes of all listed pairs, gathered so that pairs address them densely.
struct Workspace {
  std::vector<int> vertex;     ///< feature vertex of each entry: of bodies, rising; of tools; then the feet of planes and of ties (-1)
  int body_entries = 0;        ///< the first so many are nodes of bodies
  NodeField x, v, before;      ///< at the start of the step; running; before the kick
  NodeField mean;              ///< of the velocities before the kick and at the end, once a step is taken
  double kick = 0;             ///< from the middle of the step before to that of this one, s: what forces act over
  NodeField steady;            ///< of bodies v_s and phi (shear_waves.h), of tools the velocity; empty where no waves leave
  std::vector<Share> share;
  std::vector<const Mat3*> projector;  ///< of held nodes, else null
  std::vector<int> fixed;      ///< entries of bodies that contact cannot move, rising
  std::vector<char> stands;    ///< of every entry: it does not move in this step, and contact cannot move it

  /// Calls visit(entry, b) for the nodes of a pair that are of bodies.
  template <class Visit> void each_of_bodies(const Link& pair, Visit&& visit) const {
    for (int k = 0; k < pair.nodes; ++k)
      if (pair.node[k] < body_entries) visit(pair.node[k], pair.weight[k]);
  }
};

}  // namespace forming_sim
