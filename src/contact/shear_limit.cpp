#include "forming_sim/contact/shear_limit.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/mesh/faces.h"

namespace forming_sim {

ShearLimit::ShearLimit(const Features& f, bool axisymmetric) : axisymmetric_(axisymmetric) {
  const int surfaces = static_cast<int>(f.surfaces.size());
  for (int body = 0; body < f.bodies; ++body)
    for (int other = 0; other < surfaces; ++other) {
      if (!f.relation(body, other).limited()) continue;
      for (int i = f.surfaces[body].first_facet; i < f.surfaces[body].last_facet; ++i) facets_.push_back(i);
      break;
    }
}

void ShearLimit::set(const Features& f, const NodeField& x, double kick, const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) {
  face_.resize(x.size());
  for (int i : facets_)
    for (int k = 0; k < f.corners(); ++k) face_[f.facets[i][k]] = Node::Zero();
  for (int i : facets_) {
    Face face;
    face.corners = f.corners();
    std::copy_n(f.facets[i].begin(), face.corners, face.nodes.begin());
    for (int k = 0; k < face.corners; ++k) face_[face.nodes[k]] += node(f.facet_outward[i] * area_share(face, k, x, axisymmetric_));
  }
  sum_impulses(work, pairs, sum_);
  // Of every pair what the surface with the lower number has, and the other; of every two surfaces the sums.
  const std::size_t surfaces = f.surfaces.size();
  areas_.assign(pairs.size(), {0, 0});
  totals_.assign(surfaces * surfaces, {0, 0});
  const auto total_of = [&](const ContactPair& pair) -> std::array<double, 2>& { return totals_[std::min(pair.own, pair.surface) * surfaces + std::max(pair.own, pair.surface)]; };
  const auto limited = [&](const ContactPair& pair) { return pair.rub >= 0 && f.relation(pair.own, pair.surface).limited(); };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ContactPair& pair = pairs[k];
    if (!limited(pair)) continue;
    work.each_of_bodies(pair, [&](int i, double b) {
      const double share = sum_[i] > 0 ? pair.impulse / sum_[i] : 1;
      areas_[k][(b < 0) != (pair.own > pair.surface)] += std::abs(b) * share * std::abs(dot3(face_[work.vertex[i]], pair.normal));
    });
    for (int side : {0, 1}) total_of(pair)[side] += areas_[k][side];
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ContactPair& pair = pairs[k];
    if (!limited(pair)) continue;
    const bool tool = std::max(pair.own, pair.surface) >= f.bodies;
    const int side = !tool && total_of(pair)[1] < total_of(pair)[0];
    rubs[pair.rub].most = f.relation(pair.own, pair.surface).friction_limit * kick * areas_[k][side];
  }
}

}  // namespace forming_sim
