#pragma once
// Surfaces that are tied: vertices of one that stay where they were on the other.
//
// A tie keeps r = x_vertex - sum w_k x_k (w_k: weights of the nearest point of a
// facet at the start) at the place it had in the frame of that facet; of a rigid
// tool in the frame of the tool. At the rim, where a facet reaches out of what is tied, vertices of the other surface
// are tied to it, and edges that cross are tied where they cross, as many as each have a vertex of their own to move: else it
// would turn into the other body about its tied vertices. Features that touch at the start do not meet (Features::touching_facets, touching_edges): they are at no
// distance from each other, so that their pair has no direction. All others of the two surfaces meet as any do.
// The impulse of a tie makes the end of the step exact,
//   r + dt (v_vertex - sum w_k v_k) = r_kept,
// in the sweeps of contact, all others held. Nothing drifts, the stable step is
// not changed (a constraint only removes motion), and no work is done but that
// of a tool. Where what is tied does not touch (a chord beside a chord, glue), r_kept turns with the facet and so with its nodes:
//   d(r - r_kept) = sum G_k dx_k,   G_k = w_k I + [r_kept]x W_k,   the frame turns by sum W_k dx_k,
// and an impulse j acts on node k by G_k^T j, which has no moment on the whole. By the weights alone it has |r_kept| |j|: such ties feed swings without bound.
#include <array>
#include <string>
#include <vector>

#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/list.h"

namespace forming_sim {

/// A tie in a step: nodes of the workspace, as a pair has them.
struct TiePair : Link {
  int tie = -1;
  int tool = -1;                   ///< whose nodes these are in part
  bool to_tool = false;            ///< a vertex, and its place on the tool
  Node missing = Node::Zero();     ///< r_kept - r at the start of the step, m
  Node press = Node::Zero();       ///< unit direction at the start of the step: an impulse along it presses
  Mat3 undamped = Mat3::Zero();    ///< inverse of sum b^2 P/m over the directions that can move, kg; where nothing is apart
  Mat3 mass = Mat3::Zero();        ///< inverse of sum G P/m G^T, likewise, with the workspace's inertia
  Node impulse = Node::Zero();     ///< N s
  bool apart = false;              ///< r_kept is not 0
  std::array<Mat3, 4> turn;        ///< [r_kept]x W_k at the start of the step; where apart
};

/// As of pairs (impulse.h), by G_k.
inline Node relative(const TiePair& tie, const NodeField& v) {
  Node u = relative(static_cast<const Link&>(tie), v);
  if (tie.apart)
    for (int k = 0; k < tie.nodes; ++k) u += node(tie.turn[k] * vec3(v[tie.node[k]]));
  return u;
}
inline Node on_node(const TiePair& tie, int k, const Node& impulse) {
  Node j = on_node(static_cast<const Link&>(tie), k, impulse);
  if (tie.apart) j += node(tie.turn[k].transpose() * vec3(impulse));
  return j;
}
inline void push(const TiePair& tie, const Node& impulse, const Workspace& work, NodeField& field) { push_nodes(tie, impulse, work, field); }

/// Finds what the pairs of kind tied tie, with the bodies at x and the tools'
/// vertices at `place`, as the user gave them; sets `tie` of the relations and
/// the tied zones of the features. Of two bodies the vertices of the one with
/// the shorter edges are tied, and those of the other at the rim. Throws Error(invalid_scene) where nothing of a
/// pair is near enough, with the distance.
std::vector<Tie> find_ties(const ContactSetup& setup, const NodeField& x, const NodeField& place, const std::vector<bool>& is_plane,
                           const std::vector<PlanePose>& planes, Features& features);

/// Remembers the places at which the ties are kept, and the direction in which each presses: x, the tools' vertices at `place`, and their poses now.
void keep_ties(const Features& features, const NodeField& x, const NodeField& place, const std::vector<ToolMotion>& motion, std::vector<Tie>& ties);

/// Fills nodes and weights from the workspace's numbers, and the masses; called
/// where the list was built. `entries`: place in the workspace of each of the tie's nodes, and of its foot.
TiePair link_tie(const Tie& tie, int index, const int* entries);
void prepare_tie(const Workspace& work, TiePair& pair);

/// Takes those out of `ties` that hold what is held already, and returns them: all their nodes are tools' that go as they are told, held or driven by
/// boundaries, or follow from other ties. Where these part, no impulse brings all to rest, and the sweeps would add up without end. told: of an
/// entry of the workspace beyond the bodies', whether its tool goes as it is told; one that a force drives counts as free, across its guide too.
std::vector<TiePair> take_out_doubled(const Workspace& work, const std::vector<bool>& told, std::vector<TiePair>& ties);

/// Sets `missing` and `press`, and what turns, for a step that starts at work.x; motion: of the tools.
void aim_tie(const Tie& tie, const Workspace& work, const std::vector<ToolMotion>& motion, TiePair& pair);

/// One visit; changes work.v. Returns the largest change of a place, m.
double sweep_tie(double dt, Workspace& work, TiePair& pair);

}  // namespace forming_sim
