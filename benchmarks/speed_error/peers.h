#pragma once
// The problems as CalculiX is given them; each tells a Report its runs, or why there are none.
#include "speed_error/calculix.h"
#include "speed_error/flange.h"
#include "support/column.h"

namespace forming_sim::bench {

void bending_by_calculix(Report& report, const ExactBend& exact, const MaterialConfig& material);
void cook_by_calculix(Report& report);
void taylor_by_calculix(Report& report);
void flange_by_calculix(Report& report, const Flanged& reference);

}  // namespace forming_sim::bench
