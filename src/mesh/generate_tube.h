#pragma once
// A tube; used by generate_blank, which has checked the numbers.
#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// Cells and sets of the tube; hex24, hex6 or hex1.
Mesh generate_tube(const BlankConfig& blank, CellKind kind);

}  // namespace forming_sim
