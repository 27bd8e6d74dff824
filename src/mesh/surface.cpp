// The surface of a body: the facets that belong to one simplex only.
#include <algorithm>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {
namespace {

// Facet opposite corner i, its normal pointing away from that corner when the
// simplex has a positive volume.
constexpr int kOpposite2[3][3] = {{1, 2, -1}, {2, 0, -1}, {0, 1, -1}};
constexpr int kOpposite3[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

struct Candidate {
  std::array<int, 3> key;  // nodes in rising order
  int order;               // simplex and corner, so that the surface keeps the order of the elements
  Facet facet;
};

[[noreturn]] void refuse_shared(const Mesh& mesh, const Candidate& c, int times) {
  std::ostringstream text;
  text << "mesh: the facet of nodes";
  for (int n : c.facet.nodes)
    if (n >= 0) text << ' ' << n;
  text << " near " << place(mesh.nodes[c.facet.nodes[0]]) << " belongs to " << times
       << " elements; a facet lies between two elements or on the surface, so remove repeated or overlapping cells";
  throw Error(Code::mesh_error, text.str());
}

// The facet runs the other way round in the element on its other side, or the
// two lie on the same side of it.
bool same_side(const Facet& a, const Facet& b, int d) {
  for (int turn = 0; turn < (d == 2 ? 1 : 3); ++turn) {
    bool same = true;
    for (int k = 0; k < d; ++k) same = same && a.nodes[k] == b.nodes[(k + turn) % d];
    if (same) return true;
  }
  return false;
}

[[noreturn]] void refuse_folded(const Mesh& mesh, const Facet& a, const Facet& b) {
  std::ostringstream text;
  text << "mesh: elements " << a.element << " and " << b.element << " near " << place(mesh.nodes[a.nodes[0]])
       << " lie on the same side of the facet they share; the mesh is folded there, or one of them has a negative volume";
  throw Error(Code::mesh_error, text.str());
}

}  // namespace

void find_surface(Mesh& mesh) {
  const int d = mesh.dimension;
  const auto simplices = mesh.simplices();
  std::vector<Candidate> all;
  all.reserve(simplices.size() * (d + 1));
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (int corner = 0; corner <= d; ++corner) {
      Candidate c;
      for (int k = 0; k < d; ++k)
        c.facet.nodes[k] = simplices[s][d == 2 ? kOpposite2[corner][k] : kOpposite3[corner][k]];
      c.facet.element = static_cast<int>(s);
      c.key = c.facet.nodes;
      std::sort(c.key.begin(), c.key.begin() + d);
      c.order = static_cast<int>(all.size());
      all.push_back(c);
    }
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.key != b.key ? a.key < b.key : a.order < b.order;
  });

  std::vector<Candidate> once;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end].key == all[i].key) ++end;
    if (end - i > 2) refuse_shared(mesh, all[i], static_cast<int>(end - i));
    if (end - i == 1) once.push_back(all[i]);
    else if (same_side(all[i].facet, all[i + 1].facet, d)) refuse_folded(mesh, all[i].facet, all[i + 1].facet);
    i = end;
  }
  std::sort(once.begin(), once.end(), [](const Candidate& a, const Candidate& b) { return a.order < b.order; });
  mesh.surface.clear();
  mesh.surface.reserve(once.size());
  for (const Candidate& c : once) mesh.surface.push_back(c.facet);
}

}  // namespace forming_sim
