#pragma once
// What the impulses of a step did: energies, the tools' forces, how many act.
#include "forming_sim/contact/contact.h"
#include "forming_sim/contact/ties.h"

namespace forming_sim {

class Books {
 public:
  /// Fills tool impulses, tool_work, held_work, friction_work and active of the step,
  /// as ContactStep::begin() leaves them.
  Books(const Workspace& work, const std::vector<Rub>& rubs, int bodies, ContactStep& step) : work_(work), rubs_(rubs), bodies_(bodies), step_(step) {}
  void add(const TiePair& tie);
  void add(const ContactPair& pair);
  /// What other books of the same step have, with their normal_work().
  void add(const ContactStep& more, double normal_work);
  /// Of the impulses along the normals, and of ties, on the relative motion, J.
  double normal_work() const { return normal_; }

 private:
  /// Books the impulse of a link; returns the relative velocity, mean of before and after.
  template <class AnyLink> Node book(const AnyLink& link, int tool, const Node& impulse);

  const Workspace& work_;
  const std::vector<Rub>& rubs_;
  int bodies_;
  ContactStep& step_;
  double normal_ = 0;
};

}  // namespace forming_sim
