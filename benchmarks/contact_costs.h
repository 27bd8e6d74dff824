#pragma once
#include "rows.h"

namespace forming_sim::bench {

/// ns a listed pair, an active pair and sweep; what a tool out of reach costs.
void contact_costs(std::vector<Row>& rows);

}  // namespace forming_sim::bench
