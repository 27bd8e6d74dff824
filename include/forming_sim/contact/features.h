#pragma once
// The features of all surfaces that take part: vertices, edges, facets, and
// which belong together. One numbering for bodies and tools, so that a pair
// does not care whose its nodes are.
//
// Vertices: bodies keep the joined numbering 0 ... body_nodes - 1; those of tool
// t follow from first_vertex of its surface on, in the order of their places,
// nodes at one place being one vertex. Facets list their corners in rising
// order. So neither the orientation nor the order in a tool's file matters.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "forming_sim/contact/contact.h"

namespace forming_sim {

struct Features {
  struct Surface {
    int first_vertex = 0;             ///< tools: number of its first vertex; bodies: 0
    int first_facet = 0, last_facet = 0, first_edge = 0, last_edge = 0;
    std::vector<int> vertices;        ///< used by its facets, rising
  };
  /// How two surfaces meet; see PairConfig.
  struct Relation {
    bool meet = false;
    double friction = 0;              ///< the largest double: sticking
    double friction_limit = 0;        ///< largest shear stress of friction, Pa; 0: none
    int tie = -1;                     ///< which of `tied_zones`
    int sticks_by = -1;               ///< of two bodies that stick whatever it takes the surface whose vertices do so first (contact/sticking.h); -1: of others (with a friction_limit, a body and itself, tools)
    bool limited() const { return meet && friction > 0 && friction_limit > 0; }
  };
  /// Of a joint between two tools, as an edge or a vertex of one of them has it.
  struct JointPart {
    Node way = Node::Zero();          ///< over it, out of its tool
    double slack = 0;                 ///< so far a vertex may be over it and still be in the slit, m
    double first = 0, last = 1;       ///< of an edge, from node[0] to node[1]

    /// Something at `apart` from its point at s is on the other side, where the other tool has it. slope: of the way there, at least.
    bool is_over(double s, const Node& apart, double slope) const {
      return s >= first && s <= last && apart.head<3>().dot(way.head<3>()) > slope * apart.head<3>().norm() + slack;
    }
  };
  struct Edge {
    int node[2] = {-1, -1};           ///< rising
    int surface = -1;
    int facets = 0;                   ///< number of facets at this edge
    int facet[2] = {-1, -1};          ///< the first two of them
    int opposite[2] = {-1, -1};       ///< their third corners
    bool level = false;               ///< of a tool: inside of a plane part of it (find_level_parts), or of one that goes on in another tool
    int first_joint = -1, joints = 0; ///< of a tool: its joint_parts; first_joint is -1 where there never were any
  };

  int dimension = 3;
  int body_nodes = 0;
  int bodies = 0;                     ///< surfaces 0 ... bodies - 1; tool t is surface bodies + t
  std::vector<Relation> relations;    ///< of surfaces a and b: [a * surfaces + b], the same both ways
  std::vector<std::vector<bool>> tied_zones;    ///< per tied pair of surfaces and vertex: of features that touch one of the other surface at the start
  std::vector<std::uint64_t> touching_facets;   ///< vertex << 32 | facet, rising: of tied surfaces, near each other at the start; they stay as they are and do not meet
  std::vector<std::uint64_t> touching_edges;    ///< edge << 32 | edge, the smaller first, rising: likewise
  int vertex_count = 0;
  std::vector<Surface> surfaces;
  std::vector<std::array<int, 3>> facets;       ///< corners, rising; 2D: 2 used, third -1
  std::vector<int> facet_surface;
  std::vector<int> facet_outward;               ///< bodies: +1 where the corners in rising order give the outward normal, else -1; tools: +1
  std::vector<std::array<int, 3>> facet_edges;  ///< 3D: edge k joins corners k and (k+1) mod 3
  std::vector<Edge> edges;                      ///< 3D only
  std::vector<int> facets_at_vertex;            ///< number
  std::vector<int> neighbours;                  ///< of vertex v: first_neighbour[v] ... first_neighbour[v + 1] - 1: other ends of its edges (2D: facets)
  std::vector<int> first_neighbour;
  std::vector<int> vertex_surface;              ///< -1: on no surface
  std::vector<double> area;                     ///< of body vertices: the area they stand for at set-up, m^2 (2D: per metre of width; axisymmetric: of the whole circle)
  std::vector<bool> level_vertex;               ///< of tools: all its edges are level, or it lies inside of a joint; index: vertex - body_nodes
  std::vector<JointPart> joint_parts;           ///< of edges and vertices that are none, since another tool goes on there (contact/flush.h)
  static constexpr int kNoJoint = -1, kOpenJoint = -2;
  std::vector<int> joint_vertex;                ///< of tools: which of joint_parts, kNoJoint, or kOpenJoint where the tools have parted; empty where there are no joints; index: vertex - body_nodes
  NodeField place;                              ///< of tool vertices in the tool's frame; index: vertex - body_nodes
  double smallest_edge = 0, mean_edge = 0;      ///< of the bodies' surfaces

  bool rigid(int vertex) const { return vertex >= body_nodes; }
  int corners() const { return dimension; }
  /// Can deformable meet deformable? Then both sides of a pair move.
  bool bodies_meet() const;
  const Relation& relation(int a, int b) const { return relations[a * surfaces.size() + b]; }
  Relation& relation(int a, int b) { return relations[a * surfaces.size() + b]; }
  /// Have the features with these vertices (a of one surface, b of the other) both to do with what is tied?
  template <class VerticesA, class VerticesB> bool about_ties(const Relation& relation, const VerticesA& a, const VerticesB& b) const {
    return relation.tie >= 0 && in_zone(relation.tie, a) && in_zone(relation.tie, b);
  }
  // Are these features of two surfaces tied together? An edge and a facet are where either has to do so with the other's border.
  bool tied_to_facet(const Relation& relation, int vertex, int facet) const {
    return relation.tie >= 0 && tied_zones[relation.tie][vertex] && holds(touching_facets, key(vertex, facet));
  }
  bool tied_to_plane(const Relation& relation, int vertex) const { return relation.tie >= 0 && tied_zones[relation.tie][vertex]; }
  /// The vertex of surface `own` is one of the facet's, or tied to it.
  bool never_meet(int vertex, int own, int facet, int other) const {
    const auto& c = facets[facet];
    if (own == other && (c[0] == vertex || c[1] == vertex || c[2] == vertex)) return true;
    return tied_to_facet(relation(own, other), vertex, facet);
  }
  bool tied_edges(const Relation& relation, int e, int other) const {
    return relation.tie >= 0 && tied_zones[relation.tie][edges[e].node[0]] && holds(touching_edges, key(std::min(e, other), std::max(e, other)));
  }
  bool tied_edge_to_facet(const Relation& relation, int e, int facet) const;  ///< 2D: two facets

  static std::uint64_t key(int first, int second) { return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(second); }

 private:
  static bool holds(const std::vector<std::uint64_t>& keys, std::uint64_t key) { return std::binary_search(keys.begin(), keys.end(), key); }
  template <class Vertices> bool in_zone(int tie, const Vertices& vertices) const {
    for (int v : vertices)
      if (v >= 0 && tied_zones[tie][v]) return true;
    return false;
  }
};

/// x: positions of the bodies' nodes, from which areas and edge lengths are taken.
Features build_features(const ContactSetup& setup, const NodeField& x);

/// Finds the edges of tools between two facets that lie in one plane, to a slope of 1e-6, and the vertices that have no
/// others: what a body's edge or facet is nearest to inside of a plane part it is nearest to with its own vertices, or at that
/// part's border, so that level edges and vertices need not be met. From `place` as it stands; to be called when tools are set back. In dimension 2 there are none.
void find_level_parts(Features& f);

}  // namespace forming_sim
