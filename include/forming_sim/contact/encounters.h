#pragma once
// Which surfaces may come near to one another, and how each is asked for what lies around a point.
#include <functional>
#include <vector>

#include "forming_sim/contact/contact.h"
#include "forming_sim/contact/features.h"
#include "forming_sim/contact/grid.h"
#include "forming_sim/contact/surface_index.h"

namespace forming_sim {

/// A plane in the world as a step begins, and its normal as the step ends.
struct PlanePose {
  Node point = Node::Zero(), normal = Node::Zero(), end_normal = Node::Zero();
};

/// The tools of a search.
struct PlacedTools {
  const ToolIndex& index;
  const std::vector<ToolMotion>& motion;   ///< position0, rotation0 take what the index has to the world; empty: it is of the world
  std::vector<bool> present, is_plane;     ///< per tool
  std::vector<PlanePose> planes;           ///< per tool, used where it is a plane
};

/// A surface as a search asks it: in the frame of its index, which is the tool's own, or the world.
struct Indexed {
  int surface;
  const SurfaceIndex* index;
  const ToolMotion* motion = nullptr;  ///< null: the index is of the world

  Node to_index(const Node& p) const {
    return motion ? node(motion->rotation0.transpose() * (vec3(p) - motion->position0)) : p;
  }
  /// A box around points of the index' frame, with `radius` to spare.
  template <class... Points> static Box around(double radius, const Points&... points) {
    Box box = Box::of(points...);
    box.grow(radius * (1 + 1e-9));  // the way into the frame rounds
    return box;
  }
};

class Encounters {
 public:
  /// x: of the bodies' nodes. Refers to all that is given, which must stay.
  Encounters(const Features& f, const NodeField& x, const PlacedTools& tools, double radius)
      : f_(f), x_(x), tools_(tools), radius_(radius) {}

  /// surface(a, b, near) for every body a and every surface b (a tool; a body after a, or a itself) that may meet within
  /// the radius; near: what lies outside is farther away. plane(a, tool) for every body and plane.
  /// Returns whether there was anything, and sets `clear` to the least distance of all boxes from one another.
  using Surface = std::function<void(int a, const Indexed& b, const Box& near)>;
  bool each(const Surface& surface, const std::function<void(int a, int tool)>& plane, double& clear) const;

  /// Body b, what of it lies in `near`.
  SurfaceIndex index_of_body(int b, const Box& near) const;
  /// Where a vertex of a surface stands in the frame of the surface's index.
  const Node& place(int vertex) const { return vertex < f_.body_nodes ? x_[vertex] : tools_.index.place(vertex); }
  double radius() const { return radius_; }

 private:
  const Features& f_;
  const NodeField& x_;
  const PlacedTools& tools_;
  double radius_;
};

/// Box of the vertices of a surface at their places now; place: of all tool vertices, index vertex - body_nodes.
Box box_of(const Features& features, int surface, const NodeField& x, const NodeField& place);

}  // namespace forming_sim
