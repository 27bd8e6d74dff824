#include "forming_sim/contact/tools.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "forming_sim/contact/closest.h"

namespace forming_sim {

Node facet_normal(int dimension, const Node& a, const Node& b, const Node& c) {
  Node n;
  if (dimension == 2)
    n = node(b[1] - a[1], a[0] - b[0], 0);
  else
    n = cross3(b - a, c - a);
  const double size = n.norm();
  return size > 0 ? Node(n / size) : Node(Node::Zero());
}

void ToolSet::place_all(const Features& f, const std::vector<ToolMotion>& motion, NodeField& place) const {
  place.resize(f.place.size());
  for (size_t t = 0; t < motion.size(); ++t)
    for (int v : f.surfaces[f.bodies + t].vertices) {
      const Vec3 p = vec3(f.place[v - f.body_nodes]);
      place[v - f.body_nodes] = node(pose0(motion[t], p));
    }
}

std::vector<PlanePose> ToolSet::planes(const std::vector<ToolMotion>& motion) const {
  std::vector<PlanePose> poses;
  place_planes(motion, poses);
  return poses;
}

void ToolSet::place_planes(const std::vector<ToolMotion>& motion, std::vector<PlanePose>& planes) const {
  planes.assign(motion.size(), PlanePose());
  for (size_t t = 0; t < motion.size(); ++t)
    if (is_plane[t]) planes[t] = {node(pose0(motion[t], point[t])), node(motion[t].rotation0 * normal[t]), node(motion[t].rotation1 * normal[t])};
}

std::vector<bool> ToolSet::present(const std::vector<ToolMotion>& motion) {
  std::vector<bool> is(motion.size());
  for (size_t t = 0; t < motion.size(); ++t) is[t] = motion[t].present;
  return is;
}

void set_back(double layer, const Sides& sides, const Flush& flush, const ContactSetup& setup, Features& f, ToolSet& tools,
              std::vector<std::string>& warnings) {
  // Least-squares mitre: the displacement u of a vertex with m.u = -layer for the
  // normals m of all facets around it, 0 of those that face the other tool of a joint, and at the rim of a facet that has no side for the
  // direction m that points out of it: a blade ends at its edge.
  std::vector<Mat3> a(f.place.size(), Mat3::Zero());
  std::vector<Vec3> b(f.place.size(), Vec3::Zero());
  for (size_t t = 0; t < setup.tools.size(); ++t) {
    const auto& s = f.surfaces[f.bodies + t];
    const auto add = [&](int v, double weight, const Vec3& m, double by) {
      a[v - f.body_nodes] += weight * m * m.transpose();
      b[v - f.body_nodes] -= weight * by * m;
    };
    for (int i = s.first_facet; i < s.last_facet; ++i) {
      const auto& c = f.facets[i];
      const auto at = [&](int k) -> const Node& { return f.place[c[k] - f.body_nodes]; };
      const int side = sides.of_facet[i];
      const Vec3 m = side * vec3(facet_normal(f.dimension, at(0), at(1), at(f.corners() - 1)));
      for (int k = 0; k < f.corners(); ++k) {
        double weight = 1;
        if (f.dimension == 3) {
          const Node u = at((k + 1) % 3) - at(k), v = at((k + 2) % 3) - at(k);
          weight = std::atan2(cross3(u, v).norm(), dot3(u, v));
        }
        add(c[k], weight, m, flush.faces_joint(i, c[k]) ? 0 : layer);
        if (side != 0) continue;
        if (f.dimension == 2 && f.facets_at_vertex[c[k]] == 1) add(c[k], 1, vec3(at(k) - at(1 - k)).normalized(), layer);
        if (f.dimension == 3 && f.edges[f.facet_edges[i][k]].facets == 1) {
          const Vec3 u = vec3(at((k + 1) % 3) - at(k)), v = vec3(at((k + 2) % 3) - at(k));
          const Vec3 out = u.cross(u.cross(v)).normalized();
          add(c[k], 1, out, layer);
          add(c[(k + 1) % 3], 1, out, layer);
        }
      }
    }
    if (sides.unknown[t]) {
      std::ostringstream text;
      text << "tool " << setup.tools[t].name << " has bodies on both sides of a connected part, or a part whose sides cannot be told: its faces are not set back, and bodies touch them "
           << layer << " m before they reach them";
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
