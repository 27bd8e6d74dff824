#include "forming_sim/contact/driven.h"

#include <cmath>

#include "contact/impl.h"

namespace forming_sim {

namespace {
/// Sum over those nodes of a link that are the tool's of weight times d(x).
Node on_tool(const Link& link, const Workspace& work, const ToolFreedom& freedom) {
  Node sum = Node::Zero();
  for (int k = 0; k < link.nodes; ++k)
    if (link.node[k] >= work.body_entries) sum += link.weight[k] * node(freedom.along(vec3(work.x[link.node[k]])));
  return sum;
}
}  // namespace

void Contact::Impl::find_driven_tools() {
  size_t count = 0;
  for (size_t t = 0; t < motion.size(); ++t) {
    if (!motion[t].present) continue;
    for (int k = 0; k < ToolMotion::kFreedoms; ++k) {
      const ToolFreedom& freedom = motion[t].freedom[k];
      if (freedom.inverse_mass == 0) continue;
      if (driven.size() == count) driven.emplace_back();
      DrivenTool& tool = driven[count++];
      tool.push = 0;
      tool.tool = static_cast<int>(t);
      tool.freedom = k;
      tool.inverse_mass = freedom.inverse_mass;
      tool.speed = freedom.speed;
      tool.last_speed = freedom.last_speed;
      tool.reach = freedom.guide.norm();
      if (freedom.axle.isZero(0)) continue;
      const Box& box = tool_index->of(tool.tool).box();
      for (int corner = 0; corner < 8; ++corner) tool.reach = std::max(tool.reach, freedom.along(pose0(motion[t], box.corner(corner))).norm());
    }
  }
  driven.resize(count);
}

void Contact::Impl::gather_driven(DrivenTool& tool) const {
  const ToolFreedom& freedom = motion[tool.tool].freedom[tool.freedom];
  tool.push = 0;
  tool.entries.clear();
  tool.pairs.clear();
  tool.ties.clear();
  const auto add = [&](int entry) { tool.entries.push_back({entry, node(freedom.along(vec3(work.x[entry])))}); };
  for (size_t i = work.body_entries; i < work.vertex.size(); ++i)
    if (work.vertex[i] >= 0 && features.vertex_surface[work.vertex[i]] - features.bodies == tool.tool) add(static_cast<int>(i));
  for (const NearList::PlanePair& plane : list.planes)
    if (plane.tool == tool.tool) add(plane.foot);
  for (size_t i = 0; i < tie_pairs.size(); ++i) {
    const TiePair& tie = tie_pairs[i];
    if (tie.tool != tool.tool) continue;
    if (tie.to_tool) add(tie.node[1]);
    const Node on = on_tool(tie, work, freedom);
    const Node answer = node(tie.mass * vec3(on));
    tool.ties.push_back({static_cast<long>(i), on, answer, 0, dot3(on, answer), false});
  }
  for (size_t i = 0; i < near.pairs.size(); ++i) {
    const ContactPair& pair = near.pairs[i];
    if (pair.tool(features.bodies) != tool.tool || pair.w == 0) continue;
    const Node on = on_tool(pair, work, freedom);
    const double along = dot3(pair.normal, on);
    const Node answer = (pair.rub < 0 ? along * pair.normal : on) / pair.w;
    tool.pairs.push_back({static_cast<long>(i), on, answer, along, dot3(on, answer), pair.rub >= 0});
  }
}

void DrivenTool::see_each_other(DrivenTool& a, DrivenTool& b) {
  const auto see = [](std::vector<DrivenLink>& first, std::vector<DrivenLink>& second) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      double &m1 = first[i].mass, &m2 = second[i].mass;
      if (!(m1 > 0 && m2 > 0)) continue;
      const double m12 = std::abs(dot3(first[i].on, second[i].answer)), ratio = std::sqrt(m1 / m2);
      m1 += m12 * ratio;
      m2 += m12 / ratio;
    }
  };
  see(a.pairs, b.pairs);
  see(a.ties, b.ties);
}

double Sweeps::push_driven(double dt, bool begins, Workspace& work, const std::vector<TiePair>& ties, DrivenTool& tool) const {
  double J = 0, m = 0;
  for (const DrivenLink& pair : tool.pairs) {
    const double j = impulse(pair.link);
    if (j == 0) continue;
    J += pair.along * j;
    if (pair.rubs) J += dot3(slip(pair.link), pair.on);
    m += pair.mass;
  }
  for (const DrivenLink& tie : tool.ties) {
    J += dot3(ties[tie.link].impulse, tie.on);
    m += tie.mass;
  }
  if (begins) m = 0;
  // u <- (J + m u)/(M + m)
  const double push = tool.inverse_mass * (J + m * tool.push) / (1 + tool.inverse_mass * m), more = push - tool.push;
  tool.push = push;
  for (const DrivenTool::Entry& e : tool.entries) work.v[e.entry] += more * e.along;
  return tool.way(more, dt);
}

}  // namespace forming_sim
