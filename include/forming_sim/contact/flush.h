#pragma once
// Tools that stand side by side so that their faces go on in each other, as the parts of a divided die or an insert in it: the joint between them is no edge.
// What slides over the joint feels one tool, and its force is told of the part that it is on.
// So it is on the side of the faces on which the bodies are at the start, and as long as the tools stand to each other as then; of tools that go as they are
// pushed (freedom), of planes, and of two that do not meet the same bodies it is never so.
#include <optional>
#include <utility>
#include <vector>

#include "forming_sim/contact/features.h"

namespace forming_sim {

class Flush {
 public:
  Flush() = default;
  /// Before the tools are set back. layer: h0, to within a tenth of which faces have to meet; sides: as Sides::of_facet; x: of the bodies' nodes, m.
  Flush(double layer, const Features& features, const std::vector<int>& sides, const NodeField& x, const std::vector<ToolMotion>& at_start);
  bool any() const { return !edges_.empty() || !vertices_.empty(); }
  /// At this corner of it the facet faces the other tool of a joint: were it set back there, a slit would open.
  bool faces_joint(int facet, int vertex) const;
  /// The tools that hang together so with tool t, itself among them, rising.
  std::vector<int> together(int t) const;
  /// These tools, and all that hang together with them, have no joints any more.
  void part(const std::vector<int>& tools);
  /// Sets what of Features is about joints (Edge::joints, joint_parts, joint_vertex, level), for the step of this motion; true where that is another than before.
  bool mark(const std::vector<ToolMotion>& motion, Features& features);

 private:
  /// Two tools that meet.
  struct Pair {
    int first = 0, second = 0;
    Vec3 apart = Vec3::Zero();                ///< the place of the second in the frame of the first
    Mat3 turned = Mat3::Identity();
    double size = 0;                          ///< of the two, m
    bool stands = false;                      ///< to each other as at the start

    bool has(int tool) const { return tool == first || tool == second; }
    int other(int tool) const { return tool == first ? second : first; }
  };
  /// A tool, its pairs, and the other tool of each.
  struct Beside {
    int tool = 0;
    std::vector<int> pairs, tools;
  };
  /// What comes to a vertex: joints, as places in edges_, and edges.
  struct Around {
    std::vector<std::size_t> joints;
    std::vector<int> edges;
  };
  class Standing;
  /// Of an edge, a part of it; or of a vertex.
  struct Joint {
    int feature = 0;
    std::vector<int> pairs;                   ///< of tools that make it one, all of which have to stand
    Node way = Node::Zero();                  ///< over it, out of its tool, in the tool's frame
    double gap = 0;                           ///< between the two tools there, m
    double first = 0, last = 1;               ///< of an edge, which part
    bool level = false;                       ///< of a vertex: whatever ends there goes straight on in other tools
  };
  static bool reaches(const Features& features, const Joint& joint, int vertex);
  void find_pairs(const Features& features, const std::vector<ToolMotion>& at_start, const Standing& standing);
  void join_section(const Features& features, const Beside& beside, Standing& standing);
  void join_edges(const Features& features, const Beside& beside, Standing& standing);
  void hold_faces(const Features& features, const Beside& beside, int vertex, const Around& there, const Standing& standing);
  std::optional<Joint> joint_all_around(const Features& features, const Beside& beside, int vertex, const Around& there, Standing& standing) const;
  std::optional<Joint> joint_at_corner(const Features& features, const Beside& beside, int vertex, const Around& there, Standing& standing) const;
  bool stand(const Pair& pair, const ToolMotion& first, const ToolMotion& second, bool at_end) const;
  bool is_one(const Joint& joint) const;
  double slack(const Joint& joint) const;

  double layer_ = 0;
  std::vector<Pair> pairs_;
  std::vector<std::pair<int, int>> facing_;   ///< facet and vertex, rising
  std::vector<Joint> edges_, vertices_;       ///< by feature
  bool marked_ = false, turned_ = false;      ///< once; in the step before
};

}  // namespace forming_sim
