#pragma once
// Grids over the facets, edges and vertices of a surface: those of a rigid tool in
// its own frame, built once; those of a body at its places now, for one search.
#include <vector>

#include "forming_sim/contact/features.h"
#include "forming_sim/contact/grid.h"

namespace forming_sim {

class SurfaceIndex {
 public:
  SurfaceIndex() = default;  ///< of nothing
  /// place(vertex): its place. What lies outside `region` is left out; cell: wanted size of the grids' cells, m.
  template <class Place> SurfaceIndex(const Features& f, int surface, Place&& place, const Box& region, double cell) {
    const auto& s = f.surfaces[surface];
    std::vector<Box> facets(s.last_facet - s.first_facet), edges(s.last_edge - s.first_edge), vertices(s.vertices.size());
    for (std::size_t i = 0; i < facets.size(); ++i)
      for (int k = 0; k < f.corners(); ++k) facets[i].add(place(f.facets[s.first_facet + i][k]));
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (int k = 0; k < 2; ++k) edges[i].add(place(f.edges[s.first_edge + i].node[k]));
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].add(place(s.vertices[i]));
    for (const Box& box : vertices) box_.add(box);
    facets_ = Grid(std::move(facets), region, cell);
    edges_ = Grid(std::move(edges), region, cell);
    vertices_ = Grid(std::move(vertices), region, cell);
    surface_ = &s;
  }

  /// Of all vertices.
  const Box& box() const { return box_; }
  // Calls found(facet, edge, or vertex) for everything whose box overlaps the query.
  template <class Found> void facets(const Box& query, Found&& found) const {
    facets_.query(query, [&](int i) { found(surface_->first_facet + i); });
  }
  template <class Found> void edges(const Box& query, Found&& found) const {
    edges_.query(query, [&](int i) { found(surface_->first_edge + i); });
  }
  template <class Found> void vertices(const Box& query, Found&& found) const {
    vertices_.query(query, [&](int i) { found(surface_->vertices[i]); });
  }

 private:
  const Features::Surface* surface_ = nullptr;
  Box box_;
  Grid facets_, edges_, vertices_;
};

/// The indices of all tools, with the places of their vertices.
class ToolIndex {
 public:
  /// place: of all tool vertices, index vertex - body_nodes; in the tools' frames, or in the world.
  /// asked: per tool; of the others the index has nothing, and their places are not looked at.
  /// Refers to f and place, which must stay.
  ToolIndex(const Features& f, const NodeField& place, const std::vector<bool>& asked);
  const SurfaceIndex& of(int tool) const { return tools_[tool]; }
  const Node& place(int vertex) const { return (*place_)[vertex - first_]; }

 private:
  const NodeField* place_;
  int first_;
  std::vector<SurfaceIndex> tools_;
};

}  // namespace forming_sim
