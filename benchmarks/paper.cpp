// forming_bench paper [FIGURE]: the paper figure by figure.
#include <map>
#include <stdexcept>

#include "paper/figures.h"

namespace forming_sim::bench {

std::vector<Row> paper(const Request& request) {
  using Run = std::vector<Row> (*)(const Request&);
  static const std::vector<std::pair<std::string, Run>> figures{
      {"14", figure_14}, {"15", figure_15}, {"16", figure_16}, {"17", figure_17}, {"18", figure_18}, {"2.4", section_2_4}};
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
