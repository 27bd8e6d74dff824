#pragma once
// A law as a user writes it: the fields of a scene's `material` block in a file of their own.
#include <string>

#include "forming_sim/material/config.h"

namespace forming_sim::bench {

/// Reads and checks it as a scene would be. Throws std::runtime_error with all faults, one a
/// line, each with its line of the file.
MaterialConfig read_law(const std::string& path);

}  // namespace forming_sim::bench
