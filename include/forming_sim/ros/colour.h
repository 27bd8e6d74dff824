#pragma once
// Numbers to colours, the same everywhere.
#include <std_msgs/ColorRGBA.h>

namespace forming_sim {

/// Colour of fraction 0..1 (clamped) on the viridis scale: dark blue to yellow,
/// monotone in lightness. Opaque.
std_msgs::ColorRGBA scale_colour(double fraction);

}  // namespace forming_sim
