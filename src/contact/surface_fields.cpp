// What contact knows of the surfaces, for those who look: gaps and slip.
#include "contact/impl.h"
#include "forming_sim/contact/impulse.h"

namespace forming_sim {

void Contact::Impl::add_slip(double dt) {
  if (slip.empty()) return;
  weighted.assign(work.body_entries, 0.0);
  total.assign(work.body_entries, 0.0);
  for (const ContactPair& pair : near.pairs) {
    if (pair.impulse == 0 || pair.rub < 0) continue;
    const Node u = relative(pair, work.v);
    const double speed = (u - dot3(pair.normal, u) * pair.normal).norm();
    for (int k = 0; k < pair.nodes; ++k) {
      if (pair.node[k] >= work.body_entries) continue;
      const double share = std::abs(pair.weight[k]) * pair.impulse;
      weighted[pair.node[k]] += share * speed;
      total[pair.node[k]] += share;
    }
  }
  for (int i = 0; i < work.body_entries; ++i)
    if (total[i] > 0) slip[work.vertex[i]] += dt * weighted[i] / total[i];
}

const std::vector<double>& Contact::slip() const { return impl_->slip; }

double Contact::gap_reach() const { return 2 * impl_->features.mean_edge; }

std::vector<double> Contact::gaps(const NodeField& x, const std::vector<ToolMotion>& motion) const {
  const Impl& m = *impl_;
  const Features& f = m.features;
  const double reach = gap_reach();
  std::vector<double> gap(x.size(), reach);
  NodeField place;
  m.tools.place_all(f, motion, false, place);
  const std::vector<PlanePose> planes = m.tools.planes(motion);
  Workspace work;
  const NearList list = build_list(f, x, {*m.tool_index, motion, ToolSet::present(motion), m.tools.is_plane, planes}, {}, reach + m.layer, work);
  const auto at = [&](int v) -> const Node& { return v < f.body_nodes ? x[v] : place[v - f.body_nodes]; };
  for (const auto& g : list.groups) {
    if (f.rigid(g.vertex)) continue;
    for (int i = g.first; i < g.last; ++i) {
      const int facet = list.facets[i].facet;
      const auto& c = f.facets[facet];
      const Node& p = at(g.vertex);
      const double squared = f.dimension == 2 ? closest_on_segment_facet(p, at(c[0]), at(c[1])).squared
                                              : closest_on_triangle(p, at(c[0]), at(c[1]), at(c[2])).squared;
      // A tool stands back by the layer from the surface that was given, where its side is known.
      const bool stands_back = f.rigid(c[0]) && m.sides[facet] != 0;
      gap[g.vertex] = std::min(gap[g.vertex], std::sqrt(squared) - (stands_back ? m.layer : 0));
    }
  }
  for (const auto& p : list.planes)
    gap[p.vertex] = std::min(gap[p.vertex], dot3(x[p.vertex] - planes[p.tool].point, planes[p.tool].normal) - m.layer);
  return gap;
}

}  // namespace forming_sim
