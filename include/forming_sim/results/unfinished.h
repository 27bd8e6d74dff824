#pragma once
// Motions and loads that stages cut off which ended sooner than planned: their times count from the start of the run, or of the stage that their since names.
#include <string>
#include <vector>

#include "forming_sim/results/run_record.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

/// Of a run that came to its end: adds a sentence for every motion of a tool or boundary, pressure and load that would have come to its
/// last knot had all stages lasted as long as they may, and did not.
void tell_unfinished(const Simulation& simulation, const RunRecord& record, std::vector<std::string>& warnings);

}  // namespace forming_sim
