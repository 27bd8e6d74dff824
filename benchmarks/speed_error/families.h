#pragma once
// The element families of the report, one line each. A cell is a quadrilateral or a
// hexahedron of a generated blank; free simplices are those of a mesh that gmsh made (support/free_mesh.h), their
// edges about as long as those of a cell.
#include <string>

namespace forming_sim::bench {

struct Family {
  const char* name;
  int dimension;
  const char* pattern;  ///< BlankConfig::pattern, or "free"
  const char* average;  ///< BodyModel::pressure_average
};

constexpr Family kFamilies[] = {{"4 crossed triangles", 2, "fine", "cell"},
                                {"2 triangles", 2, "coarse", "cell"},
                                {"free triangles", 2, "free", "cell"},
                                {"one-point quadrilaterals", 2, "one_point", "cell"},
                                {"24 tetrahedra", 3, "fine", "cell"},
                                {"6 tetrahedra", 3, "coarse", "cell"},
                                {"free tetrahedra", 3, "free", "cell"},
                                {"one-point hexahedra", 3, "one_point", "cell"}};

inline bool is_free(const Family& family) { return family.pattern == std::string("free"); }

}  // namespace forming_sim::bench
