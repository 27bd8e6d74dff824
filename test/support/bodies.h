#pragma once
// Small bodies for tests.
#include <random>
#include <string>

#include "forming_sim/element/elements.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/split.h"
#include "forming_sim/simulation/model.h"

namespace forming_sim {

inline MaterialConfig aluminium(bool plastic = false) {
  MaterialConfig m;
  m.density = 2710;
  m.youngs_modulus = 70.5e9;
  m.poissons_ratio = 0.34;
  if (plastic) {
    HardeningConfig h;
    h.curve = "voce";
    h.yield_stress = 192.1e6;
    h.saturation_stress = 429.8e6;
    h.rate = 8.504;
    m.hardening = h;
  }
  return m;
}

/// The aluminium with a curve of any kind, near that of Voce.
inline MaterialConfig aluminium_by(const std::string& curve) {
  MaterialConfig m = aluminium(true);
  HardeningConfig& h = *m.hardening;
  h.curve = curve;
  h.modulus = curve == "linear" ? 500e6 : 0;
  h.strength = 500e6;
  h.prestrain = .01;
  h.exponent = .2;
  h.plastic_strains = {0, .01, .03, .08, .2};
  h.stresses = {192e6, 212e6, 250e6, 310e6, 390e6};
  return m;
}

inline MaterialConfig rubber(double bulk_modulus) {
  MaterialConfig m;
  m.law = "hyperelastic";
  m.density = 1100;
  m.h1 = 10e6;
  m.h2 = 5e6;
  m.bulk_modulus = bulk_modulus;
  return m;
}

/// A small block of cells of a kind.
inline Mesh block_of(CellKind kind, int n = 2) {
  const CellShape& shape = shape_of(kind);
  BlankConfig blank;
  const bool flat = shape.dimension == 2;
  blank.shape = flat ? "strip" : "plate";
  blank.length = 1.0;
  blank.width = blank.thickness = 0.8;
  if (kind == CellKind::pyramid8) n = (n + 1) / 2;  // six of each hexahedron
  blank.cells_along = n;
  blank.cells_across = blank.cells_through = n;
  blank.pattern = is_one_point(kind) ? "one_point" : kind == CellKind::crossed || kind == CellKind::hex24 ? "fine" : "coarse";
  Mesh mesh = generate_blank(blank);
  if (kind == CellKind::wedge14) {  // two of each hexahedron
    const std::vector<int> hexes = mesh.cells.front().nodes;
    std::vector<Wedge> wedges;
    for (std::size_t at = 0; at < hexes.size(); at += 8)
      for (const std::array<int, 2>& side : {std::array<int, 2>{1, 2}, {2, 3}})
        wedges.push_back({hexes[at], hexes[at + side[0]], hexes[at + side[1]], hexes[at + 4], hexes[at + 4 + side[0]], hexes[at + 4 + side[1]]});
    mesh.cells.clear();
    Centres centres;
    split_wedges(mesh, wedges, centres);
    find_surface(mesh);
  }
  if (kind == CellKind::pyramid8) {  // on the faces of each hexahedron
    const std::vector<int> hexes = mesh.cells.front().nodes;
    std::vector<Pyramid> pyramids;
    for (std::size_t at = 0; at < hexes.size(); at += 8) {
      Vec3 middle = Vec3::Zero();
      for (int k = 0; k < 8; ++k) middle += mesh.nodes[hexes[at + k]] / 8;
      const int apex = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(middle);
      for (const auto& face : kHexFaces) pyramids.push_back({hexes[at + face[3]], hexes[at + face[2]], hexes[at + face[1]], hexes[at + face[0]], apex});
    }
    mesh.cells.clear();
    Centres centres;
    split_pyramids(mesh, pyramids, centres);
    find_surface(mesh);
  }
  if (kind == CellKind::triangle || kind == CellKind::tetrahedron) {  // the simplices of the coarse cells, one by one
    Cells cells{kind, {}};
    for (const auto& s : mesh.simplices())
      for (int a = 0; a <= shape.dimension; ++a) cells.nodes.push_back(s[a]);
    mesh.cells = {cells};
    find_surface(mesh);
  }
  return mesh;
}

inline BodyModel body_of(Mesh mesh, const MaterialConfig& material, const std::string& average = "cell") {
  BodyModel body;
  body.name = "block";
  body.node_count = static_cast<int>(mesh.nodes.size());
  body.element_count = mesh.simplex_count();
  body.material = material;
  body.pressure_average = average;
  body.cut = cut_facets(mesh, {});
  body.thickness = thickness_of(mesh, false, body.cut);
  body.mesh = std::move(mesh);
  return body;
}

inline NodeField positions_of(const Mesh& mesh) {
  NodeField x;
  for (const Vec3& X : mesh.nodes) x.push_back(node(X));
  return x;
}

/// Moves every node by up to `size` in every direction of the dimension.
inline void shake(NodeField& x, int dimension, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-size, size);
  for (Node& n : x)
    for (int i = 0; i < dimension; ++i) n[i] += along(random);
}

}  // namespace forming_sim
