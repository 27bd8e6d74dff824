// forming_bench paper [FIGURE]: the paper figure by figure.
#include <map>
#include <stdexcept>

#include "paper/figures.h"

namespace forming_sim::bench {

std::vector<Row> paper(const Request& request) {
  using Run = std::vector<Row> (*)(const Request&);
  static const std::vector<std::pair<std::string, Run>> figures{{"3", figure_3}, {"4", figure_4}, {"10", figure_10}, {"11", figure_11}, {"19", figure_19}, {"20", figure_20}};
  std::vector<Row> rows;
  std::string known;
  for (const auto& [name, run] : figures) {
    known += (known.empty() ? "" : ", ") + name;
    if (!request.arguments.empty() && request.arguments[0] != name) continue;
    for (Row& row : run(request)) rows.push_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error("figure " + (request.arguments.empty() ? "" : request.arguments[0]) + " is not one of " + known);
  return rows;
}

}  // namespace forming_sim::bench
