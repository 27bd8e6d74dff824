#pragma once
// Tools that stand side by side so that their faces go on in each other, as the parts of a divided die or an insert in it: the joint between them is no edge,
// and where faces meet back to back there is no surface. What slides over the joint feels one tool, and its force is told of the part that it is on.
// So it is as long as they stand to each other as at the start; of tools that go as they are pushed (freedom) it is never so.
#include <utility>
#include <vector>

#include "forming_sim/contact/features.h"

namespace forming_sim {

class Flush {
 public:
  Flush() = default;
  /// Before the tools are set back. layer: h0, to within a tenth of which faces have to meet; sides: as Sides::of_facet.
  Flush(double layer, const Features& features, const std::vector<int>& sides, const std::vector<ToolMotion>& at_start);
  bool any() const { return !edges_.empty() || !vertices_.empty(); }
  /// The facet lies back to back with one of another tool, all of it or in part.
  bool covers(int facet) const { return !covered_.empty() && covered_[facet]; }
  /// The tools that hang together so with tool t, itself among them, rising.
  std::vector<int> together(int t) const;
  /// Sets what of Features is about joints (Edge::joint, joint_vertex, level), for the step of this motion; true where that is another than before.
  bool mark(const std::vector<ToolMotion>& motion, Features& features);

 private:
  /// Two tools that meet.
  struct Pair {
    int first = 0, second = 0;
    Vec3 apart = Vec3::Zero();                ///< the place of the second in the frame of the first
    Mat3 turned = Mat3::Identity();
    double size = 0;                          ///< of the two, m
    bool stands = false;                      ///< to each other as at the start
  };
  struct Joint {
    int feature = 0;                          ///< edge or vertex
    std::vector<int> pairs;                   ///< of tools that make it one, all of which have to stand
    Node way = Node::Zero();                  ///< over it, out of its tool, in the tool's frame
    double first = 0, last = 1;               ///< of an edge, which part of it
  };
  bool stand(const Pair& pair, const ToolMotion& first, const ToolMotion& second, bool at_end) const;

  double layer_ = 0;
  std::vector<Pair> pairs_;
  std::vector<char> covered_;                 ///< per facet; empty: none
  std::vector<Joint> edges_, vertices_;
};

}  // namespace forming_sim
