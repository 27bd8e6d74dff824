#pragma once
// Points of the law at the edges of free simplices: the edge-smoothed deformation gradient (Liu,
// Nguyen-Thoi and Lam, J. Sound Vib. 320 (2009), here with the initial volumes as weights).
//
// A constant strain per triangle or tetrahedron is too stiff in bending. An edge of the mesh
// has the mean gradient of the simplices s around it, and a share of their volumes,
//   V_e = sum_s V_s / k,  F_e = sum_s (V_s / k) F_s / V_e,  k = 3 edges of a triangle, 6 of a tetrahedron,
// and everything beside the pressure is found there, once an edge: U = sum_e V_e w(F_e). The means are
// fixed linear combinations of node positions, so that a point has edge vectors like every other element,
//   x_m = c F_e E_m = sum_a w_ma x_a,  w_ma = c b_a . E_m,  b_a = sum_s (V_s / k) g_sa / V_e,
// g_sa the shape gradients, E_m the axes, c such that det(x_m)/D! = V_e det F_e. A ring's hoop
// is x_3 = sum_a o_a r_a with o_a = R/V_e sum_s (V_s / k) / (3 R_s), R the mean radius of the point and R_s that of s.
//
// The pressures are the nodes' (element/cell_group.h). Pressures at the edges would lock in
// plastic flow, strains in the nodes leave shapes without stiffness.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Weights of a node in a point: D of x_m, one more of the hoop.
constexpr int edge_weights(int dimension, bool ring) { return dimension + (ring ? 1 : 0); }

struct EdgePoints {
  int dimension = 0;
  bool ring = false;
  std::vector<int> start;        ///< [point] where its nodes start, and behind the last
  std::vector<int> node;         ///< of points: the corners of the simplices around the edge
  std::vector<std::array<int, 2>> ends;  ///< [point] nodes of the edge
  std::vector<double> weight;    ///< [node of a point][edge_weights]
  std::vector<double> share;     ///< [node of a point] of V_e, as the simplices around the edge have it in equal shares
  std::vector<double> volume;    ///< [point] V_e; of a ring the whole circle's
  std::vector<double> radius;    ///< [point] R, of rings only
  std::vector<int> of_simplex;   ///< [simplex][k] the points at its edges

  int count() const { return static_cast<int>(volume.size()); }
  int nodes_of(int point) const { return start[point + 1] - start[point]; }
  /// Its edge vectors at the start as columns; 2D: the third is e_3, of a ring R e_3.
  Eigen::Matrix3d edges(int point) const;
};

/// k of a simplex.
constexpr int edges_of_simplex(int dimension) { return dimension == 2 ? 3 : 6; }

/// simplices: nodes, in 2D the fourth is -1; volumes > 0 at X. Points are numbered as the simplices first come to their edges.
EdgePoints find_edge_points(const std::vector<std::array<int, 4>>& simplices, const NodeField& X, int dimension, bool ring);

}  // namespace forming_sim
