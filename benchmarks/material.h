#pragma once
// The two commands of forming_bench material.
#include <string>
#include <vector>

#include "rows.h"

namespace forming_sim::bench {

/// AA6xxx-T4 through tension, compression, tension: layers that grow, pure layers and
/// isotropic hardening beside the measurement.
std::vector<Row> measured_loop(const Request& request);

/// A law at a point through a history of deformation; writes DIR/material.csv.
std::vector<Row> drive_history(const Request& request, const std::string& law, const std::string& history);

}  // namespace forming_sim::bench
