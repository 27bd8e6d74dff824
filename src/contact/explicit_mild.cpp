// Plain explicit mild contact, the paper's algorithm 2: the force (3.71) at the
// gap with which the step begins, like any other nodal force. A baseline: its
// stiffness n c / h^(n+1) has no bound as h -> 0, nodes may get through, and it
// may blow up.
#include <sstream>

#include "contact/impl.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/power_law.h"

namespace forming_sim {
namespace {

// Every listed vertex and the nearest vertex of the other surface, each pair once.
void pair_nearest_nodes(double reach, double travel, NearList& list, const Features& features, const Workspace& work, LargeArray<ContactPair>& pairs) {
  for (NearList::VertexGroup& g : list.groups) {
    if (g.wake > (travel + reach) * (1 + 1e-12)) continue;
    int node = -1, vertex = -1;
    double least = 1e300;
    for (int i = g.first; i < g.last; ++i)
      for (int k = 0; k < features.corners(); ++k) {
        const double squared = (work.x[g.node] - work.x[list.facets[i].node[k]]).squaredNorm();
        if (squared >= least) continue;
        least = squared;
        node = list.facets[i].node[k];
        vertex = features.facets[list.facets[i].facet][k];
      }
    const double distance = std::sqrt(least);
    g.wake = travel + distance;
    if (distance > reach || !(distance > 0)) continue;
    ContactPair pair;
    const bool swap = vertex < g.vertex;
    pair.key = PairKey::make(PairKey::vertex_vertex, std::min(vertex, g.vertex), 0, std::max(vertex, g.vertex));
    pair.own = features.vertex_surface[g.vertex];
    pair.surface = g.surface;
    if (swap) std::swap(pair.own, pair.surface);
    pair.nodes = 2;
    pair.node[0] = swap ? node : g.node;
    pair.node[1] = swap ? g.node : node;
    pair.weight[0] = 1;
    pair.weight[1] = -1;
    pair.gap = distance;
    pair.normal = (work.x[pair.node[0]] - work.x[pair.node[1]]) / distance;
    pairs.push_back(pair);
  }
  put_in_order(pairs);
}

// 2 / (a bound on the greatest frequency of the layer): the largest row sum of
// M^-1 sum k (b n)(b n)^T over the directions in which the nodes are free. One
// pair alone gives 2 / sqrt(k w).
double stable_step(const PowerLaw& law, const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<double>& sum) {
  sum.assign(work.x.size(), 0.0);
  double most = 0;
  for (const ContactPair& pair : pairs) {
    if (pair.impulse == 0) continue;
    double free[4], all = 0;
    for (int k = 0; k < pair.nodes; ++k) {
      const int n = pair.node[k];
      const Share& share = work.share[n];
      free[k] = share.inverse_mass == 0 ? 0 : std::abs(pair.weight[k]) * (work.projector[n] ? project(*work.projector[n], pair.normal).norm() : 1);
      all += free[k];
    }
    for (int k = 0; k < pair.nodes; ++k) {
      const int n = pair.node[k];
      sum[n] += law.stiffness(pair.gap, pair.stiffness) * all * free[k] * work.share[n].inverse_mass;
      most = std::max(most, sum[n]);
    }
  }
  return most > 0 ? 2 / std::sqrt(most) : 0;
}

}  // namespace

void Contact::Impl::advance_explicit(double time, double dt, NodeField& x, NodeField& v, NodeField& v_star, const Predict& predict, const Move& move, const ToolsAt& tools_at) {
  tools_at(dt, motion);
  predict(dt, v_star);
  const double tool_way = step_way(x, dt), predicted = both * fastest(v_star) * dt + tool_way;
  const double reach = layer + predicted;  // also those that come into the layer in this step
  const auto check = [&](double way) {
    if (way <= both * features.mean_edge + tool_way) return;
    std::ostringstream text;
    text << "at time " << time << " s the explicit contact has blown up: nodes move " << way << " m in a step of " << dt
         << " s. It is stable only below the step that its stiffness allows (contact.explicit_stable_dt_s in the summary): set time_step.maximum to a fifth of that, or contact.method to implicit, which needs none";
    throw Error(Code::contact_error, text.str());
  };
  check(predicted);
  near.clear();
  ensure_list(x, reach, 2 * predicted);
  const PowerLaw law{config.exponent, layer};
  const double kick = 0.5 * (previous_dt + dt);
  double way = predicted;
  if (list.size() > 0) {
    tools.place_planes(motion, planes);
    gather(x, v, v_star, dt);
    const Range range{reach, 0, travel, layer};
    // ---- pairs; a plane repels from both its sides, as a surface does
    if (config.pairing == "node_node") {
      add_plane_pairs(features, work, planes, range, list, near.pairs);
      pair_nearest_nodes(reach, travel, list, features, work, near.pairs);
    } else {
      narrow_phase(constants(), nullptr, planes, true, range, team, list, near);
    }
    const auto left_out = [&](ContactPair& pair) {
      if (pair.gap < 0) {
        pair.gap = -pair.gap;
        pair.normal = -pair.normal;
      }
      return pair.key.kind() == PairKey::edge_edge || !(pair.gap > 0) || pair.gap > reach;
    };
    near.pairs.erase(std::remove_if(near.pairs.begin(), near.pairs.end(), left_out), near.pairs.end());
    near.rubs.clear();
    for (ContactPair& pair : near.pairs) constants().set(pair, near.rubs);
    // ---- forces, then friction
    for (ContactPair& pair : near.pairs) {
      pair.layer = layer;
      if (pair.w == 0) continue;
      pair.stiffness = config.coefficient > 0 ? config.coefficient : law.coefficient(pair.stiffness);
      pair.impulse = kick * law.force(pair.gap, pair.stiffness);
      if (pair.impulse > 0) push(pair, pair.impulse * pair.normal, work, work.v);
    }
    if (shear_limit.any()) shear_limit.set(features, x, kick, work, near.pairs, near.rubs);
    for (const ContactPair& pair : near.pairs)
      if (pair.rub >= 0) end_slip(pair, near.rubs[pair.rub], work);
    double most = 0;
    for (int i = 0; i < work.body_entries; ++i) {
      const double squared = dot3(work.v[i], work.v[i]);
      if (!(squared <= most)) most = squared;
    }
    way = std::max(way, both * std::sqrt(most) * dt + tool_way);
    check(way);
  }
  moved_by(way);
  end(dt, move, x, v, v_star);

  step.dt = dt;
  Books books = open_books();
  for (const ContactPair& pair : near.pairs) {
    books.add(pair);
    step.min_gap_over_layer = std::min(step.min_gap_over_layer, pair.gap / layer);
    const double middle = std::abs(pair.gap + 0.5 * dt * dot3(pair.normal, relative(pair, work.v)));
    step.potential += law.potential(std::max(middle, 1e-12 * layer), pair.stiffness);
  }
  step.stable_dt = stable_step(law, work, near.pairs, sum);
}

}  // namespace forming_sim
