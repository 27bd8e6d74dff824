#pragma once
// From what a user says of a material to the numbers of its law.
#include <vector>

#include "forming_sim/material/config.h"
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// The tables keep the points of a tabulated curve; they must outlive the result.
SolidConstants solid_constants(const MaterialConfig& config, std::vector<double>& strain_table,
                               std::vector<double>& stress_table);

}  // namespace forming_sim
