// Section 2.2: cells of two triangles whose diagonals go the same way, alternate or go
// at random; beside them four crossed triangles a cell, which leave nothing to choose.
//
// Chosen: a square of 8 x 8 cells, 1 m, elastic, 150 MPa on the sides x = -1/2 and 1/2
// until .01 s. Load and square are mirror images of themselves; is the answer?
#include <cmath>
#include <map>
#include <random>

#include "paper/figures.h"
#include "paper/single_cell.h"

namespace forming_sim::bench {
namespace {

constexpr int kCells = 8;
constexpr double kStress = 150e6, kStep = 2.5e-6, kEnd = 0.1;
constexpr int kWindow = 2000;  // steps of a mean

/// quad2 cells are split from their first to their third corner: naming the corners
/// from the next one on turns the diagonal.
Mesh with_diagonals(const std::string& how) {
  if (how == "crossed") return square(kCells);
  Mesh mesh = square(kCells, "coarse");
  std::mt19937 random(1);
  for (Cells& cells : mesh.cells)
    for (int c = 0; c < cells.count(); ++c) {
      int* corner = cells.nodes.data() + 4 * c;
      const Vec3 diagonal = mesh.nodes[corner[2]] - mesh.nodes[corner[0]], middle = 0.5 * (mesh.nodes[corner[2]] + mesh.nodes[corner[0]]);
      const int column = static_cast<int>(std::floor((middle.x() + 0.5) * kCells)), row = static_cast<int>(std::floor((middle.y() + 0.5) * kCells));
      const bool rises = diagonal.x() * diagonal.y() > 0;
      const bool wanted = how == "same way" || (how == "alternating" ? (column + row) % 2 == 0 : random() % 2 == 0);
      if (rises != wanted) std::rotate(corner, corner + 1, corner + 4);
    }
  return mesh;
}

/// Node at the mirror image (x, -y) of each node.
std::vector<std::size_t> mirror_images(const NodeField& X) {
  const auto key = [](double x, double y) { return std::pair(std::lround(1e6 * x), std::lround(1e6 * y)); };
  std::map<std::pair<long, long>, std::size_t> at;
  for (std::size_t i = 0; i < X.size(); ++i) at[key(X[i][0], X[i][1])] = i;
  std::vector<std::size_t> image;
  for (const Node& n : X) image.push_back(at.at(key(n[0], -n[1])));
  return image;
}

}  // namespace

std::vector<Row> diagonals(const Request& request) {
  std::vector<Row> rows;
  Figure figure("section_2.2_symmetry", "Diagonals of the cells under a symmetric load, new method", "time, s", "way off the mirror image / largest displacement");
  Figure drift("section_2.2_area", "Diagonals of the cells, classical method", "time, s", "mean S/S0 in .005 s");
  for (const std::string how : {"same way", "alternating", "random", "crossed"})
    for (const std::string law : {"paper", "classical"}) {
      const Clock clock;
      SteppedBody body(with_diagonals(how), cell_material(law), how == "crossed" ? "cell" : "element");
      const std::vector<std::size_t> image = mirror_images(body.X);
      double force = 0;  // of a node inside a side
      for (std::size_t i = 0; i < body.X.size(); ++i) {
        if (std::abs(body.X[i][0]) < 0.5 - 1e-9) continue;
        force = kStress / kCells * (std::abs(body.X[i][1]) > 0.5 - 1e-9 ? 0.5 : 1);
        body.load[i][0] = body.X[i][0] > 0 ? force : -force;
      }
      double largest = 0, off = 0, loaded = 0, first = 0, last = 0, window = 0;
      const long steps = std::lround(kEnd / kStep), unloading = std::lround(kUnloading / kStep);
      for (long n = 0; n < steps; ++n) {
        if (n == unloading) body.load.assign(body.x.size(), Node::Zero());
        body.step(kStep);
        double moved = 0, here = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
          const Node mirrored(body.x[image[i]][0], -body.x[image[i]][1], 0, 0);
          here = std::max(here, (body.x[i] - mirrored).norm());
          moved = std::max(moved, (body.x[i] - body.X[i]).norm());
        }
        largest = std::max(largest, moved);
        off = std::max(off, here);
        if (n < unloading) loaded = off / largest;
        if (law == "paper" && n % 40 == 0) figure.add(how, static_cast<double>(n) * kStep, here / largest);
        if (law == "classical") {
          const double S = body.volume_ratio();
          window += S / kWindow;
          if (n % kWindow == kWindow - 1) {
            if (n > unloading) drift.add(how, (static_cast<double>(n) - 0.5 * kWindow) * kStep, window);
            window = 0;
          }
          if (n >= steps / 2) (n < 3 * steps / 4 ? first : last) += 4 * S / static_cast<double>(steps);
        }
      }
      if (law == "classical") {
        rows.push_back(just("section 2.2", how + ", classical: area drifts, 1/s", (last - first) / (0.25 * kEnd), clock.seconds()));
        continue;
      }
      // 8 cells a side: the mirror image of a rising diagonal falls, and lies one cell on.
      const bool symmetric = how == "crossed" || how == "alternating";
      for (const bool to_the_end : {false, true}) {
        const std::string quantity = how + (to_the_end ? ": off its mirror image / way, .1 s" : ": off its mirror image / way, .01 s");
        const double found = to_the_end ? off / largest : loaded;
        rows.push_back(symmetric ? at_most("section 2.2", quantity, found, 1e-9, clock.seconds()) : just("section 2.2", quantity, found, clock.seconds()));
      }
    }
  rows.front().note = "chosen: 8 x 8 cells, 150 MPa along x until .01 s, elastic, dt 2.5e-6 s, until .1 s, one random choice; pressure per triangle but crossed per cell, so that drifts of these two do not compare diagonals alone";
  figure.write(request.directory);
  drift.write(request.directory);
  return rows;
}

}  // namespace forming_sim::bench
