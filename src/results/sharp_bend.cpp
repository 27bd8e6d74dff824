#include "forming_sim/results/sharp_bend.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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
/// An edge (in a section: a node) between two faces that are level at the start.
struct Shared {
  int a, b, face, other;
};
/// Of every face whether it belongs to a cut edge of the sheet: faces that are level with their neighbours at the start make one patch, and one of an edge is
/// about as wide as the sheet is thick. X: at the start; thickness, m.
std::vector<char> on_cut_edges(const std::vector<Face>& faces, const std::vector<Shared>& shared, const NodeField& X, int dimension, double thickness) {
  constexpr double kWide = 1.5;  // thicknesses
  std::vector<int> patch(faces.size());
  std::iota(patch.begin(), patch.end(), 0);
  const auto root = [&](int i) {
    while (patch[i] != i) i = patch[i] = patch[patch[i]];
    return i;
  };
  std::vector<double> area(faces.size(), 0), rim(faces.size(), 0);
  for (const Shared& at : shared) patch[root(at.face)] = root(at.other);
  std::vector<std::map<std::pair<int, int>, int>> sides(dimension == 3 ? faces.size() : 0);  // of a patch, how often it has an edge
  for (int i = 0; i < static_cast<int>(faces.size()); ++i) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < faces[i].corners; ++k) {
      sum += area_share(faces[i], k, X, false);
      if (dimension == 3) ++sides[root(i)][std::minmax(faces[i].nodes[k], faces[i].nodes[(k + 1) % faces[i].corners])];
    }
    area[root(i)] += sum.norm();
  }
  for (std::size_t p = 0; p < sides.size(); ++p)
    for (const auto& [edge, times] : sides[p])
      if (times == 1) rim[p] += (X[edge.first] - X[edge.second]).norm();
  std::vector<char> cut(faces.size());
  for (int i = 0; i < static_cast<int>(faces.size()); ++i) {
    const int p = root(i);
    const double width = dimension == 2 ? area[p] : rim[p] > 0 ? 2 * area[p] / rim[p] : 1e300;
    cut[i] = width < kWide * thickness;
  }
  return cut;
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
  std::vector<Shared> shared;
  std::map<std::pair<int, int>, int> one_at;
  const std::vector<Face> faces = faces_of(mesh);
  for (int i = 0; i < static_cast<int>(faces.size()); ++i)
    for (int k = 0; k < faces[i].corners; ++k) {
      const int a = faces[i].nodes[k], b = mesh.dimension == 2 ? a : faces[i].nodes[(k + 1) % faces[i].corners];
      const auto [at, first] = one_at.try_emplace(std::minmax(a, b), i);
      if (first) continue;
      if (normal_of(faces[i], X).dot(normal_of(faces[at->second], X)) >= kLevel) shared.push_back({a, b, i, at->second});
    }
  const std::vector<char> cut = on_cut_edges(faces, shared, X, mesh.dimension, body.thickness);
  for (const auto& [a, b, i, j] : shared) {
    if (cut[i] || cut[j]) continue;  // it bulges or tapers, and is no bend
    const Vec3 before = normal_of(faces[i], X), before_other = normal_of(faces[j], X);
    const Vec3 after = normal_of(faces[i], now), after_other = normal_of(faces[j], now);
    if ((after - after_other).dot(centre_of(faces[i], now) - centre_of(faces[j], now)) <= 0) continue;  // the inside of a fold has creases of its own
    const double turned = degrees_between(after, after_other) - degrees_between(before, before_other);
    if (turned > sharpest.degrees) sharpest = {turned, (vec3(now[a]) + vec3(now[b])) / 2};
  }
  return sharpest;
}

}  // namespace forming_sim
