#pragma once
#include <vector>

#include "rows.h"

namespace forming_sim::bench {

/// Rows of `costs`: bodies of 1 to 10 layers in alternating turns.
void layer_costs(std::vector<Row>& rows);

}  // namespace forming_sim::bench
