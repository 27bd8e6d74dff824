#pragma once
// The kernels of all vector widths that this processor has, beside each other.
#include <gtest/gtest.h>

#include <iostream>

#include "support/bodies.h"

namespace forming_sim {

/// forces(name): what elements with the kernels of that name give.
template <class Forces> void expect_widths_agree(Forces&& forces) {
  std::vector<NodeField> results;
  for (const char* name : {"sse2", "avx2", "avx512"}) {
    try {
      results.push_back(forces(name));
    } catch (const Error& error) {
      std::cout << "  " << error.what() << "\n";
    }
  }
  double scale = 0;
  for (const Node& n : results[0]) scale = std::max(scale, n.norm());
  for (const NodeField& f : results)
    for (std::size_t n = 0; n < f.size(); ++n) EXPECT_LT((f[n] - results[0][n]).norm(), 1e-10 * scale);
}

}  // namespace forming_sim
