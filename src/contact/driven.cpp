#include "forming_sim/contact/driven.h"

#include <cmath>

#include "contact/impl.h"

namespace forming_sim {

namespace {
/// Sum of the weights of those nodes of a link that are a tool's: an impulse of the link is so many on it.
double on_tool(const Link& link, const Workspace& work) {
  double sum = 0;
  for (int k = 0; k < link.nodes; ++k)
    if (link.node[k] >= work.body_entries) sum += link.weight[k];
  return sum;
}
}  // namespace

void Contact::Impl::find_driven_tools(double dt) {
  size_t count = 0;
  for (size_t t = 0; t < motion.size(); ++t) {
    if (motion[t].inverse_mass == 0 || !motion[t].present) continue;
    if (driven.size() == count) driven.emplace_back();
    DrivenTool& tool = driven[count++];
    tool.push = 0;
    tool.tool = static_cast<int>(t);
    tool.guide = node(motion[t].guide);
    tool.inverse_mass = motion[t].inverse_mass;
    tool.speed = (motion[t].position1 - motion[t].position0).dot(motion[t].guide) / dt;
  }
  driven.resize(count);
}

void Contact::Impl::gather_driven(DrivenTool& tool) const {
  tool.push = 0;
  tool.entries.clear();
  tool.pairs.clear();
  tool.ties.clear();
  for (size_t i = work.body_entries; i < work.vertex.size(); ++i)
    if (work.vertex[i] >= 0 && features.vertex_surface[work.vertex[i]] - features.bodies == tool.tool) tool.entries.push_back(static_cast<int>(i));
  for (const NearList::PlanePair& plane : list.planes)
    if (plane.tool == tool.tool) tool.entries.push_back(plane.foot);
  for (size_t i = 0; i < tie_pairs.size(); ++i) {
    if (tie_pairs[i].tool != tool.tool) continue;
    tool.ties.push_back(static_cast<int>(i));
    if (tie_pairs[i].to_tool) tool.entries.push_back(tie_pairs[i].node[1]);
  }
  for (size_t i = 0; i < near.pairs.size(); ++i) {
    const ContactPair& pair = near.pairs[i];
    if (pair.tool(features.bodies) != tool.tool || pair.w == 0) continue;
    const double share = on_tool(pair, work), along = share * dot3(pair.normal, tool.guide);
    tool.pairs.push_back({static_cast<long>(i), share, along, (pair.rub < 0 ? along * along : share * share) / pair.w, pair.rub >= 0});
  }
}

double Sweeps::push_driven(double dt, bool begins, Workspace& work, const std::vector<TiePair>& ties, DrivenTool& tool) const {
  double J = 0, m = 0;
  for (const DrivenPair& pair : tool.pairs) {
    const double j = impulse(pair.pair);
    if (j == 0) continue;
    J += pair.along * j;
    if (pair.rubs) J += pair.share * dot3(slip(pair.pair), tool.guide);
    m += pair.mass;
  }
  for (const int i : tool.ties) {
    const double share = on_tool(ties[i], work);
    J += share * dot3(ties[i].impulse, tool.guide);
    m += share * share * vec3(tool.guide).dot(ties[i].mass * vec3(tool.guide));
  }
  if (begins) m = 0;
  // u <- (J + m u)/(M + m)
  const double push = tool.inverse_mass * (J + m * tool.push) / (1 + tool.inverse_mass * m), more = push - tool.push;
  tool.push = push;
  for (const int i : tool.entries) work.v[i] += more * tool.guide;
  return std::abs(more) * dt;
}

}  // namespace forming_sim
