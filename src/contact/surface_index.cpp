#include "forming_sim/contact/surface_index.h"

#include <algorithm>

namespace forming_sim {

ToolIndex::ToolIndex(const Features& f, const NodeField& place, const std::vector<bool>& asked)
    : place_(&place), first_(f.body_nodes), tools_(asked.size()) {
  Box everywhere;
  everywhere.low.setConstant(-1e300);
  everywhere.high.setConstant(1e300);
  for (std::size_t t = 0; t < asked.size(); ++t) {
    if (!asked[t]) continue;
    const int s = f.bodies + static_cast<int>(t);
    // The mean size of the tool's facets, but not below that of the bodies: they are what is asked for.
    double sum = 0;
    const auto& surface = f.surfaces[s];
    for (int i = surface.first_facet; i < surface.last_facet; ++i) {
      const auto& c = f.facets[i];
      sum += (place[c[1] - first_] - place[c[0] - first_]).norm();
    }
    const int facets = surface.last_facet - surface.first_facet;
    const double mean = facets > 0 ? sum / facets : 0;
    tools_[t] = SurfaceIndex(f, s, [&](int v) -> const Node& { return place[v - first_]; }, everywhere, std::max({f.mean_edge, mean, 1e-12}));
  }
}

}  // namespace forming_sim
