#pragma once
// What the HDF5 library says when something fails, as one sentence.
#include <string>

namespace forming_sim {

/// Keeps the library from printing its error stack, and from running at exit,
/// where it would try again to write what could not be written. Files are
/// closed by their owners.
void silence_hdf5();

/// Throws Error(output_error, "cannot <action> <what>: <innermost reason>").
[[noreturn]] void throw_hdf5_error(const std::string& action, const std::string& what);

}  // namespace forming_sim
