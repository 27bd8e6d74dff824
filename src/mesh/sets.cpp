#include "forming_sim/mesh/sets.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/mesh/measure.h"
#include "mesh/region.h"

namespace forming_sim {
namespace {

constexpr double kTolerance = 1e-6;  // of the body's size

std::vector<char> on_surface(const Mesh& mesh) {
  std::vector<char> on(mesh.nodes.size(), 0);
  for (const Facet& facet : mesh.surface)
    for (int n : facet.nodes)
      if (n >= 0) on[n] = 1;
  return on;
}

/// On what is round the centre of a face lies beside its corners: it belongs to the set as they do.
void add_face_centres(const Mesh& mesh, std::vector<char>& chosen) {
  for (const Cells& cells : mesh.cells) {
    const QuadFaces faces = split_faces_of(cells.kind);
    if (faces.count == 0) continue;
    const int size = shape_of(cells.kind).nodes;
    for (std::size_t first = 0; first < cells.nodes.size(); first += size)
      for (int face = 0; face < faces.count; ++face) {
        const auto& corners = faces.corners[face];
        if (std::all_of(corners, corners + 4, [&](int corner) { return chosen[cells.nodes[first + corner]] != 0; })) chosen[cells.nodes[first + faces.first_centre + face]] = 1;
      }
  }
}

}  // namespace

std::vector<int> choose_nodes(const Mesh& mesh, const SetConfig& set) {
  const double tolerance = set.tolerance > 0 ? set.tolerance : kTolerance * size_of(mesh);
  const auto distance = distance_from(set, mesh.dimension == 2, "set " + set.name + ": ");
  const bool whole = set.choose == "box";  // with what is inside
  const std::vector<char> surface = set.surface_only ? on_surface(mesh) : std::vector<char>(mesh.nodes.size(), 1);
  std::vector<char> there(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) there[n] = (whole ? distance(mesh.nodes[n]) : std::abs(distance(mesh.nodes[n]))) <= tolerance;
  if (set.choose == "cylinder" || set.choose == "sphere") add_face_centres(mesh, there);
  std::vector<int> chosen;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (surface[n] && there[n]) chosen.push_back(static_cast<int>(n));
  return chosen;
}

}  // namespace forming_sim
