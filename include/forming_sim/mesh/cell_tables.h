#pragma once
// How each kind of cell is split into simplices, known at compile time so that
// the element kernels can unroll over a cell. mesh.h describes the node orders.
//
// Every simplex of a well-shaped cell has a positive volume:
// in 2D its three corners run counter-clockwise (the fourth entry is -1),
// in 3D (x1 - x0) x (x2 - x0) . (x3 - x0) > 0.
// The simplices of a cell have their first corner in common, its apex: their edge
// vectors are the ways from there to the cell's other nodes.
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

inline constexpr int kTriangle[1][4] = {{0, 1, 2, -1}};

inline constexpr int kQuad2[2][4] = {{0, 1, 2, -1}, {0, 2, 3, -1}};

inline constexpr int kCrossed[4][4] = {{4, 0, 1, -1}, {4, 1, 2, -1}, {4, 2, 3, -1}, {4, 3, 0, -1}};

inline constexpr int kTetrahedron[1][4] = {{0, 1, 2, 3}};

/// The six corners beside the diagonal 0-6 form the ring 1 2 3 7 4 5. The
/// diagonals of the faces are 0-2, 4-6, 0-5, 1-6, 3-6 and 0-7: two hexahedra
/// match where their shared edges 0-1, 3-2, 4-5, 7-6 (and 0-3 ..., 0-4 ...)
/// point the same way.
inline constexpr int kHex6[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                    {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};

/// Corners of the faces of a hexahedron, counter-clockwise seen from outside,
/// in the order of the face centres 8 ... 13: bottom, top, front, right, back, left.
inline constexpr int kHexFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Cell centre 14, an edge of a face, the centre of that face; face after face.
inline constexpr int kHex24[24][4] = {
    {14, 0, 3, 8},  {14, 3, 2, 8},  {14, 2, 1, 8},  {14, 1, 0, 8},
    {14, 4, 5, 9},  {14, 5, 6, 9},  {14, 6, 7, 9},  {14, 7, 4, 9},
    {14, 0, 1, 10}, {14, 1, 5, 10}, {14, 5, 4, 10}, {14, 4, 0, 10},
    {14, 1, 2, 11}, {14, 2, 6, 11}, {14, 6, 5, 11}, {14, 5, 1, 11},
    {14, 2, 3, 12}, {14, 3, 7, 12}, {14, 7, 6, 12}, {14, 6, 2, 12},
    {14, 3, 0, 13}, {14, 0, 4, 13}, {14, 4, 7, 13}, {14, 7, 3, 13}};

/// Corners of the quadrilateral faces of a wedge, counter-clockwise seen from outside, in the order of the face centres 6 ... 8.
inline constexpr int kWedgeFaces[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};

/// Cell centre 9 and bottom, top; then an edge of a quadrilateral face, the centre of that face; face after face.
inline constexpr int kWedge14[14][4] = {
    {9, 0, 2, 1}, {9, 3, 4, 5},
    {9, 0, 1, 6}, {9, 1, 4, 6}, {9, 4, 3, 6}, {9, 3, 0, 6},
    {9, 1, 2, 7}, {9, 2, 5, 7}, {9, 5, 4, 7}, {9, 4, 1, 7},
    {9, 2, 0, 8}, {9, 0, 3, 8}, {9, 3, 5, 8}, {9, 5, 2, 8}};

/// The base of a pyramid, counter-clockwise seen from outside; its centre is 5.
inline constexpr int kPyramidFaces[1][4] = {{0, 3, 2, 1}};

/// Cell centre 6, an edge of the base, its centre; then the sides.
inline constexpr int kPyramid8[8][4] = {
    {6, 0, 3, 5}, {6, 3, 2, 5}, {6, 2, 1, 5}, {6, 1, 0, 5},
    {6, 0, 1, 4}, {6, 1, 2, 4}, {6, 2, 3, 4}, {6, 3, 0, 4}};

/// The quadrilateral faces of a solid cell: their corners, and where the centres of those that have one stand among its nodes.
struct QuadFaces {
  int count = 0;
  const int (*corners)[4] = nullptr;
  int first_centre = 0;
};
inline constexpr QuadFaces kFacesOfHexahedron{6, kHexFaces, 8}, kFacesOfWedge{3, kWedgeFaces, 6}, kFacesOfPyramid{1, kPyramidFaces, 5};
/// Those that are split about their centres; none: of other cells.
constexpr QuadFaces split_faces_of(CellKind kind) {
  return kind == CellKind::hex24 ? kFacesOfHexahedron : kind == CellKind::wedge14 ? kFacesOfWedge : kind == CellKind::pyramid8 ? kFacesOfPyramid : QuadFaces();
}

/// The corners of a cell, each with its neighbours.
inline constexpr int kQuadCorners[4][4] = {{0, 1, 3, -1}, {1, 2, 0, -1}, {2, 3, 1, -1}, {3, 0, 2, -1}};
inline constexpr int kHexCorners[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                          {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};

/// The shapes, indexed by CellKind.
inline constexpr CellShape kShapes[kCellKinds] = {
    {"triangle", 2, 3, 1, kTriangle, 1, 1, kTriangle},
    {"quad2", 2, 4, 2, kQuad2, 2, 2, kQuad2},
    {"crossed", 2, 5, 4, kCrossed, 4, 4, kCrossed},
    {"tetrahedron", 3, 4, 1, kTetrahedron, 1, 1, kTetrahedron},
    {"hex6", 3, 8, 6, kHex6, 6, 6, kHex6},
    {"hex24", 3, 15, 24, kHex24, 24, 24, kHex24},
    {"quad1", 2, 4, 2, kQuad2, 1, 4, kQuadCorners},
    {"hex1", 3, 8, 6, kHex6, 1, 8, kHexCorners},
    {"wedge14", 3, 10, 14, kWedge14, 14, 14, kWedge14},
    {"pyramid8", 3, 7, 8, kPyramid8, 8, 8, kPyramid8}};

}  // namespace forming_sim
