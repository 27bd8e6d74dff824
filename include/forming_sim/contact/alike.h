#pragma once
// Pairs that are one contact. A corner of a tool over an edge of a body is a pair of both, and where edges of the tool end at that
// corner they meet the edge there too: three pairs of the same nodes, weights, normal and gap. What each of them bears
// is open but for the layer's compliance, and friction that remembers differs between them: the sweeps pass the force on from
// one to the other and back, and the whole contact waits for that. Such pairs act as one, whose layer is as stiff as all of theirs.
#include <vector>

#include "forming_sim/contact/pair.h"
#include "forming_sim/parallel/large_array.h"

namespace forming_sim {

class AlikePairs {
 public:
  /// Of pairs that are alike the one of a vertex, or else the first, gets stiffness, impulse and friction of all; the others bear nothing in
  /// this step and are there. pairs: in the order of their keys, with what they start from.
  void join(const Workspace& work, LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs);

 private:
  /// The first pair of two edges of which one ends at this vertex and the other is this edge.
  struct First {
    int vertex = -1, edge = -1;
    ContactPair* pair = nullptr;
  };
  /// The place of what is known of them, or of what will be.
  First& first_of(int vertex, int edge);
  std::vector<First> table_;  ///< by a hash of both, then the next free place; at most half full
};

}  // namespace forming_sim
