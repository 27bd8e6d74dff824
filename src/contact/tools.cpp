#include "forming_sim/contact/tools.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/crossing.h"

namespace forming_sim {
namespace {

// +1 / -1 per facet so that neighbours in a part agree, starting from its first
// facet; `torn`: parts where that is impossible.
std::vector<int> agree(const Features& f, int surface, const Parts& parts, std::vector<bool>& torn) {
  const auto& s = f.surfaces[surface];
  const int facets = s.last_facet - s.first_facet;
  torn.assign(parts.closed.size(), false);
  struct Link {
    int joint, facet, way;
  };
  std::vector<Link> links;  // facets at an edge (2D: vertex), and the way they run along it
  for (int i = 0; i < facets; ++i) {
    const auto& c = f.facets[s.first_facet + i];
    if (f.dimension == 2) {
      links.push_back({c[0], i, -1});
      links.push_back({c[1], i, 1});
    } else {
      for (int k = 0; k < 3; ++k) links.push_back({f.facet_edges[s.first_facet + i][k], i, k == 2 ? -1 : 1});
    }
  }
  std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.joint != b.joint ? a.joint < b.joint : a.facet < b.facet; });
  struct Neighbour {
    int facet, same;  // same: -1 where the signs must differ
  };
  std::vector<std::vector<Neighbour>> neighbours(facets);
  for (size_t i = 0; i < links.size();) {
    size_t j = i;
    while (j < links.size() && links[j].joint == links[i].joint) ++j;
    if (j - i == 2) {
      const int same = links[i].way == links[i + 1].way ? -1 : 1;
      neighbours[links[i].facet].push_back({links[i + 1].facet, same});
      neighbours[links[i + 1].facet].push_back({links[i].facet, same});
    }
    i = j;
  }
  std::vector<int> sign(facets, 0), stack;
  for (int start = 0; start < facets; ++start) {
    if (sign[start] != 0) continue;
    sign[start] = 1;
    stack.push_back(start);
    while (!stack.empty()) {
      const int i = stack.back();
      stack.pop_back();
      for (const Neighbour& n : neighbours[i]) {
        if (sign[n.facet] == 0) {
          sign[n.facet] = sign[i] * n.same;
          stack.push_back(n.facet);
        } else if (sign[n.facet] != sign[i] * n.same) {
          torn[parts.of_facet[i]] = true;
        }
      }
    }
  }
  return sign;
}

// On which side of each part the body nodes `points` (in the tool's frame) are:
// +1, -1, 0 both. Nodes on the surface do not know their side, and those that
// overlap a little are mistaken: nearer than `least` they are not asked.
std::vector<int> vote(const Features& f, int surface, const Parts& parts, const std::vector<int>& sign, const NodeField& points,
                      double least) {
  const auto& s = f.surfaces[surface];
  const size_t count = parts.closed.size();
  std::vector<bool> border(f.vertex_count, false);
  for (int i = s.first_facet; i < s.last_facet; ++i)
    for (int k = 0; k < f.corners(); ++k) {
      if (f.dimension == 2) {
        if (f.facets_at_vertex[f.facets[i][k]] != 2) border[f.facets[i][k]] = true;
      } else if (f.edges[f.facet_edges[i][k]].facets != 2) {
        border[f.facets[i][k]] = border[f.facets[i][(k + 1) % 3]] = true;
      }
    }
  const auto at = [&](int v) -> const Node& { return f.place[v - f.body_nodes]; };
  struct Nearest {
    double squared, slope;
    int side;
    bool border;
  };
  std::vector<std::array<int, 4>> votes(count, {0, 0, 0, 0});  // inner -, +; border -, +
  for (const Node& p : points) {
    std::vector<Nearest> nearest(count, {1e300, 0, 0, false});
    for (int i = s.first_facet; i < s.last_facet; ++i) {
      const auto& c = f.facets[i];
      const Node& third = f.dimension == 2 ? at(c[1]) : at(c[2]);
      const Closest q = f.dimension == 2 ? closest_on_segment_facet(p, at(c[0]), at(c[1])) : closest_on_triangle(p, at(c[0]), at(c[1]), third);
      Nearest& best = nearest[parts.of_facet[i - s.first_facet]];
      if (q.squared > best.squared * (1 + 1e-9)) continue;
      const Node& d = q.apart;
      bool on_border = q.feature != Closest::face;
      for (int k = 0; k < f.corners(); ++k)
        if (q.weight[k] > 0 && !border[c[k]]) on_border = false;
      // Of facets equally near, the one that faces the point most squarely knows its side.
      const double slope = dot3(d, facet_normal(f.dimension, at(c[0]), at(c[1]), third)) * sign[i - s.first_facet];
      if (q.squared < best.squared * (1 - 1e-9) || std::abs(slope) > best.slope)
        best = {std::min(q.squared, best.squared), std::abs(slope), slope > 0 ? 1 : -1, on_border};
    }
    double any = 1e300;
    for (const Nearest& n : nearest) any = std::min(any, n.squared);
    if (any <= least * least) continue;
    for (size_t k = 0; k < count; ++k)
      if (nearest[k].side != 0) ++votes[k][(nearest[k].border ? 2 : 0) + (nearest[k].side > 0 ? 1 : 0)];
  }
  std::vector<int> side(count, 0);
  for (size_t k = 0; k < count; ++k) {
    const int use = votes[k][0] + votes[k][1] > 0 ? 0 : 2;
    const int minus = votes[k][use], plus = votes[k][use + 1];
    side[k] = minus == 0 && plus > 0 ? 1 : plus == 0 && minus > 0 ? -1 : 0;
  }
  return side;
}

}  // namespace

Node facet_normal(int dimension, const Node& a, const Node& b, const Node& c) {
  Node n;
  if (dimension == 2)
    n = Node(b[1] - a[1], a[0] - b[0], 0, 0);
  else
    n = cross3(b - a, c - a);
  const double size = n.norm();
  return size > 0 ? Node(n / size) : Node(Node::Zero());
}

void ToolSet::place_all(const Features& f, const std::vector<ToolMotion>& motion, bool at_end, NodeField& place) const {
  place.resize(f.place.size());
  for (size_t t = 0; t < motion.size(); ++t)
    for (int v : f.surfaces[f.bodies + t].vertices) {
      const Vec3 p = vec3(f.place[v - f.body_nodes]);
      place[v - f.body_nodes] = node(at_end ? pose1(motion[t], p) : pose0(motion[t], p));
    }
}

std::vector<PlanePose> ToolSet::planes(const std::vector<ToolMotion>& motion) const {
  std::vector<PlanePose> poses(motion.size());
  for (size_t t = 0; t < motion.size(); ++t)
    if (is_plane[t]) poses[t] = {node(pose0(motion[t], point[t])), node(motion[t].rotation0 * normal[t]), node(motion[t].rotation1 * normal[t])};
  return poses;
}

std::vector<bool> ToolSet::present(const std::vector<ToolMotion>& motion) {
  std::vector<bool> is(motion.size());
  for (size_t t = 0; t < motion.size(); ++t) is[t] = motion[t].present;
  return is;
}

std::vector<int> find_sides(double layer, const Features& f, const NodeField& x, const std::vector<ToolMotion>& at_start) {
  std::vector<int> sides(f.facets.size(), 1);
  std::vector<int> vertices;
  for (int b = 0; b < f.bodies; ++b) vertices.insert(vertices.end(), f.surfaces[b].vertices.begin(), f.surfaces[b].vertices.end());
  for (size_t t = 0; t < at_start.size(); ++t) {
    const int surface = f.bodies + static_cast<int>(t);
    const auto& s = f.surfaces[surface];
    const int facets = s.last_facet - s.first_facet;
    if (facets == 0) continue;
    const Parts parts = find_parts(f, surface);
    std::vector<bool> torn;
    const std::vector<int> sign = agree(f, surface, parts, torn);
    const size_t samples = std::max(50.0, std::min(2000.0, 4e6 / facets));
    const size_t stride = std::max<size_t>(1, vertices.size() / samples);
    NodeField points;
    for (size_t i = 0; i < vertices.size(); i += stride)
      points.push_back(node(at_start[t].rotation0.transpose() * (vec3(x[vertices[i]]) - at_start[t].position0)));
    const double least = std::max(3 * layer, 0.02 * f.smallest_edge);
    const std::vector<int> side = vote(f, surface, parts, sign, points, least);
    for (int i = 0; i < facets; ++i) {
      const int part = parts.of_facet[i];
      sides[s.first_facet + i] = torn[part] ? 0 : sign[i] * side[part];
    }
  }
  return sides;
}

void set_back(double layer, const std::vector<int>& sides, const ContactSetup& setup, Features& f, ToolSet& tools,
              std::vector<std::string>& warnings) {
  // Least-squares mitre: the displacement u of a vertex with m.u = -layer for the
  // normals m of all facets around it.
  std::vector<Mat3> a(f.place.size(), Mat3::Zero());
  std::vector<Vec3> b(f.place.size(), Vec3::Zero());
  for (size_t t = 0; t < setup.tools.size(); ++t) {
    const auto& s = f.surfaces[f.bodies + t];
    bool both = false;
    for (int i = s.first_facet; i < s.last_facet; ++i) {
      if (sides[i] == 0) both = true;
      const auto& c = f.facets[i];
      const auto at = [&](int k) -> const Node& { return f.place[c[k] - f.body_nodes]; };
      const Vec3 m = sides[i] * vec3(facet_normal(f.dimension, at(0), at(1), at(f.corners() - 1)));
      for (int k = 0; k < f.corners(); ++k) {
        double weight = 1;
        if (f.dimension == 3) {
          const Node u = at((k + 1) % 3) - at(k), v = at((k + 2) % 3) - at(k);
          weight = std::atan2(cross3(u, v).norm(), dot3(u, v));
        }
        a[c[k] - f.body_nodes] += weight * m * m.transpose();
        b[c[k] - f.body_nodes] -= weight * layer * m;
      }
    }
    if (both) {
      std::ostringstream text;
      text << "tool " << setup.tools[t].name << " has bodies on both sides of a connected part, or a part whose sides cannot be told: that part is not set back, and bodies touch it "
           << layer << " m before they reach it";
      warnings.push_back(text.str());
    }
  }
  for (size_t i = 0; i < f.place.size(); ++i) {
    if (b[i].isZero(0)) continue;
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(a[i]);
    Vec3 u = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const double value = eigen.eigenvalues()[k];
      if (value > 1e-3 * eigen.eigenvalues()[2]) u += eigen.eigenvectors().col(k) * (eigen.eigenvectors().col(k).dot(b[i]) / value);
    }
    const double most = 4 * layer;
    if (u.norm() > most) u *= most / u.norm();
    f.place[i] += node(u);
  }
  for (size_t t = 0; t < setup.tools.size(); ++t)
    if (tools.is_plane[t]) tools.point[t] -= layer * tools.normal[t];
}

}  // namespace forming_sim
