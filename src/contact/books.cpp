#include "forming_sim/contact/books.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"

namespace forming_sim {

template <class AnyLink> Node Books::book(const AnyLink& link, int tool, const Node& impulse) {
  for (int k = 0; k < link.nodes; ++k) {
    const int n = link.node[k];
    const Node& v = work_.mean[n];
    if (n >= work_.body_entries) {
      const Node on_tool = on_node(link, k, impulse);
      step_.tool_work -= dot3(on_tool, v);
      step_.tool_impulse[tool] += vec3(on_tool);
      step_.tool_angular_impulse[tool] += vec3(work_.x[n]).cross(vec3(on_tool));
    } else if (const Mat3* projector = work_.projector[n]) {
      const Node j = on_node(link, k, impulse);
      step_.held_work += dot3(j - project(*projector, j), v);
    }
  }
  return relative(link, work_.mean);
}

void Books::add(const TiePair& tie) { normal_ += dot3(tie.impulse, book(tie, tie.tool, tie.impulse)); }

void Books::add(const ContactStep& more, double normal_work) {
  normal_ += normal_work;
  step_.active += more.active;
  step_.friction_work += more.friction_work;
  step_.tool_work += more.tool_work;
  step_.held_work += more.held_work;
  for (std::size_t t = 0; t < more.tool_impulse.size(); ++t) {
    step_.tool_impulse[t] += more.tool_impulse[t];
    step_.tool_angular_impulse[t] += more.tool_angular_impulse[t];
  }
}

void Books::add(const ContactPair& pair) {
  if (pair.impulse == 0) return;
  ++step_.active;
  const Node along = pair.impulse * pair.normal;
  if (pair.rub < 0) {
    normal_ += dot3(along, book(pair, pair.tool(bodies_), along));
    return;
  }
  const Node& slip = rubs_[pair.rub].slip;
  const Node mean = book(pair, pair.tool(bodies_), along + slip);
  normal_ += dot3(along, mean);
  step_.friction_work -= dot3(slip, mean);
}

}  // namespace forming_sim
