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
    work.each_of_bodies(pair, [&](int i, double b) {
      const double share = std::abs(b) * pair.impulse;
      weighted[i] += share * speed;
      total[i] += share;
    });
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
  const PlacedTools tools{*m.tool_index, motion, ToolSet::present(motion), m.tools.is_plane, m.tools.planes(motion)};
  const Encounters encounters(f, x, tools, reach + m.layer);
  // From the vertices of a body: the facets around them that are near are asked first, those farther off where none of these is.
  const auto from_vertices = [&](int own, const Indexed& other, const Box& near) {
    for (int v : f.surfaces[own].vertices) {
      if (!near.holds(x[v])) continue;
      const Node p = other.to_index(x[v]);
      for (double within = reach / 64;; within *= 2) {
        within = std::min(within, reach);
        other.index->facets(Indexed::around(within + m.layer, p), [&](int facet) {
          if (f.never_meet(v, own, facet, other.surface)) return;
          const auto& c = f.facets[facet];
          const double squared = closest_on_facet(f.corners(), p, encounters.place(c[0]), encounters.place(c[1]), encounters.place(c[f.corners() - 1])).squared;
          // A tool stands back by the layer from the surface that was given, where its side is known.
          const bool stands_back = f.rigid(c[0]) && m.sides[facet] != 0;
          gap[v] = std::min(gap[v], std::sqrt(squared) - (stands_back ? m.layer : 0));
        });
        if (gap[v] <= within) break;
      }
    }
  };
  const auto of_surfaces = [&](int a, const Indexed& b, const Box& near) {
    from_vertices(a, b, near);
    if (b.surface == a || b.surface >= f.bodies) return;
    const SurfaceIndex index = encounters.index_of_body(a, near);
    from_vertices(b.surface, {a, &index}, near);
  };
  double unused;
  encounters.each(of_surfaces, [&](int a, int tool) {
    const PlanePose& plane = tools.planes[tool];
    for (int v : f.surfaces[a].vertices)
      if (!f.tied_to_plane(f.relation(a, f.bodies + tool), v)) gap[v] = std::min(gap[v], dot3(x[v] - plane.point, plane.normal) - m.layer);
  }, unused);
  return gap;
}

}  // namespace forming_sim
