#pragma once
// The figures of the paper, each a function in a file of its own. A row holds a claim
// of the paper (quantity), what was found and what should be; where a claim does not
// hold, the row's note says why.
#include "figure.h"
#include "rows.h"

namespace forming_sim::bench {

std::vector<Row> figure_3(const Request&);   ///< a cylinder, perfect plasticity, one cycle
std::vector<Row> figure_4(const Request&);   ///< quasi-hardening (3.63)
std::vector<Row> figure_10(const Request&);  ///< two levels
std::vector<Row> figure_11(const Request&);  ///< five levels
std::vector<Row> figure_19(const Request&);  ///< the hem
std::vector<Row> figure_20(const Request&);  ///< folded rubber

}  // namespace forming_sim::bench
