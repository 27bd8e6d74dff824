#include "forming_sim/results/sharp_bend.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "forming_sim/mesh/faces.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {

namespace {
constexpr double kLevel = 0.9;  // cosine at the start: edges of the blank are none of its bends

Vec3 normal_of(const Face& face, const NodeField& x) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < face.corners; ++k) sum += area_share(face, k, x, false);
  return sum.normalized();
}
Vec3 centre_of(const Face& face, const NodeField& x) {
  Vec3 sum = Vec3::Zero();
  for (int n : face) sum += vec3(x[n]);
  return sum / face.corners;
}
double degrees_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / M_PI; }
}  // namespace

SharpBend sharpest_bend(const BodyModel& body, const NodeField& x) {
  SharpBend sharpest;
  const Mesh& mesh = body.mesh;
  if (!is_sheet(mesh, body.thickness)) return sharpest;
  NodeField X, now;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    X.push_back(node(mesh.nodes[n]));
    now.push_back(x[body.first_node + n]);
  }
  // Faces by the edges (in a section: the nodes) that they share; each with the first that has it.
  std::map<std::pair<int, int>, int> one_at;
  const std::vector<Face> faces = faces_of(mesh);
  for (int i = 0; i < static_cast<int>(faces.size()); ++i)
    for (int k = 0; k < faces[i].corners; ++k) {
      const int a = faces[i].nodes[k], b = mesh.dimension == 2 ? a : faces[i].nodes[(k + 1) % faces[i].corners];
      const auto [at, first] = one_at.try_emplace(std::minmax(a, b), i);
      if (first) continue;
      const Face& other = faces[at->second];
      const Vec3 before = normal_of(faces[i], X), before_other = normal_of(other, X);
      if (before.dot(before_other) < kLevel) continue;
      const Vec3 after = normal_of(faces[i], now), after_other = normal_of(other, now);
      if ((after - after_other).dot(centre_of(faces[i], now) - centre_of(other, now)) <= 0) continue;  // the inside of a fold has creases of its own
      const double turned = degrees_between(after, after_other) - degrees_between(before, before_other);
      if (turned > sharpest.degrees) sharpest = {turned, (vec3(now[a]) + vec3(now[b])) / 2};
    }
  return sharpest;
}

}  // namespace forming_sim
