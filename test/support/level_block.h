#pragma once
// The block of support/incline.h in plane strain before it is tilted, with its elements alone: no contact, no steps.
#include "support/dense_limit.h"
#include "support/incline.h"

namespace forming_sim::incline {

struct LevelBlock {
  BodyModel body;
  NodeField X;
  Elements elements;
  double longest_step;  ///< that is stable, s

  explicit LevelBlock(const Block& block)
      : body(body_of(level_block(block), material_of_block())), X(positions_of(body.mesh)), elements({body}, 2, X, {}, 1), longest_step(dense_limit(elements, X, 2)) {}
};

}  // namespace forming_sim::incline
