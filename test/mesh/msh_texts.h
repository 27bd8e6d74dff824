#pragma once
// Small .msh files.
#include <sstream>
#include <string>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim::msh {

/// Two unit cubes along x, written by gmsh in format 2.2: volume "body", surfaces
/// "bottom face" (z = 0) and 7 without a name (x = 0), curve "edge".
inline const char kTwoCubes22[] = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 12 "edge"
2 11 "bottom face"
3 10 "body"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
5 0 0 1
6 2 0 1
7 2 1 1
8 0 1 1
9 1 0 0
10 1 1 0
11 1 0 1
12 1 1 1
$EndNodes
$Elements
7
1 1 2 12 1 1 9
2 1 2 12 1 9 2
3 3 2 11 1 1 9 10 4
4 3 2 11 1 9 2 3 10
5 3 2 7 25 4 1 5 8
6 5 2 10 1 1 9 10 4 5 11 12 8
7 5 2 10 1 9 2 3 10 11 6 7 12
$EndElements
)";

/// The same in format 4.1.
inline const char kTwoCubes41[] = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 12 "edge"
2 11 "bottom face"
3 10 "body"
$EndPhysicalNames
$Entities
8 12 6 1
1 0 0 0 0 
2 2 0 0 0 
3 2 1 0 0 
4 0 1 0 0 
5 0 0 1 0 
6 2 0 1 0 
10 2 1 1 0 
14 0 1 1 0 
1 0 0 0 2 0 0 1 12 2 1 -2 
2 2 0 0 2 1 0 0 2 2 -3 
3 0 1 0 2 1 0 0 2 3 -4 
4 0 0 0 0 1 0 0 2 4 -1 
6 0 0 1 2 0 1 0 2 5 -6 
7 2 0 1 2 1 1 0 2 6 -10 
8 0 1 1 2 1 1 0 2 10 -14 
9 0 0 1 0 1 1 0 2 14 -5 
11 0 0 0 0 0 1 0 2 1 -5 
12 2 0 0 2 0 1 0 2 2 -6 
16 2 1 0 2 1 1 0 2 3 -10 
20 0 1 0 0 1 1 0 2 4 -14 
1 0 0 0 2 1 0 1 11 4 1 2 3 4 
13 0 0 0 2 0 1 0 4 1 12 -6 -11 
17 2 0 0 2 1 1 0 4 2 16 -7 -12 
21 0 1 0 2 1 1 0 4 3 20 -8 -16 
25 0 0 0 0 1 1 1 7 4 4 11 -9 -20 
26 0 0 1 2 1 1 0 4 6 7 8 9 
1 0 0 0 2 1 1 1 10 6 -1 26 13 17 21 25 
$EndEntities
$Nodes
15 12 1 12
0 1 0 1
1
0 0 0
0 2 0 1
2
2 0 0
0 3 0 1
3
2 1 0
0 4 0 1
4
0 1 0
0 5 0 1
5
0 0 1
0 6 0 1
6
2 0 1
0 10 0 1
7
2 1 1
0 14 0 1
8
0 1 1
1 1 0 1
9
1 0 0
1 3 0 1
10
1 1 0
1 6 0 1
11
1 0 1
1 8 0 1
12
1 1 1
2 1 0 0
2 25 0 0
3 1 0 0
$EndNodes
$Elements
4 7 1 7
1 1 1 2
1 1 9 
2 9 2 
2 1 3 2
3 1 9 10 4 
4 9 2 3 10 
2 25 3 1
5 4 1 5 8 
3 1 5 2
6 1 9 10 4 5 11 12 8 
7 9 2 3 10 11 6 7 12 
$EndElements
)";

/// Nodes and elements in format 2.2.
inline std::string cells(const std::string& nodes, int node_count, const std::string& elements, int element_count) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(node_count) + "\n" + nodes +
         "$EndNodes\n$Elements\n" + std::to_string(element_count) + "\n" + elements + "$EndElements\n";
}

/// Tetrahedra, four of `corners` each, numbered from 1 as they come.
inline std::string tetrahedra(const std::vector<Vec3>& points, const std::vector<int>& corners) {
  std::ostringstream nodes, elements;
  for (std::size_t n = 0; n < points.size(); ++n) nodes << n + 1 << ' ' << points[n].transpose() << '\n';
  for (std::size_t i = 0; i < corners.size(); i += 4) {
    elements << i / 4 + 1 << " 4 2 1 1";
    for (int a = 0; a < 4; ++a) elements << ' ' << corners[i + a] + 1;
    elements << '\n';
  }
  return cells(nodes.str(), static_cast<int>(points.size()), elements.str(), static_cast<int>(corners.size()) / 4);
}

/// A unit square and a triangle to its right, both clockwise, node 5 at the
/// height z, a node 6 of no cell, and the left edge as group 3.
inline std::string section(const std::string& z) {
  return cells("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 " + z + "\n6 9 9 0\n", 6,
               "1 1 2 3 1 4 1\n2 3 2 1 1 1 4 3 2\n3 2 2 2 2 2 3 5\n", 3);
}

}  // namespace forming_sim::msh
