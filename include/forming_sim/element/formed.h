#pragma once
// What the elements of a part remember that an earlier run has formed, in the order of the part's own mesh: the next run, with
// other threads, other vectors or fewer cells, goes on from it.
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "forming_sim/mesh/trim.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Of one block of Mesh::cells; [cell] is the slowest index everywhere.
struct FormedCells {
  int points = 0, items = 0, hourglass_items = 0;  ///< of a cell; of a point; of a cell
  std::vector<double> memory;     ///< [cell][point][item] of the law (material/law.h), V0 the last
  std::vector<double> hourglass;  ///< [cell][item] of one-point cells
  std::vector<double> ratio;      ///< [cell] of crossed triangles that have weights by their shape (element/crossed.h); else empty
  std::vector<double> damage;     ///< [cell][point] material/damage.h; empty where the material has none
};

/// Of the points at the edges of free simplices (element/edge_points.h).
struct FormedEdges {
  int items = 0;
  std::vector<std::array<int, 2>> ends;   ///< [edge] its nodes, the lower number first
  std::vector<double> memory;             ///< [edge][item]
  std::vector<Eigen::Matrix3d> edges;     ///< [edge] the edge vectors of its law where the part stands, m, as columns
  std::vector<double> volume_ratio;       ///< [edge] V/V0 there
};

struct FormedMemory {
  std::vector<Vec3> reference;    ///< [node] where it was while the elements were free of stress, m
  std::vector<FormedCells> cells; ///< one a block of Mesh::cells
  FormedEdges edges;
  std::vector<double> nodal_ratio;  ///< [node] V/V0 of nodal pressures where the part stands; empty where it has none
};

/// Of what is left of its part.
FormedMemory remaining(const FormedMemory& memory, const Remainder& left);

/// The part is turned: what is kept in space turns with it, the edge vectors of points at edges, and the stresses of the classical method.
void turn(FormedMemory& memory, const std::string& law, int dimension, const Mat3& rotation);

}  // namespace forming_sim
