// Contact by geometry alone, as Wilkins' method has it (section 2.4): a boundary
// node that the predicted move brings into another body or a tool is put back
// onto the nearest point of its surface and slides there. On a rigid wall this
// is the paper's algorithm 1: x < x0 gives x = x0, v = 0.
//
// Where the other surface can move, node and side share the correction by their
// masses, in place and in velocity: to move the node alone would shift the
// joint surface by the full overlap in every step. Nodes of the first body
// against the second go first, then the reverse, tools last. A baseline: edges
// are not looked at, nor what a corner does to a side between its nodes, and a
// node deeper than its motion of one step is lost.
#include "contact/impl.h"
#include "forming_sim/contact/impulse.h"

namespace forming_sim {

void Contact::Impl::know_sides() {
  border.assign(features.vertex_count, false);
  for (size_t i = 0; i < features.facets.size(); ++i) {
    const auto& c = features.facets[i];
    const int surface = features.facet_surface[i];
    if (surface < features.bodies) sides[i] = features.facet_outward[i];
    for (int k = 0; k < features.corners(); ++k) {
      const int around = features.dimension == 2 ? features.facets_at_vertex[c[k]] : features.edges[features.facet_edges[i][k]].facets;
      if (around != 2) border[c[k]] = border[features.dimension == 2 ? c[k] : c[(k + 1) % 3]] = true;
    }
  }
  for (size_t t = 0; t < tools.names.size(); ++t) {
    const auto& s = features.surfaces[features.bodies + t];
    if (std::find(sides.begin() + s.first_facet, sides.begin() + s.last_facet, 0) != sides.begin() + s.last_facet)
      warnings.push_back("contact.method geometric does not act on the part of tool " + tools.names[t] + " whose inside cannot be told: give a closed surface with the bodies on one side, or set contact.method to implicit");
  }
}

double Contact::Impl::nearest_side(const NearList::VertexGroup& g, double deepest, ContactPair& pair) const {
  const Node& p = work.x[g.node];
  double best = 1e300, square = -1;
  for (int i = g.first; i < g.last; ++i) {
    const NearList::FacetEntry& e = list.facets[i];
    const Node &a = work.x[e.node[0]], &b = work.x[e.node[1]], &c = work.x[e.node[features.corners() - 1]];
    const Closest q = closest_on_facet(features.corners(), p, a, b, c);
    if (q.squared > best * (1 + 1e-9)) continue;
    const Node outward = sides[e.facet] * facet_normal(features.dimension, a, b, c);
    const double along = dot3(q.apart, outward), distance = std::sqrt(q.squared);
    // Of facets equally near, the one met most squarely tells inside from outside.
    if (q.squared >= best * (1 - 1e-9) && std::abs(along) <= square) continue;
    best = std::min(best, q.squared);
    square = std::abs(along);
    bool on_border = q.feature != Closest::face;
    pair.nodes = 1;
    pair.node[0] = g.node;
    pair.weight[0] = 1;
    for (int k = 0; k < features.corners(); ++k) {
      if (q.weight[k] == 0) continue;
      on_border = on_border && border[features.facets[e.facet][k]];
      pair.node[pair.nodes] = e.node[k];
      pair.weight[pair.nodes++] = -q.weight[k];
    }
    pair.gap = along < 0 ? -distance : distance;
    pair.normal = distance > 1e-6 * layer ? Node(q.apart / pair.gap) : outward;
    pair.key = PairKey::make(PairKey::vertex_facet, g.vertex, q.feature, e.facet);
    pair.own = features.vertex_surface[g.vertex];
    pair.surface = g.surface;
    // Unknown inside, or beside the end of an open surface, or lost.
    if (sides[e.facet] == 0 || (along < 0 && on_border) || pair.gap < -deepest) pair.nodes = 0;
  }
  return std::sqrt(best);
}

void Contact::Impl::put_back(ContactPair pair) {
  constants().set(pair, near.rubs);
  if (pair.w == 0) return;
  push(pair, (layer - pair.gap) / pair.w * pair.normal, work, work.x);
  const double closing = -dot3(pair.normal, relative(pair, work.v));
  if (closing > 0) {
    pair.impulse = closing / pair.w;
    push(pair, pair.impulse * pair.normal, work, work.v);
    if (pair.rub >= 0) end_slip(pair, near.rubs[pair.rub], work);
  }
  near.pairs.push_back(pair);
}

void Contact::Impl::advance_geometric(double dt, NodeField& x, NodeField& v, NodeField& v_star, const Predict& predict, const Move& move, const ToolsAt& tools_at) {
  tools_at(dt, motion);
  predict(dt, v_star);
  const double tool_way = step_way(x, dt), predicted = both * fastest(v_star) * dt + tool_way;
  const double deepest = layer + 2 * predicted;
  near = Narrow();
  ensure_list(x, deepest, 2 * predicted);
  double way = predicted;
  if (list.size() > 0) {
    tools.place_planes(motion, planes);
    gather(x, v, v_star, dt);
    // ---- the predicted move of bodies and tools
    for (size_t i = 0; i < work.x.size(); ++i) work.x[i] += dt * work.v[i];
    for (ToolMotion& m : motion) {
      m.position0 = m.position1;
      m.rotation0 = m.rotation1;
    }
    tools.place_planes(motion, planes);
    // ---- corrections
    enum { first_body, second_body, tool };
    for (int pass : {first_body, second_body, tool})
      for (NearList::VertexGroup& g : list.groups) {
        if (features.rigid(g.vertex) || g.wake > (travel + deepest) * (1 + 1e-12)) continue;
        if (pass != (g.surface >= features.bodies ? tool : features.vertex_surface[g.vertex] <= g.surface ? first_body : second_body)) continue;
        ContactPair pair;
        g.wake = travel + nearest_side(g, deepest, pair);
        if (pair.nodes > 0 && pair.gap < layer) put_back(pair);
      }
    LargeArray<ContactPair> on_planes;
    add_plane_pairs(features, work, planes, {layer, 0, travel, layer}, list, on_planes);
    for (ContactPair& pair : on_planes) {
      work.x[pair.node[1]] = work.x[pair.node[0]] - pair.gap * pair.normal;
      if (pair.gap < layer) put_back(pair);
    }
    double farthest = 0;
    for (int i = 0; i < work.body_entries; ++i) farthest = std::max(farthest, (work.x[i] - x[work.vertex[i]]).norm());
    way = std::max(way, both * farthest + tool_way);
  }
  moved_by(way);
  end(dt, move, x, v, v_star);
  if (!near.pairs.empty())
    for (int i = 0; i < work.body_entries; ++i) x[work.vertex[i]] = work.x[i];

  step.dt = dt;
  Books books = open_books();
  for (const ContactPair& pair : near.pairs) {
    books.add(pair);
    step.min_gap_over_layer = std::min(step.min_gap_over_layer, dot3(pair.normal, relative(pair, work.x)) / layer);
  }
  step.dissipated = -books.normal_work();
}

}  // namespace forming_sim
