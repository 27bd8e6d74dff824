#pragma once
// The forming limit of a sheet: at which larger principal strain of its middle it begins to neck, by the smaller one beside it. Both are true strains, as a
// limit curve of ISO 12004 has them; straight lines between the points of the curve, level beyond its ends. Flow does not feel it, and nothing parts.
#include "forming_sim/material/config.h"

namespace forming_sim {

/// The larger strain at which the sheet necks beside this smaller one.
double limit_strain(const FormingLimitConfig& curve, double minor);
/// major / limit_strain(minor): 1 on the curve; below 0 where the sheet is compressed in all its directions.
double limit_ratio(const FormingLimitConfig& curve, double major, double minor);

}  // namespace forming_sim
