// forming_bench material [LAW.yaml HISTORY.csv]
#include "material.h"

#include <stdexcept>

namespace forming_sim::bench {

std::vector<Row> material(const Request& request) {
  if (request.arguments.empty()) return measured_loop(request);
  if (request.arguments.size() != 2)
    throw std::runtime_error("given LAW.yaml only; right are LAW.yaml and HISTORY.csv, or no arguments for the measured loop of AA6xxx-T4");
  return drive_history(request, request.arguments[0], request.arguments[1]);
}

}  // namespace forming_sim::bench
