// From what a mesh file or a message says to a body: splits, sets, checks.
#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/seams.h"
#include "forming_sim/mesh/split.h"
#include "raw_mesh.h"

namespace forming_sim {
namespace {

constexpr double kFlat = 1e-9;         // of the body's size: z of a body of dimension 2
constexpr std::size_t kNamed = 5;      // cells named in a message

[[noreturn]] void refuse(const RawMesh& raw, const std::string& what) {
  throw Error(Code::mesh_error, raw.source + ": " + what);
}

/// What is wrong with the group where one is wanted, else with the source.
[[noreturn]] void refuse_group(const RawMesh& raw, const std::string& what) {
  if (raw.group.empty()) refuse(raw, what);
  throw SceneError({{Code::mesh_error, "group", given_text(raw.group), what}});
}

void check_points(const RawMesh& raw) {
  for (std::size_t p = 0; p < raw.points.size(); ++p)
    if (!raw.points[p].allFinite())
      refuse(raw, "node " + std::to_string(raw.point_tags[p]) + " lies at " + place(raw.points[p]) +
                      "; every coordinate must be a finite number");
}

void lay_flat(RawMesh& raw) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : raw.points) box.extend(x);
  for (std::size_t p = 0; p < raw.points.size(); ++p) {
    double& z = raw.points[p].z();
    if (std::abs(z) > kFlat * box.diagonal().norm())
      refuse_group(raw, "node " + std::to_string(raw.point_tags[p]) + " of a mesh of triangles and quadrilaterals lies at " + place(raw.points[p]) +
                            "; a body of dimension 2 lies in z = 0, and a solid one needs tetrahedra or hexahedra" + (raw.volumes.empty() ? "" : ": groups of these are " + raw.volumes));
    z = 0;
  }
  for (RawCell& cell : raw.cells) {
    const int n = shape_of(cell.kind).corners;
    double twice_area = 0;
    for (int k = 0; k < n; ++k) {
      const Vec3 &a = raw.points[cell.nodes[k]], &b = raw.points[cell.nodes[(k + 1) % n]];
      twice_area += a.x() * b.y() - a.y() * b.x();
    }
    if (twice_area < 0) std::reverse(cell.nodes + 1, cell.nodes + n);
  }
}

/// A mirrored mesh, all of whose cells are inverted, is one of its mirror image with its cells turned round.
void turn_mirrored(RawMesh& raw) {
  const auto volume = [&](const RawCell& cell) {  // of a corner: that of no corner is of another sign in a cell that is good
    constexpr int kAtFirst[][3] = {{1, 2, 3}, {1, 3, 4}, {1, 2, 3}, {1, 3, 4}};  // tetrahedron, hexahedron, wedge, pyramid
    const int* next = kAtFirst[static_cast<int>(cell.kind) - static_cast<int>(RawKind::tetrahedron)];
    const Vec3& o = raw.points[cell.nodes[0]];
    return (raw.points[cell.nodes[next[0]]] - o).cross(raw.points[cell.nodes[next[1]]] - o).dot(raw.points[cell.nodes[next[2]]] - o);
  };
  if (std::any_of(raw.cells.begin(), raw.cells.end(), [&](const RawCell& cell) { return !(volume(cell) < 0); })) return;
  if (raw.note.empty()) raw.note = raw.source + " has no cell that is not inverted: it was taken as a mirrored mesh, and its cells were turned round";
  for (RawCell& cell : raw.cells) {
    std::swap(cell.nodes[1], cell.nodes[cell.kind == RawKind::tetrahedron || cell.kind == RawKind::wedge ? 2 : 3]);
    if (cell.kind == RawKind::hexahedron) std::swap(cell.nodes[5], cell.nodes[7]);
    if (cell.kind == RawKind::wedge) std::swap(cell.nodes[4], cell.nodes[5]);
  }
}

/// The quadrilateral faces of a solid cell, whether it is split or stays whole.
QuadFaces quad_faces_of(RawKind kind) {
  return split_faces_of(kind == RawKind::hexahedron ? CellKind::hex24 : kind == RawKind::wedge ? CellKind::wedge14 : kind == RawKind::pyramid ? CellKind::pyramid8 : CellKind::tetrahedron);
}

/// The triangular faces of a solid cell, by their corners.
struct Triangles {
  int count = 0;
  int corners[4][3] = {};
};
constexpr Triangles triangles_of(RawKind kind) {
  if (kind == RawKind::tetrahedron) return {4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  if (kind == RawKind::wedge) return {2, {{0, 1, 2}, {3, 4, 5}}};
  if (kind == RawKind::pyramid) return {4, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  return {};
}

/// Of four nodes those that are not the one at `skip`, rising.
std::array<int, 3> three_of(const std::array<int, 4>& nodes, int skip) {
  std::array<int, 3> three;
  for (int k = 0, at = 0; k < 4; ++k)
    if (k != skip) three[at++] = nodes[k];
  std::sort(three.begin(), three.end());
  return three;
}

const RawCell* first_of(const RawMesh& raw, RawKind kind) {
  const auto found = std::find_if(raw.cells.begin(), raw.cells.end(), [&](const RawCell& cell) { return cell.kind == kind; });
  return found == raw.cells.end() ? nullptr : &*found;
}

// Triangular faces know nothing of the centre that hex24, wedge14 and pyramid8 put on a shared face, and hexahedra that stay whole have none.
void check_kinds_apart(const RawMesh& raw) {
  const bool whole = raw.one_point && first_of(raw, RawKind::hexahedron);
  for (RawKind kind : {RawKind::wedge, RawKind::pyramid})
    if (const RawCell* other = first_of(raw, kind); whole && other) {
      const std::string name = shape_of(kind).name;
      refuse(raw, "holds hexahedra and " + name + "s, the first of which is " + std::to_string(other->tag) + "; with the pattern one_point hexahedra stay whole, and " + name + "s, which are split, do not fit beside them: give the pattern fine, or mesh the body with hexahedra alone");
    }
  std::map<std::array<int, 3>, const char*> corners_of_faces;
  for (const RawCell& cell : raw.cells) {
    const QuadFaces faces = quad_faces_of(cell.kind);
    for (int f = 0; f < faces.count; ++f)
      for (int skip = 0; skip < 4; ++skip) corners_of_faces.emplace(three_of(face_of(cell.nodes, faces.corners[f]), skip), shape_of(cell.kind).name);
  }
  if (corners_of_faces.empty()) return;
  for (const RawCell& cell : raw.cells) {
    const Triangles triangles = triangles_of(cell.kind);
    for (int t = 0; t < triangles.count; ++t) {
      const int* corners = triangles.corners[t];
      std::array<int, 3> nodes{cell.nodes[corners[0]], cell.nodes[corners[1]], cell.nodes[corners[2]]};
      std::sort(nodes.begin(), nodes.end());
      if (const auto face = corners_of_faces.find(nodes); face != corners_of_faces.end())
        refuse(raw, std::string(shape_of(cell.kind).name) + " " + std::to_string(cell.tag) + " lies on a face with four corners of a " + face->second + ", which is " +
                        (whole ? "not split" : "split about its centre") + "; mesh a body with one of the two kinds" + (whole ? "" : ", or put pyramids between them"));
    }
  }
}

struct Split {
  std::vector<long long> tags;  // of the cells in the order of Mesh::cells
  Centres faces;                // centres of quadrilaterals and solid cells and of their faces
};

Split split(const RawMesh& raw, Mesh& mesh) {
  Split result;
  std::vector<Quad> quads;
  std::vector<Hex> hexes;
  const auto take = [&](RawKind kind, auto&& each) {
    for (const RawCell& cell : raw.cells)
      if (cell.kind == kind) {
        each(cell);
        result.tags.push_back(cell.tag);
      }
  };
  const auto as_they_are = [&](RawKind raw_kind, CellKind kind) {
    Cells block{kind, {}};
    take(raw_kind, [&](const RawCell& c) { block.nodes.insert(block.nodes.end(), c.nodes, c.nodes + shape_of(raw_kind).corners); });
    if (!block.nodes.empty()) mesh.cells.push_back(std::move(block));
  };
  const auto take_solids = [&](RawKind kind, auto& solids) {
    take(kind, [&](const RawCell& c) {
      solids.emplace_back();
      std::copy_n(c.nodes, solids.back().size(), solids.back().begin());
    });
  };
  as_they_are(RawKind::triangle, CellKind::triangle);
  take(RawKind::quadrilateral, [&](const RawCell& c) { quads.push_back({c.nodes[0], c.nodes[1], c.nodes[2], c.nodes[3]}); });
  if (!quads.empty()) result.faces = split_quads(mesh, quads, raw.one_point ? CellKind::quad1 : CellKind::crossed);
  as_they_are(RawKind::tetrahedron, CellKind::tetrahedron);
  take_solids(RawKind::hexahedron, hexes);
  if (!hexes.empty()) result.faces = split_hexes(mesh, hexes, raw.one_point ? CellKind::hex1 : CellKind::hex24);
  std::vector<Wedge> wedges;
  take_solids(RawKind::wedge, wedges);
  split_wedges(mesh, wedges, result.faces);
  std::vector<Pyramid> pyramids;
  take_solids(RawKind::pyramid, pyramids);
  split_pyramids(mesh, pyramids, result.faces);
  return result;
}

// Names the cells with a simplex that is not positive by their author's numbers.
void check_cells(const RawMesh& raw, const Mesh& mesh, const std::vector<long long>& tags) {
  std::vector<std::size_t> bad;
  std::size_t cell = 0;
  for (const Cells& block : mesh.cells) {
    const CellShape& shape = shape_of(block.kind);
    for (int c = 0; c < block.count(); ++c, ++cell) {
      const int* nodes = &block.nodes[static_cast<std::size_t>(c) * shape.nodes];
      bool good = true;
      for (int s = 0; s < shape.checked; ++s) {
        std::array<int, 4> simplex{-1, -1, -1, -1};
        for (int k = 0; k <= shape.dimension; ++k) simplex[k] = nodes[shape.check[s][k]];
        good = good && signed_volume(mesh.nodes, simplex, mesh.dimension) > 0;
      }
      if (!good) bad.push_back(cell);
    }
  }
  if (bad.empty()) return;
  std::ostringstream text;
  text << bad.size() << " of " << cell << " cells are inverted, flat or not convex: ";
  for (std::size_t k = 0; k < std::min(kNamed, bad.size()); ++k) text << (k ? ", " : "") << tags[bad[k]];
  if (bad.size() > kNamed) text << " ...";
  text << "; every cell needs a positive volume: turn round their node order or mesh the body anew";
  refuse(raw, text.str());
}

/// Two cells with the same nodes; none: nullopt.
std::optional<std::pair<long long, long long>> repeated_cells(const RawMesh& raw) {
  std::map<std::vector<int>, long long> known;
  for (const RawCell& cell : raw.cells) {
    std::vector<int> nodes(cell.nodes, cell.nodes + shape_of(cell.kind).corners);
    std::sort(nodes.begin(), nodes.end());
    const auto [found, fresh] = known.emplace(std::move(nodes), cell.tag);
    if (!fresh) return std::pair(found->second, cell.tag);
  }
  return std::nullopt;
}

void lay_sets(const RawMesh& raw, const Centres& centres, Mesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Cells& block : mesh.cells)
    for (int n : block.nodes) used[n] = 1;
  for (const auto& [name, cells] : raw.groups) {
    std::vector<int> nodes;
    const auto take = [&](int n) { if (n >= 0 && used[n]) nodes.push_back(n); };
    for (const RawCell& cell : cells) {
      const int corners = shape_of(cell.kind).corners;
      for (int k = 0; k < corners; ++k) take(cell.nodes[k]);
      if (corners >= 4) take(centres.find(cell.nodes, corners));
      const QuadFaces faces = quad_faces_of(cell.kind);
      for (int f = 0; f < faces.count; ++f) {
        const std::array<int, 4> four = face_of(cell.nodes, faces.corners[f]);
        take(centres.find(four.data(), 4));
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (!nodes.empty()) mesh.sets[name] = std::move(nodes);
  }
}

std::string name_of(const RawMesh& raw, int node) { return node < static_cast<int>(raw.point_tags.size()) ? std::to_string(raw.point_tags[node]) : "(the middle of a cell's side)"; }

// A body is whole: its cells are joined wherever they touch.
void check_seams(const RawMesh& raw, const Mesh& mesh) {
  const std::vector<Seam> seams = find_seams(mesh);
  if (seams.empty()) return;
  const Seam& first = seams.front();
  std::ostringstream text;
  text << "cells touch without being joined, at " << seams.size() << (seams.size() == 1 ? " node" : " nodes") << " of the surface: the first is node " << name_of(raw, first.node) << " at "
       << place(mesh.nodes[first.node]) << ", which lies on the side of another cell with the nodes";
  for (int k = 0; k < mesh.dimension; ++k) text << ' ' << name_of(raw, first.facet.nodes[k]);
  text << "; the body is torn there, and its parts would pass through each other: merge doubled nodes (Coherence Mesh in gmsh), "
          "mesh parts that meet with the same nodes, or give them as bodies of their own, tied or sliding";
  refuse(raw, text.str());
}

// Cells hang together by faces.
void check_cuts(const RawMesh& raw, const Mesh& mesh) {
  const std::vector<CrossedCut> cuts = find_crossed_cuts(mesh);
  if (cuts.empty()) return;
  std::ostringstream text;
  text << "the cells on both sides of a face with four corners cut it along different diagonals, " << (cuts.size() == 1 ? "once" : std::to_string(cuts.size()) + " times") << ": the first time with the nodes";
  for (int n : cuts.front()) text << ' ' << name_of(raw, n);
  text << ", the first of which is at " << place(mesh.nodes[cuts.front()[0]]) << "; the body is torn there, since the cells share its corners but no triangle: cut both sides along the same diagonal, or do not cut hexahedra, wedges and pyramids: "
          "they are split about the centres of their faces here";
  refuse(raw, text.str());
}

}  // namespace

const RawShape& shape_of(RawKind kind) {
  static constexpr RawShape shapes[] = {{"point", 0, 1},         {"line", 1, 2},        {"triangle", 2, 3},
                                        {"quadrilateral", 2, 4}, {"tetrahedron", 3, 4}, {"hexahedron", 3, 8}, {"wedge", 3, 6}, {"pyramid", 3, 5}};
  return shapes[static_cast<int>(kind)];
}

Mesh assemble(RawMesh& raw) {
  check_points(raw);
  if (raw.dimension == 2) lay_flat(raw);
  else turn_mirrored(raw);
  check_kinds_apart(raw);
  Mesh mesh;
  mesh.dimension = raw.dimension;
  mesh.nodes = raw.points;
  const Split parts = split(raw, mesh);
  check_cells(raw, mesh, parts.tags);
  lay_sets(raw, parts.faces, mesh);
  try {
    find_surface(mesh);
    check_volumes(mesh);
  } catch (const Error& error) {
    if (const auto twice = repeated_cells(raw)) refuse(raw, "cells " + std::to_string(twice->first) + " and " + std::to_string(twice->second) + " have the same nodes; remove repeated cells");
    const std::string what = error.what();  // "mesh: ...": the source takes the place of the first word
    throw Error(error.code(), raw.source + what.substr(what.find(':')));
  }
  check_seams(raw, mesh);
  check_cuts(raw, mesh);
  return mesh;
}

}  // namespace forming_sim
