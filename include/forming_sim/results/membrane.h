#pragma once
// Strains of the middle of sheets, between the two sides of a body (element/sheet_sides.h): what bending does to the one side and, the other way, to the other
// is not in them. To every node of a side belongs the place on the other side that was nearest to it while the body was free of stress, a material point like
// itself; the middle goes through the points halfway between them.
#include <array>
#include <vector>

#include "forming_sim/mesh/surface_strain.h"
#include "forming_sim/simulation/model.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class Membrane {
 public:
  Membrane() = default;
  /// Of the bodies for which `wanted` says so and which are sheets.
  Membrane(const Model& model, bool (*wanted)(const BodyModel&));

  /// A facet of a side, the nodes in the joined numbering.
  struct SideFacet {
    int body = 0;
    int facet = 0;                 ///< of the surface of all bodies, in its order
    std::array<int, 3> nodes{};    ///< a segment repeats its second one
    double area = 0;               ///< of it while the body was free of stress, m2; m in plane strain
  };
  const std::vector<SideFacet>& facets() const { return facets_; }
  /// Of the facets, in their order, at these positions.
  std::vector<SurfaceStrain> at(const NodeField& positions) const;

 private:
  /// A place on a facet of the other side.
  struct Opposite {
    std::array<int, 3> nodes{};
    std::array<double, 3> weights{};  ///< sum 1
  };
  void oppose(std::size_t from, std::size_t to, const std::vector<std::array<int, 3>>& other);
  std::array<Vec3, 3> middle(const SideFacet& facet, const NodeField& positions) const;

  int dimension_ = 3;
  bool axisymmetric_ = false;
  NodeField reference_;             ///< of all nodes, m
  std::vector<SideFacet> facets_;
  std::vector<Opposite> opposite_;  ///< per node
  std::vector<std::array<Vec3, 3>> middle_;  ///< per facet, while the body was free of stress
};

}  // namespace forming_sim
