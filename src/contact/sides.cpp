// On which side of a tool's facets the bodies are, whatever way its file turns them.
#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/crossing.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

constexpr double kFold = 1e-4;    // radians between two facets that lie on each other
constexpr double kBeside = 1e-4;  // radians to the plane of a facet below which a point does not know its side

// Facets that one knows the sides of together: neighbours where two meet in an edge (2D: a vertex),
// unless they are folded onto each other, so that nothing is between them, or one is `alone`.
struct Patches {
  std::vector<int> of_facet;       ///< index: facet - first_facet
  std::vector<int> sign;           ///< of every facet, +1 / -1 so that neighbours in a patch agree
  std::vector<bool> torn;          ///< of every patch: that is impossible
  std::vector<bool> border;        ///< of every vertex: a patch ends there
};

class PatchFinder {
 public:
  PatchFinder(const Features& f, int surface, const std::vector<bool>& alone) : f_(f), first_(f.surfaces[surface].first_facet), facets_(f.surfaces[surface].last_facet - first_) {
    patches_.border.assign(f.vertex_count, false);
    link(alone);
    spread();
  }
  Patches take() { return std::move(patches_); }

 private:
  struct Link {
    int joint, facet, way;  ///< an edge (2D: a vertex), and the way that the facet runs along it
  };
  struct Neighbour {
    int facet, same;  ///< same: -1 where the signs must differ
  };

  const std::array<int, 3>& corners(int i) const { return f_.facets[first_ + i]; }
  const Node& at(int v) const { return f_.place[v - f_.body_nodes]; }

  void link(const std::vector<bool>& alone) {
    std::vector<Link> links;
    for (int i = 0; i < facets_; ++i) {
      if (f_.dimension == 2) {
        links.push_back({corners(i)[0], i, -1});
        links.push_back({corners(i)[1], i, 1});
      } else {
        for (int k = 0; k < 3; ++k) links.push_back({f_.facet_edges[first_ + i][k], i, k == 2 ? -1 : 1});
      }
    }
    std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.joint != b.joint ? a.joint < b.joint : a.facet < b.facet; });
    neighbours_.resize(facets_);
    for (size_t i = 0; i < links.size();) {
      size_t j = i;
      while (j < links.size() && links[j].joint == links[i].joint) ++j;
      const int a = links[i].facet, b = links[j - 1].facet, joint = links[i].joint;
      if (j - i == 2 && !alone[a] && !alone[b] && !folded(a, b, joint)) {
        const int same = links[i].way == links[i + 1].way ? -1 : 1;
        neighbours_[a].push_back({b, same});
        neighbours_[b].push_back({a, same});
      } else if (f_.dimension == 2) {
        patches_.border[joint] = true;
      } else {
        for (int v : f_.edges[joint].node) patches_.border[v] = true;
      }
      i = j;
    }
  }

  // From the joint into the facet, across the joint.
  Node inward(int i, int joint) const {
    const auto& c = corners(i);
    if (f_.dimension == 2) return at(c[0] == joint ? c[1] : c[0]) - at(joint);
    const Features::Edge& e = f_.edges[joint];
    const Node u = at(e.node[1]) - at(e.node[0]);
    for (int k = 0; k < 3; ++k)
      if (c[k] != e.node[0] && c[k] != e.node[1]) {
        const Node r = at(c[k]) - at(e.node[0]);
        return r - dot3(r, u) / dot3(u, u) * u;
      }
    return Node::Zero();
  }
  bool folded(int a, int b, int joint) const {
    const Node u = inward(a, joint), v = inward(b, joint);
    return dot3(u, v) > 0 && cross3(u, v).norm() < kFold * u.norm() * v.norm();
  }

  void spread() {
    patches_.sign.assign(facets_, 0);
    patches_.of_facet.assign(facets_, -1);
    std::vector<int> stack;
    for (int start = 0; start < facets_; ++start) {
      if (patches_.sign[start] != 0) continue;
      const int patch = static_cast<int>(patches_.torn.size());
      patches_.torn.push_back(false);
      patches_.sign[start] = 1;
      stack.push_back(start);
      while (!stack.empty()) {
        const int i = stack.back();
        stack.pop_back();
        patches_.of_facet[i] = patch;
        for (const Neighbour& n : neighbours_[i]) {
          if (patches_.sign[n.facet] == 0) {
            patches_.sign[n.facet] = patches_.sign[i] * n.same;
            stack.push_back(n.facet);
          } else if (patches_.sign[n.facet] != patches_.sign[i] * n.same) {
            patches_.torn[patch] = true;
          }
        }
      }
    }
  }

  const Features& f_;
  int first_, facets_;
  std::vector<std::vector<Neighbour>> neighbours_;
  Patches patches_;
};

struct Verdict {
  int side = 0;       ///< of the bodies: +1, -1, 0 both or unknown
  bool both = false;  ///< they are on both
  bool seen = false;  ///< it is nearest to some of their points
};

// A point knows best the side of the patch that is nearest to it, for nothing is between them; then that of
// others it looks at; and where it looks at the border of a patch, it may be beside it. Nodes on the surface do not
// know their side, and those that overlap a little are mistaken: nearer than `least` they are not asked.
// points: nodes of the bodies, in the tool's frame.
std::vector<Verdict> vote(const Features& f, int surface, const Patches& patches, const NodeField& points, double least) {
  const auto& s = f.surfaces[surface];
  const size_t count = patches.torn.size();
  const auto at = [&](int v) -> const Node& { return f.place[v - f.body_nodes]; };
  struct Nearest {
    double squared, slope;
    int side;
    bool border;
  };
  enum { kFacing, kBehind, kAtBorder, kBehindAtBorder, kKinds };
  std::vector<std::array<std::array<int, 2>, kKinds>> votes(count);  // -, +
  for (const Node& p : points) {
    std::vector<Nearest> nearest(count, {1e300, 0, 0, false});
    for (int i = s.first_facet; i < s.last_facet; ++i) {
      const auto& c = f.facets[i];
      const Node& third = f.dimension == 2 ? at(c[1]) : at(c[2]);
      const Closest q = closest_on_facet(f.corners(), p, at(c[0]), at(c[1]), third);
      Nearest& best = nearest[patches.of_facet[i - s.first_facet]];
      if (q.squared > best.squared * (1 + 1e-9)) continue;
      const Node& d = q.apart;
      bool on_border = q.feature != Closest::face;
      for (int k = 0; k < f.corners(); ++k)
        if (q.weight[k] > 0 && !patches.border[c[k]]) on_border = false;
      // Of facets equally near, the one that faces the point most squarely knows its side.
      const double slope = dot3(d, facet_normal(f.dimension, at(c[0]), at(c[1]), third)) * patches.sign[i - s.first_facet];
      if (q.squared < best.squared * (1 - 1e-9) || std::abs(slope) > best.slope)
        best = {std::min(q.squared, best.squared), std::abs(slope), std::abs(slope) < kBeside * d.norm() ? 0 : slope > 0 ? 1 : -1, on_border};
    }
    double any = 1e300, squarely = 0;
    for (const Nearest& n : nearest) any = std::min(any, n.squared);
    if (any <= least * least) continue;
    const auto as_near = [&](const Nearest& n) { return n.squared <= any * (1 + 1e-9); };
    for (const Nearest& n : nearest)
      if (as_near(n)) squarely = std::max(squarely, n.slope);
    for (size_t k = 0; k < count; ++k) {
      if (nearest[k].side == 0) continue;
      const bool first = as_near(nearest[k]) && nearest[k].slope >= squarely * (1 - 1e-9);
      ++votes[k][nearest[k].border ? (first ? kAtBorder : kBehindAtBorder) : first ? kFacing : kBehind][nearest[k].side > 0];
    }
  }
  std::vector<Verdict> verdicts(count);
  for (size_t k = 0; k < count; ++k) {
    const auto used = std::find_if(votes[k].begin(), votes[k].end(), [](const std::array<int, 2>& n) { return n[0] + n[1] > 0; });
    if (used == votes[k].end()) continue;
    Verdict& verdict = verdicts[k];
    verdict.both = (*used)[0] > 0 && (*used)[1] > 0;
    if (!verdict.both && !patches.torn[k]) verdict.side = (*used)[1] > 0 ? 1 : -1;
    verdict.seen = used - votes[k].begin() == kFacing || used - votes[k].begin() == kAtBorder;
  }
  return verdicts;
}

}  // namespace

Sides find_sides(double layer, const Features& f, const NodeField& x, const std::vector<ToolMotion>& at_start) {
  Sides sides;
  sides.of_facet.assign(f.facets.size(), 1);
  sides.unknown.assign(at_start.size(), false);
  std::vector<int> vertices;
  for (int b = 0; b < f.bodies; ++b) vertices.insert(vertices.end(), f.surfaces[b].vertices.begin(), f.surfaces[b].vertices.end());
  for (size_t t = 0; t < at_start.size(); ++t) {
    const int surface = f.bodies + static_cast<int>(t);
    const auto& s = f.surfaces[surface];
    const int facets = s.last_facet - s.first_facet;
    if (facets == 0) continue;
    const size_t samples = std::max(50.0, std::min(2000.0, 4e6 / facets));
    const size_t stride = std::max<size_t>(1, vertices.size() / samples);
    NodeField points;
    for (size_t i = 0; i < vertices.size(); i += stride)
      points.push_back(node(at_start[t].rotation0.transpose() * (vec3(x[vertices[i]]) - at_start[t].position0)));
    const double least = std::max(3 * layer, 0.02 * f.smallest_edge);

    std::vector<bool> alone(facets, false);
    Patches patches = PatchFinder(f, surface, alone).take();
    std::vector<Verdict> verdicts = vote(f, surface, patches, points, least);
    // Where a surface goes through itself, what is its outside on the one hand is its inside on the other.
    if (std::any_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.both && v.seen; })) {
      alone = facets_through_others(f, surface);
      if (std::find(alone.begin(), alone.end(), true) != alone.end()) {
        patches = PatchFinder(f, surface, alone).take();
        verdicts = vote(f, surface, patches, points, least);
      }
    }
    for (int i = 0; i < facets; ++i) sides.of_facet[s.first_facet + i] = patches.sign[i] * verdicts[patches.of_facet[i]].side;
    for (const Verdict& v : verdicts)
      if (v.seen && v.side == 0) sides.unknown[t] = true;
  }
  return sides;
}

}  // namespace forming_sim
