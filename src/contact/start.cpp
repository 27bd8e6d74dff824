// Do the bodies start free of the tools? Small overlaps are mended, deep ones refused.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/crossing.h"
#include "forming_sim/contact/tools.h"

namespace forming_sim {
namespace {

// A vertex near a facet of the other side, with the gap signed by what is inside.
struct StartGap {
  int vertex = -1;
  double gap = 0;              ///< to the tool set back; negative inside
  Node away = Node::Zero();    ///< from the tool to the body
};

class Start {
 public:
  Start(double layer, const std::vector<int>& sides, const ContactSetup& setup, const NodeField& x, const Features& f, const ToolSet& tools)
      : layer_(layer), sides_(sides), setup_(setup), x_(x), f_(f), tools_(tools) {}

  std::vector<StartGap> gaps(int tool, const std::vector<ToolMotion>& motion, const NodeField& place) const {
    std::vector<bool> only(motion.size(), false);
    only[tool] = motion[tool].present;
    Workspace work;
    const std::vector<PlanePose> planes = tools_.planes(motion);
    const double radius = 5 * layer_;
    const NearList list = build_list(f_, x_, place, only, tools_.is_plane, planes, radius, work);
    std::vector<StartGap> found;
    for (const auto& p : list.planes) found.push_back({p.vertex, dot3(x_[p.vertex] - planes[tool].point, planes[tool].normal), planes[tool].normal});
    const auto at = [&](int v) -> const Node& { return v < f_.body_nodes ? x_[v] : place[v - f_.body_nodes]; };
    for (const auto& g : list.groups) {
      const Node& p = at(g.vertex);
      double best = 1e300, slope = -1;
      StartGap gap;
      gap.vertex = g.vertex;
      for (int i = g.first; i < g.last; ++i) {
        const int facet = list.facets[i].facet;
        const auto& c = f_.facets[facet];
        const Node& third = at(c[f_.corners() - 1]);
        const Closest q = f_.dimension == 2 ? closest_on_segment_facet(p, at(c[0]), at(c[1])) : closest_on_triangle(p, at(c[0]), at(c[1]), third);
        if (q.squared > best * (1 + 1e-9)) continue;
        const Node& d = q.apart;
        const int side = f_.rigid(c[0]) ? sides_[facet] : f_.facet_outward[facet];
        const Node n = side * facet_normal(f_.dimension, at(c[0]), at(c[1]), third);
        const double distance = std::sqrt(q.squared), along = dot3(d, n);
        if (q.squared >= best * (1 - 1e-9) && std::abs(along) <= slope) continue;
        slope = std::abs(along);
        best = std::min(best, q.squared);
        gap.gap = along < 0 ? -distance : distance;
        // From the second feature to the vertex, on the outer side; then from tool to body.
        gap.away = distance > 1e-6 * layer_ ? Node(d / gap.gap) : n;
        if (f_.rigid(g.vertex)) gap.away = -gap.away;
      }
      found.push_back(gap);
    }
    return found;
  }

  // A small translation of the tool after which no gap is less than the layer;
  // zero where there is none.
  Node back_off(const std::vector<StartGap>& gaps) const {
    Node t = Node::Zero();
    for (int turn = 0; turn < 200; ++turn) {
      double worst = 0;
      for (const StartGap& g : gaps) {
        const double missing = layer_ - (g.gap - dot3(g.away, t));
        if (missing <= 0) continue;
        t -= missing * g.away;
        worst = std::max(worst, missing);
      }
      if (worst < 1e-3 * layer_) return t;
    }
    return Node::Zero();
  }

  std::string vertex_name(int v, int tool, const Node& at) const {
    std::ostringstream text;
    if (v < f_.body_nodes)
      text << "node " << v << " of body " << setup_.bodies[f_.vertex_surface[v]].name;
    else
      text << "a vertex of tool " << setup_.tools[tool].name;
    text << " at (" << at[0] << ", " << at[1] << ", " << at[2] << ") m";
    return text.str();
  }

 private:
  double layer_;
  const std::vector<int>& sides_;
  const ContactSetup& setup_;
  const NodeField& x_;
  const Features& f_;
  const ToolSet& tools_;
};

}  // namespace

void check_start(double layer, const std::vector<int>& sides, const ContactSetup& setup, const NodeField& x,
                 const std::vector<ToolMotion>& at_start, Features& f, ToolSet& tools, std::vector<std::string>& warnings) {
  const Start start(layer, sides, setup, x, f, tools);
  std::vector<std::string> refused;
  NodeField place;
  tools.place_all(f, at_start, false, place);
  std::vector<bool> told(setup.tools.size(), false);
  for (size_t t = 0; t < setup.tools.size(); ++t) {
    if (!at_start[t].present) continue;
    const int tool = static_cast<int>(t);
    const std::vector<StartGap> gaps = start.gaps(tool, at_start, place);
    bool close = false, touches = false;
    for (const StartGap& g : gaps) {
      if (g.gap < 0.99 * layer) close = true;
      if (g.gap < 1.01 * layer) touches = true;
      if (g.gap >= -1.001 * layer) continue;
      const Node& p = g.vertex < f.body_nodes ? x[g.vertex] : place[g.vertex - f.body_nodes];
      std::ostringstream text;
      text << start.vertex_name(g.vertex, tool, p) << " lies " << layer - g.gap << " m deep in "
           << (g.vertex < f.body_nodes ? "tool " + setup.tools[t].name : "a body");
      refused.push_back(text.str());
      told[t] = true;
    }
    if (touches && !close) {
      std::ostringstream text;
      text << "tool " << setup.tools[t].name << " touches a body at the start: it was backed off by the contact layer, " << layer << " m along its normals";
      warnings.push_back(text.str());
    }
    if (!close || told[t]) continue;
    const Node shift = start.back_off(gaps);
    if (shift.isZero(0) || shift.norm() > 8 * layer) continue;  // no way out: left as it is, the check below decides
    const Vec3 local = at_start[t].rotation0.transpose() * vec3(shift);
    for (int v : f.surfaces[f.bodies + t].vertices) f.place[v - f.body_nodes] += node(local);
    if (tools.is_plane[t]) tools.point[t] += local;
    const Vec3 along = vec3(shift).normalized();
    std::ostringstream text;
    text << "tool " << setup.tools[t].name << " touches or overlaps a body at the start: it was backed off by " << shift.norm() << " m along ("
         << along.x() << ", " << along.y() << ", " << along.z() << ")";
    warnings.push_back(text.str());
  }
  tools.place_all(f, at_start, false, place);
  const auto at = [&](int v) -> const Node& { return v < f.body_nodes ? x[v] : place[v - f.body_nodes]; };
  for (const Crossing& c : find_crossings(f, x, place, ToolSet::present(at_start), tools.is_plane, tools.planes(at_start))) {
    if (told[c.tool]) continue;
    std::ostringstream text;
    text << start.vertex_name(c.edge[0], c.tool, at(c.edge[0]));
    if (c.facet < 0) {
      text << (c.edge[1] < 0 && c.edge[0] < f.body_nodes ? " lies inside tool " + setup.tools[c.tool].name : " lies inside body " + setup.bodies[c.body].name);
    } else {
      const auto& corner = f.facets[c.facet];
      const Node n = facet_normal(f.dimension, at(corner[0]), at(corner[1]), at(corner[f.corners() - 1]));
      const double depth = std::min(std::abs(dot3(at(c.edge[0]) - at(corner[0]), n)), std::abs(dot3(at(c.edge[1]) - at(corner[0]), n)));
      text << " and " << start.vertex_name(c.edge[1], c.tool, at(c.edge[1])) << " are joined by an edge that pierces a facet of "
           << (c.edge[0] < f.body_nodes ? "tool " + setup.tools[c.tool].name : "body " + setup.bodies[c.body].name) << " by "
           << depth + layer << " m";
    }
    refused.push_back(text.str());
  }
  if (refused.empty()) return;
  std::ostringstream text;
  text << refused.size() << " pairs of a tool and a body overlap at the start by more than " << 2 * layer
       << " m: move the tool's position, or the blank, so that they at most touch.";
  for (size_t i = 0; i < std::min<size_t>(refused.size(), 10); ++i) text << "\n  " << refused[i];
  if (refused.size() > 10) text << "\n  ...";
  throw Error(Code::initial_penetration, text.str());
}

}  // namespace forming_sim
