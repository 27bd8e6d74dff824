#pragma once
// Bodies that stick to each other whatever it takes. Vertices of both that stick to faces of the other ask for more than meshes that do not match can do: where two
// lie nearly on each other, by hundreds of times the force, to and fro. So those of one surface do so (Features::Relation::sticks_by), and of the other those alone that
// press where none of the first does: a tip in the middle of a face.
#include <vector>

#include "forming_sim/contact/features.h"
#include "forming_sim/contact/pair.h"

namespace forming_sim {

class Sticking {
 public:
  explicit Sticking(const Features& features);
  bool any() const { return any_; }
  /// Takes the friction from the pairs of vertices of the other surface, and of edges that end there, whose face has a vertex that sticks already; from the others
  /// the part of what the sweeps start from that moves nothing (contact/levers.h).
  void leave_to_one_side(const Features& features, const Workspace& work, double layer, LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs);

 private:
  bool any_ = false;
  std::vector<char> sticks_;  ///< of the entries of the workspace
};

}  // namespace forming_sim
