#pragma once
// The element families of the report, one line each. A cell is a quadrilateral or a
// hexahedron of a generated blank; "free" simplices have the same corners, but their
// pressure is a mean over the nodes, as it is in a mesh of triangles or tetrahedra from a file.
namespace forming_sim::bench {

struct Family {
  const char* name;
  int dimension;
  const char* pattern;  ///< BlankConfig::pattern
  const char* average;  ///< BodyModel::pressure_average
};

constexpr Family kFamilies[] = {{"4 crossed triangles", 2, "fine", "cell"},
                                {"2 triangles", 2, "coarse", "cell"},
                                {"free triangles", 2, "coarse", "node"},
                                {"one-point quadrilaterals", 2, "one_point", "cell"},
                                {"24 tetrahedra", 3, "fine", "cell"},
                                {"6 tetrahedra", 3, "coarse", "cell"},
                                {"free tetrahedra", 3, "coarse", "node"},
                                {"one-point hexahedra", 3, "one_point", "cell"}};

}  // namespace forming_sim::bench
