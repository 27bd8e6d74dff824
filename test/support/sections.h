#pragma once
// Bodies of curved section for tests, plane and axisymmetric: a strip of cells is bent into place.
#include <functional>

#include "forming_sim/mesh/axis.h"
#include "support/free_mesh.h"
#include "support/rings.h"
#include "support/runs.h"

namespace forming_sim {

/// The unit square of cells, its corners moved to `place`, the middle of a crossed cell to
/// the mean of its corners. pattern "free": of triangles about as large.
inline Mesh mapped_section(int along, int through, const std::function<Vec3(double, double)>& place, const std::string& pattern = "fine") {
  if (pattern == "free") {
    Mesh mesh = free_rectangle(along, through, 1);
    for (Vec3& X : mesh.nodes) X = place(X.x() / along, X.y() / through);
    check_volumes(mesh);
    return mesh;
  }
  BlankConfig blank = strip_of(1, 1, along, through);
  blank.pattern = pattern;
  Mesh mesh = generate_blank(blank);
  for (int n = 0; n < (along + 1) * (through + 1); ++n) mesh.nodes[n] = place(mesh.nodes[n].x(), mesh.nodes[n].y());
  for (const Cells& cells : mesh.cells)
    for (int c = 0; c < cells.count() && cells.kind == CellKind::crossed; ++c) {
      const int* n = &cells.nodes[5 * c];
      mesh.nodes[n[4]] = (mesh.nodes[n[0]] + mesh.nodes[n[1]] + mesh.nodes[n[2]] + mesh.nodes[n[3]]) / 4;
    }
  check_volumes(mesh);
  return mesh;
}

/// Such a section that is turned about the axis: closed there.
inline Mesh bent_section(int along, int through, const std::function<Vec3(double, double)>& place, const std::string& pattern = "fine") {
  Mesh mesh = mapped_section(along, through, place, pattern);
  close_at_axis(mesh);
  return mesh;
}

/// One axisymmetric body, one form stage.
inline OneBody one_ring(const Mesh& mesh, const MaterialConfig& material, double duration, const std::string& average = "cell") {
  OneBody run(body_of(mesh, material, average), duration);
  run.model.axisymmetric = true;
  return run;
}

}  // namespace forming_sim
