#include "forming_sim/results/forming_limits.h"

#include <algorithm>
#include <limits>

#include "forming_sim/config/fault.h"
#include "forming_sim/material/forming_limit.h"
#include "forming_sim/results/nearest_point.h"

namespace forming_sim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool has_limit(const BodyModel& body) { return body.material.forming_limit.has_value(); }

}  // namespace

std::vector<const BodyModel*> with_forming_limit(const Model& model) {
  std::vector<const BodyModel*> bodies;
  for (const BodyModel& body : model.bodies)
    if (has_limit(body)) bodies.push_back(&body);
  return bodies;
}

FormingLimits::FormingLimits(const Model& model) : middle_(model, has_limit), dimension_(model.dimension), node_count_(model.node_count()) {
  for (const BodyModel* body : with_forming_limit(model)) {
    const std::vector<Vec3>& X = body->reference();
    Body one{*body->material.forming_limit, static_cast<int>(body - model.bodies.data()), body->first_node, {}};
    std::vector<int> nodes;
    for (const Membrane::SideFacet& facet : middle_.facets())
      if (facet.body == one.index) nodes.insert(nodes.end(), facet.nodes.begin(), facet.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty()) throw Error(Code::invalid_scene, "body " + body->name + " has a forming limit and no two sides: name sets bottom and top");
    std::vector<Vec3> points;
    for (const int n : nodes) points.push_back(X[n - body->first_node]);
    const NearestPoint tree(points);
    for (const Vec3& x : X) one.nearest.push_back(nodes[tree.to(x)]);
    bodies_.push_back(std::move(one));
  }
  if (!any()) return;
  for (const BodyModel& body : model.bodies)
    for (const Facet& facet : body.mesh.surface) element_of_facet_.push_back(body.first_element + facet.element);
}

FormingLimits::State FormingLimits::at(const NodeField& positions) const {
  State state;
  if (!any()) return state;
  state.strain.assign(element_of_facet_.size(), {kNone, kNone});
  state.ratio.assign(node_count_, kNone);
  const std::vector<SurfaceStrain> strains = middle_.at(positions);
  for (const Body& body : bodies_) {
    Peak greatest;
    double area = 0, beyond = 0;
    for (std::size_t i = 0; i < strains.size(); ++i) {
      const Membrane::SideFacet& facet = middle_.facets()[i];
      if (facet.body != body.index) continue;
      state.strain[facet.facet] = strains[i];
      const double ratio = limit_ratio(body.curve, strains[i].major, strains[i].minor);
      for (const int n : facet.nodes) state.ratio[n] = std::fmax(state.ratio[n], ratio);
      area += facet.area;
      if (ratio > 1) beyond += facet.area;
      Vec3 middle = Vec3::Zero();
      for (int k = 0; k < dimension_; ++k) middle += vec3(positions[facet.nodes[k]]) / dimension_;
      greatest.rise_to({ratio, element_of_facet_[facet.facet], middle, 0});
    }
    for (std::size_t n = 0; n < body.nearest.size(); ++n) state.ratio[body.first_node + n] = state.ratio[body.nearest[n]];
    state.greatest.push_back(greatest);
    state.beyond.push_back(beyond / area);
  }
  return state;
}

}  // namespace forming_sim
