#pragma once
// The figures of the paper, each a function in a file of its own. A row holds a claim
// of the paper (quantity), what was found and what should be; where a claim does not
// hold, the row's note says why.
#include "figure.h"
#include "rows.h"

namespace forming_sim::bench {

}  // namespace forming_sim::bench
