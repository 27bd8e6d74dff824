#include "forming_sim/mesh/split.h"

#include <algorithm>

#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {
namespace {

std::array<int, 8> key_of(const int* corners, int count) {
  std::array<int, 8> key;
  key.fill(-1);
  std::copy(corners, corners + count, key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

template <std::size_t N> Vec3 middle_of(const Mesh& mesh, const std::array<int, N>& corners) {
  Vec3 sum = Vec3::Zero();
  for (int n : corners) sum += mesh.nodes[n];
  return sum / static_cast<double>(N);
}
/// About as far from the base as from the sides.
Vec3 middle_of(const Mesh& mesh, const Pyramid& pyramid) {
  return 5. / 8 * middle_of(mesh, Quad{pyramid[0], pyramid[1], pyramid[2], pyramid[3]}) + 3. / 8 * mesh.nodes[pyramid[4]];
}

int add_node(Mesh& mesh, const Vec3& place) {
  mesh.nodes.push_back(place);
  return static_cast<int>(mesh.nodes.size()) - 1;
}

}  // namespace

void Centres::add(const int* corners, int count, int centre) { nodes_.emplace(key_of(corners, count), centre); }

int Centres::find(const int* corners, int count) const {
  const auto found = nodes_.find(key_of(corners, count));
  return found == nodes_.end() ? -1 : found->second;
}

void Centres::extend_by_faces(std::vector<int>& set, const std::vector<Hex>& hexes) const {
  std::sort(set.begin(), set.end());
  const std::vector<int> corners_only = set;
  for (const Hex& hex : hexes)
    for (int f = 0; f < 6; ++f) {
      const auto face = face_of(hex, kHexFaces[f]);
      const bool inside = std::all_of(face.begin(), face.end(), [&](int n) {
        return std::binary_search(corners_only.begin(), corners_only.end(), n);
      });
      const int centre = inside ? find(face.data(), 4) : -1;
      if (centre >= 0) set.push_back(centre);
    }
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
}

Centres split_quads(Mesh& mesh, const std::vector<Quad>& quads, CellKind kind) {
  Centres centres;
  Cells block{kind, {}};
  block.nodes.reserve(quads.size() * shape_of(kind).nodes);
  for (const Quad& quad : quads) {
    block.nodes.insert(block.nodes.end(), quad.begin(), quad.end());
    if (kind != CellKind::crossed) continue;
    const int centre = add_node(mesh, middle_of(mesh, quad));
    block.nodes.push_back(centre);
    centres.add(quad.data(), 4, centre);
  }
  if (!quads.empty()) mesh.cells.push_back(std::move(block));
  return centres;
}

namespace {

template <class Solid> void split_solids(Mesh& mesh, const std::vector<Solid>& solids, CellKind kind, Centres& centres) {
  const QuadFaces faces = split_faces_of(kind);
  Cells block{kind, {}};
  block.nodes.reserve(solids.size() * shape_of(kind).nodes);
  for (const Solid& solid : solids) {
    block.nodes.insert(block.nodes.end(), solid.begin(), solid.end());
    if (faces.count == 0) continue;
    for (int f = 0; f < faces.count; ++f) {
      const auto face = face_of(solid, faces.corners[f]);
      int centre = centres.find(face.data(), 4);
      if (centre < 0) centres.add(face.data(), 4, centre = add_node(mesh, middle_of(mesh, face)));
      block.nodes.push_back(centre);
    }
    const int centre = add_node(mesh, middle_of(mesh, solid));
    centres.add(solid.data(), static_cast<int>(solid.size()), centre);
    block.nodes.push_back(centre);
  }
  if (!solids.empty()) mesh.cells.push_back(std::move(block));
}

}  // namespace

Centres split_hexes(Mesh& mesh, const std::vector<Hex>& hexes, CellKind kind) {
  Centres centres;
  split_solids(mesh, hexes, kind, centres);
  return centres;
}

void split_wedges(Mesh& mesh, const std::vector<Wedge>& wedges, Centres& centres) { split_solids(mesh, wedges, CellKind::wedge14, centres); }
void split_pyramids(Mesh& mesh, const std::vector<Pyramid>& pyramids, Centres& centres) { split_solids(mesh, pyramids, CellKind::pyramid8, centres); }

}  // namespace forming_sim
