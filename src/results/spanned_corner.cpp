#include "forming_sim/results/spanned_corner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "forming_sim/contact/closest.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {

namespace {

constexpr double kStandsOff = 0.1;   // of the face's length
constexpr double kOfTheForce = 0.1;  // of the tool
constexpr double kNear = 0.125;      // of the face's length: a corner of a radius of .3 of that is as good as sharp
const double kFolded = std::cos(45 * M_PI / 180), kLevel = 0.9;  // cosines, now and at the start

Vec3 normal_of(const Facet& f, int dimension, const NodeField& x) {
  const Vec3 a = vec3(x[f.nodes[1]] - x[f.nodes[0]]);
  return (dimension == 2 ? Vec3(a.y(), -a.x(), 0) : Vec3(a.cross(vec3(x[f.nodes[2]] - x[f.nodes[0]])))).normalized();
}

/// The faces of every node.
std::multimap<int, int> faces_at(const std::vector<Facet>& surface) {
  std::multimap<int, int> at;
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (int n : surface[i].nodes)
      if (n >= 0) at.emplace(n, static_cast<int>(i));
  return at;
}

/// Of the faces that have one of these nodes two that were level make 45 degrees now. Gives one of them, -1: none do.
int folded_at(const Simulation& simulation, const std::multimap<int, int>& faces, const std::array<int, 3>& nodes) {
  const int dimension = simulation.model().dimension;
  const std::vector<Facet>& surface = simulation.surface();
  std::vector<int> around;
  for (int n : nodes)
    for (auto [face, end] = faces.equal_range(n); face != end; ++face) around.push_back(face->second);
  const auto cosine = [&](int i, int j, const NodeField& x) { return normal_of(surface[i], dimension, x).dot(normal_of(surface[j], dimension, x)); };
  for (int i : around)
    for (int j : around)
      if (cosine(i, j, simulation.initial_positions()) > kLevel && cosine(i, j, simulation.positions()) < kFolded) return i;
  return -1;
}

/// The tool turns by 45 degrees and more within that distance of a place.
bool is_sharp(const ToolModel& tool, const ToolStatus& now, const Vec3& place, double within) {
  const int corners = tool.mesh.dimension;
  const Node p = node(Vec3(now.rotation.transpose() * (place - now.position)));  // in the frame of its mesh
  NodeField x;
  for (const Vec3& point : tool.mesh.nodes) x.push_back(node(point));
  std::vector<Vec3> normals;
  for (const Facet& f : tool.mesh.surface)
    if (closest_on_facet(corners, p, x[f.nodes[0]], x[f.nodes[1]], x[f.nodes[corners - 1]]).squared <= within * within) normals.push_back(normal_of(f, corners, x));
  return std::any_of(normals.begin(), normals.end(), [&](const Vec3& a) {
    return std::any_of(normals.begin(), normals.end(), [&](const Vec3& b) { return std::abs(a.dot(b)) < kFolded; });  // whichever way a file has turned its facets
  });
}

}  // namespace

SpannedCorner farthest_spanned_corner(const Simulation& simulation, const std::vector<float>& gap) {
  SpannedCorner farthest;
  if (gap.empty() || !(simulation.dt() > 0)) return farthest;
  const Model& model = simulation.model();
  const NodeField& x = simulation.positions();
  std::vector<SpannedCorner> of_tool(model.tools.size());
  std::vector<Vec3> borne(model.tools.size(), Vec3::Zero());
  std::multimap<int, int> faces;
  for (const Contact::PressedInside& press : simulation.pressed_inside()) {
    double stands_off = 0, length = 0;
    Vec3 place = Vec3::Zero();
    for (int a = 0; a < 3 && press.nodes[a] >= 0; ++a) {
      stands_off += press.weights[a] * gap[press.nodes[a]];
      place += press.weights[a] * vec3(x[press.nodes[a]]);
      for (int b = 0; b < a; ++b) length = std::max(length, (x[press.nodes[a]] - x[press.nodes[b]]).norm());
    }
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(), [&](const BodyModel& b) { return press.nodes[0] < b.first_node + b.node_count; });
    if (stands_off < kStandsOff * length || is_sheet(body->mesh, body->thickness)) continue;
    if (faces.empty()) faces = faces_at(simulation.surface());
    const int face = folded_at(simulation, faces, press.nodes);
    if (face < 0) continue;
    borne[press.tool] += press.impulse / simulation.dt();
    of_tool[press.tool].rise_to({{stands_off / length, simulation.surface()[face].element, place, simulation.time()}, model.tools[press.tool].name, length, 0});
  }
  for (std::size_t t = 0; t < of_tool.size(); ++t) {
    const Vec3& force = simulation.tools()[t].force;
    of_tool[t].share = force.isZero(0) ? 0 : std::clamp(-borne[t].dot(force) / force.squaredNorm(), 0.0, 1.0);
    const SpannedCorner& at = of_tool[t];
    if (at.share > kOfTheForce && is_sharp(model.tools[t], simulation.tools()[t], at.peak.position, kNear * at.length)) farthest.rise_to(of_tool[t]);
  }
  return farthest;
}

}  // namespace forming_sim
