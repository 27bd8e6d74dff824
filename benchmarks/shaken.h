#pragma once
// A run on request of the command contact.
#include "rows.h"

namespace forming_sim::bench {

std::vector<Row> shaken();  ///< a sheet between tools that shake, a million steps

}  // namespace forming_sim::bench
