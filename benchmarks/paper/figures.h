#pragma once
// The figures of the paper, each a function in a file of its own. A row holds a claim
// of the paper (quantity), what was found and what should be; where a claim does not
// hold, the row's note says why.
#include "figure.h"
#include "rows.h"

namespace forming_sim::bench {

std::vector<Row> figure_3(const Request&);   ///< a cylinder, perfect plasticity, one cycle
std::vector<Row> figure_4(const Request&);   ///< quasi-hardening (3.63)
std::vector<Row> figure_5(const Request&);   ///< shapes of the stretched cell
std::vector<Row> figure_6(const Request&);   ///< its pressure and area
std::vector<Row> figure_7(const Request&);   ///< shapes of the sheared cell
std::vector<Row> figure_8(const Request&);   ///< its shear stress and angle
std::vector<Row> figure_9(const Request&);   ///< the elastic-plastic springs
std::vector<Row> figure_10(const Request&);  ///< two levels
std::vector<Row> figure_11(const Request&);  ///< five levels
std::vector<Row> figure_14(const Request&);  ///< two bodies before their impact
std::vector<Row> figure_15(const Request&);  ///< the impact by algorithm 1
std::vector<Row> figure_16(const Request&);  ///< by algorithm 2, and by the package's own contact
std::vector<Row> figure_17(const Request&);  ///< influence of c
std::vector<Row> figure_18(const Request&);  ///< influence of c and h0 together
std::vector<Row> figure_19(const Request&);  ///< the hem
std::vector<Row> figure_20(const Request&);  ///< folded rubber
std::vector<Row> diagonals(const Request&);  ///< section 2.2
std::vector<Row> rotation_cost(const Request&);  ///< section 3.1
std::vector<Row> viscosity(const Request&);  ///< section 3.3
std::vector<Row> long_runs(const Request&);  ///< a million steps by each method; only where it is asked for
std::vector<Row> section_2_4(const Request&);  ///< contact by geometry: where it works, and where it lets a node through

}  // namespace forming_sim::bench
