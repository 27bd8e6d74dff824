#include "forming_sim/results/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forming_sim/contact/facet_grid.h"
#include "forming_sim/contact/tools.h"
#include "forming_sim/element/sheet_sides.h"
#include "forming_sim/results/nearest_point.h"

namespace forming_sim {
namespace {

constexpr double kNear = 5;          ///< thicknesses: so far from below a node at the start every facet counts
constexpr double kStraight = 0.999;  ///< cosine to the normal of a facet farther off, from inside: a sheet that is sheared by more

}  // namespace

bool is_formed(const Model& model, const BodyModel& body) {
  const auto is_rubber = [](const BodyModel& b) { return b.material.law == "hyperelastic"; };
  return !is_rubber(body) || std::all_of(model.bodies.begin(), model.bodies.end(), is_rubber);
}

Thickness::Thickness(const Model& model) {
  NodeField start;
  for (const BodyModel& body : model.bodies) {
    const Mesh& mesh = body.mesh;
    const std::vector<Vec3>& reference = body.reference();
    for (const Vec3& X : reference) start.push_back(node(X));
    const auto [bottom_name, top_name] = sides_of_sheet(body, model.axisymmetric);
    if (top_name.empty()) continue;
    Sheet sheet;
    sheet.body = static_cast<int>(&body - model.bodies.data());
    sheet.first_node = body.first_node;
    sheet.formed = is_formed(model, body);
    sheet.corners = mesh.dimension;
    for (const int facet : facets_within(mesh, bottom_name)) sheet.bottom.push_back(joined_corners(body, facet));
    if (sheet.bottom.empty()) continue;
    for (int node : mesh.sets.at(top_name)) {
      sheet.top_start.push_back(reference[node]);
      sheet.top.push_back(body.first_node + node);
    }
    for (const auto& nodes : sheet.bottom) sheet.bottom_start.push_back(reference[nodes[0] - body.first_node]);
    const NearestPoint top_node(sheet.top_start), bottom_facet(sheet.bottom_start);
    for (const Vec3& X : reference) sheet.above.push_back(top_node.to(X));
    for (const Vec3& X : sheet.top_start) sheet.below.push_back(bottom_facet.to(X));
    sheet.stands.assign(sheet.top.size(), 1);
    sheet.reach.assign(sheet.top.size(), std::numeric_limits<double>::infinity());
    sheets_.push_back(std::move(sheet));
  }
  if (!any()) return;
  start_ = at(start);
  bool any_hangs_over = false;
  for (Sheet& sheet : sheets_) any_hangs_over = find_overhangs(model, start, sheet) || any_hangs_over;
  if (any_hangs_over) start_ = at(start);
  for (Sheet& sheet : sheets_) {
    for (std::size_t i = 0; i < sheet.top.size(); ++i) {
      const auto& c = sheet.bottom[sheet.below[i]];
      double longest = 0;
      for (int k = 0; k < 3; ++k) longest = std::max(longest, (start[c[k]] - start[c[(k + 1) % 3]]).norm());
      sheet.reach[i] = kNear * start_[sheet.top[i]] + 2 * longest;
    }
  }
}

// Where the bottom has been trimmed away the nearest of it lies beside a node of the top, not below it: nothing of it is near the place a thickness inwards.
bool Thickness::find_overhangs(const Model& model, const NodeField& start, Sheet& sheet) const {
  constexpr double kNearBelow = 0.5;  // thicknesses
  const BodyModel& body = model.bodies[sheet.body];
  std::vector<int> top;
  for (int node : sheet.top) top.push_back(node - sheet.first_node);
  const auto place = [&](int n) -> const Node& { return start[sheet.first_node + n]; };
  NodeField outward(body.mesh.nodes.size(), Node::Zero());
  for (const Facet& facet : body.mesh.surface) {
    const auto last = facet.nodes.begin() + sheet.corners;
    if (!std::all_of(facet.nodes.begin(), last, [&](int n) { return std::binary_search(top.begin(), top.end(), n); })) continue;
    const Node normal = facet_normal(sheet.corners, place(facet.nodes[0]), place(facet.nodes[1]), place(facet.nodes[sheet.corners - 1]));
    for (auto n = facet.nodes.begin(); n != last; ++n) outward[*n] += normal;
  }
  const FacetGrid bottom(sheet.corners, sheet.bottom, start);
  bool any = false;
  for (std::size_t i = 0; i < top.size(); ++i) {
    const double thickness = start_[sheet.top[i]], length = outward[top[i]].norm();
    if (std::isnan(thickness) || length == 0) continue;
    const Node inside = place(top[i]) - thickness / length * outward[top[i]];
    sheet.stands[i] = bottom.nearest(inside, sheet.below[i], [](int, double distance) { return distance; }) <= kNearBelow * thickness;
    any = any || !sheet.stands[i];
  }
  return any;
}

std::vector<int> Thickness::top() const {
  std::vector<int> nodes;
  for (const Sheet& sheet : sheets_)
    if (sheet.formed) nodes.insert(nodes.end(), sheet.top.begin(), sheet.top.end());
  return nodes;
}

std::vector<double> Thickness::at(const NodeField& positions) const {
  std::vector<double> thickness(positions.size(), std::numeric_limits<double>::quiet_NaN());
  const auto known = [&](int node) { return positions[node].allFinite(); };
  for (const Sheet& sheet : sheets_) {
    if (!std::all_of(sheet.top.begin(), sheet.top.end(), known)) continue;
    if (!std::all_of(sheet.bottom.begin(), sheet.bottom.end(), [&](const auto& c) { return known(c[0]) && known(c[1]) && known(c[2]); })) continue;
    const FacetGrid bottom(sheet.corners, sheet.bottom, positions);
    std::vector<double> of_top;
    for (std::size_t i = 0; i < sheet.top.size(); ++i) {
      const Node& p = positions[sheet.top[i]];
      if (!sheet.stands[i]) {
        of_top.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      of_top.push_back(bottom.nearest(p, sheet.below[i], [&](int facet, double distance) {  // through metal
        const double squared = (sheet.top_start[i] - sheet.bottom_start[facet]).squaredNorm();
        if (squared <= sheet.reach[i] * sheet.reach[i]) return distance;
        const auto& c = sheet.bottom[facet];
        const Node outward = facet_normal(sheet.corners, positions[c[0]], positions[c[1]], positions[c[2]]);
        return -dot3(bottom.closest(p, facet).apart, outward) > kStraight * distance ? distance : std::numeric_limits<double>::infinity();
      }));
    }
    for (std::size_t i = 0; i < sheet.above.size(); ++i) thickness[sheet.first_node + i] = of_top[sheet.above[i]];
  }
  return thickness;
}

std::vector<double> Thickness::thinning(const std::vector<double>& thickness) const {
  std::vector<double> thinning(thickness.size());
  for (std::size_t i = 0; i < thinning.size(); ++i) thinning[i] = 1 - thickness[i] / start_[i];
  return thinning;
}

std::optional<double> smallest(const std::vector<double>& values, const std::vector<int>& nodes) {
  std::vector<double> of_nodes;
  for (const int n : nodes) of_nodes.push_back(values[n]);
  return smallest(of_nodes);
}
std::optional<double> smallest(const std::vector<double>& values) {
  std::optional<double> least;
  for (double value : values)
    if (!std::isnan(value) && !(least && *least <= value)) least = value;
  return least;
}

}  // namespace forming_sim
