// forming_bench paper [FIGURE]: the paper figure by figure. `long-runs` takes more than
// a minute and is not among "all of them": forming_bench paper long-runs.
#include <map>
#include <stdexcept>

#include "paper/figures.h"

namespace forming_sim::bench {

constexpr const char* kOnRequest = "long-runs";

std::vector<Row> paper(const Request& request) {
  using Run = std::vector<Row> (*)(const Request&);
  static const std::vector<std::pair<std::string, Run>> figures{{"section-2.2", diagonals},
                                                                 {"section-2.4", section_2_4},
                                                                 {"section-3.1", rotation_cost},
                                                                 {"3", figure_3},
                                                                 {"4", figure_4},
                                                                 {"5", figure_5},
                                                                 {"6", figure_6},
                                                                 {"7", figure_7},
                                                                 {"8", figure_8},
                                                                 {"section-3.3", viscosity},
                                                                 {"9", figure_9},
                                                                 {"10", figure_10},
                                                                 {"11", figure_11},
                                                                 {"14", figure_14},
                                                                 {"15", figure_15},
                                                                 {"16", figure_16},
                                                                 {"17", figure_17},
                                                                 {"18", figure_18},
                                                                 {"19", figure_19},
                                                                 {"20", figure_20},
                                                                 {"long-runs", long_runs}};
  std::vector<Row> rows;
  std::string known;
  for (const auto& [name, run] : figures) {
    known += (known.empty() ? "" : ", ") + name;
    if (request.arguments.empty() ? name == kOnRequest : request.arguments[0] != name) continue;
    for (Row& row : run(request)) rows.push_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error("figure " + (request.arguments.empty() ? "" : request.arguments[0]) + " is not one of " + known);
  return rows;
}

}  // namespace forming_sim::bench
