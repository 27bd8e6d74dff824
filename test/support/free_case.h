#pragma once
// The kinds of free mesh that tests of free simplices go through: triangles, rings and tetrahedra.
#include <ostream>

#include "support/free_mesh.h"

namespace forming_sim {

struct FreeCase {
  int dimension;
  bool ring;
};
inline std::ostream& operator<<(std::ostream& out, const FreeCase& c) { return out << c.dimension << "D" << (c.ring ? ", ring" : ""); }

/// A block of 1 x .7 (x .5) in cells of .25, rings from r = .3 on.
inline Mesh free_mesh(const FreeCase& c) {
  Mesh mesh = c.dimension == 2 ? free_rectangle(1, 0.7, 0.25) : free_box(Vec3(1, 0.7, 0.5), 0.25);
  if (c.ring)
    for (Vec3& X : mesh.nodes) X.x() += 0.3;
  return mesh;
}

}  // namespace forming_sim
