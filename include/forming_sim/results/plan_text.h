#pragma once
// What a scene compiles into: the work of a step and the arrays that it needs.
#include <string>

#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

/// Cells and their laws with bytes an element, loads, who meets whom,
/// the stages; and what the scene does not ask for, of which nothing is there.
std::string plan_text(const Simulation& simulation);

}  // namespace forming_sim
