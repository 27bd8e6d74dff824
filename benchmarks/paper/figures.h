#pragma once
// The figures of the paper, each a function in a file of its own. A row holds a claim
// of the paper (quantity), what was found and what should be; where a claim does not
// hold, the row's note says why.
#include "figure.h"
#include "rows.h"

namespace forming_sim::bench {

std::vector<Row> figure_14(const Request&);    ///< two bodies before their impact
std::vector<Row> figure_15(const Request&);    ///< the impact by algorithm 1
std::vector<Row> figure_16(const Request&);    ///< by algorithm 2, and by the package's own contact
std::vector<Row> figure_17(const Request&);    ///< influence of c
std::vector<Row> figure_18(const Request&);    ///< influence of c and h0 together
std::vector<Row> section_2_4(const Request&);  ///< contact by geometry: where it works, and where it lets a node through

}  // namespace forming_sim::bench
