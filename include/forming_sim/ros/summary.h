#pragma once
// summary.json as a message.
#include <string>
#include <vector>

#include "forming_sim/RunSummary.h"

namespace forming_sim {

/// Reads DIRECTORY/summary.json; what it does not hold is NaN in the message.
/// Throws Error(output_error) where it cannot be read.
RunSummary read_summary(const std::string& directory);

/// Files of a run that are in the directory, by name.
std::vector<std::string> run_files(const std::string& directory, bool formed);

}  // namespace forming_sim
