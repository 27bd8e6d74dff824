#include "forming_sim/contact/shear_limit.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
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

void ShearLimit::set(const Features& f, const NodeField& x, const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) {
  face_.resize(x.size());
  for (int i : facets_)
    for (int k = 0; k < f.corners(); ++k) face_[f.facets[i][k]] = Node::Zero();
  for (int i : facets_) {
    Face face;
    face.corners = f.corners();
    std::copy_n(f.facets[i].begin(), face.corners, face.nodes.begin());
    for (int k = 0; k < face.corners; ++k) face_[face.nodes[k]] += node(f.facet_outward[i] * area_share(face, k, x, axisymmetric_));
  }
  sum_.assign(work.body_entries, 0.0);
  for (const ContactPair& pair : pairs)
    if (pair.rub >= 0 && pair.impulse > 0) work.each_of_bodies(pair, [&](int i, double b) { sum_[i] += std::abs(b) * pair.impulse; });
  for (const ContactPair& pair : pairs) {
    if (pair.rub < 0) continue;
    const Features::Relation& relation = f.relation(pair.own, pair.surface);
    if (!relation.limited()) continue;
    double area = 0, weights = 0;
    work.each_of_bodies(pair, [&](int i, double signed_b) {
      const double b = std::abs(signed_b), share = sum_[i] > 0 ? pair.impulse / sum_[i] : 1;
      weights += b;
      area += b * share * std::abs(dot3(face_[work.vertex[i]], pair.normal));
    });
    rubs[pair.rub].most = weights > 0 ? relation.friction_limit * work.kick * area / weights : 0;
  }
}

}  // namespace forming_sim
