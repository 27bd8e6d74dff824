#include "forming_sim/contact/encounters.h"

#include <algorithm>
#include <limits>

namespace forming_sim {
namespace {

// Of a box that is turned with its frame, one that holds it.
Box moved(const Box& box, const ToolMotion& motion) {
  Box all;
  for (int i = 0; i < 8; ++i) all.add(node(pose0(motion, box.corner(i))));
  return all;
}

}  // namespace

Box box_of(const Features& f, int surface, const NodeField& x, const NodeField& place) {
  Box box;
  for (int v : f.surfaces[surface].vertices) box.add(v < f.body_nodes ? x[v] : place[v - f.body_nodes]);
  return box;
}

SurfaceIndex Encounters::index_of_body(int b, const Box& near) const {
  return SurfaceIndex(f_, b, [&](int v) -> const Node& { return x_[v]; }, near, std::max(f_.mean_edge, 2 * radius_));
}

bool Encounters::each(const Surface& surface, const std::function<void(int a, int tool)>& plane, double& clear) const {
  clear = std::numeric_limits<double>::infinity();
  bool any = false;
  // The part of either box in which the other can be met; empty: they cannot meet.
  const auto part_near = [&](const Box& a, const Box& b) {
    Box near;
    if (a.empty() || b.empty()) return near;
    const double distance = a.distance(b);
    clear = std::min(clear, distance);
    if (distance > radius_) return near;
    any = true;
    Box wide_a = a, wide_b = b;
    wide_a.grow(radius_);
    wide_b.grow(radius_);
    near.low = wide_a.low.cwiseMax(wide_b.low);
    near.high = wide_a.high.cwiseMin(wide_b.high);
    return near;
  };
  for (int a = 0; a < f_.bodies; ++a) {
    const Box body = box_of(f_, a, x_, NodeField());
    for (std::size_t t = 0; t < tools_.present.size(); ++t) {
      const int b = f_.bodies + static_cast<int>(t);
      if (!tools_.present[t] || !f_.relation(a, b).meet) continue;
      if (tools_.is_plane[t]) {
        plane(a, static_cast<int>(t));
        any = true;
        continue;
      }
      const SurfaceIndex& index = tools_.index.of(static_cast<int>(t));
      if (index.box().empty()) continue;
      const ToolMotion* motion = tools_.motion.empty() ? nullptr : &tools_.motion[t];
      const Box near = part_near(body, motion ? moved(index.box(), *motion) : index.box());
      if (!near.empty()) surface(a, {b, &index, motion}, near);
    }
    for (int b = a; b < f_.bodies; ++b) {
      if (!f_.relation(a, b).meet) continue;
      const Box near = part_near(body, b == a ? body : box_of(f_, b, x_, NodeField()));
      if (near.empty()) continue;
      const SurfaceIndex index = index_of_body(b, near);
      surface(a, {b, &index}, near);
    }
  }
  return any;
}

}  // namespace forming_sim
