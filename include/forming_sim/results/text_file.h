#pragma once
// Text files that are either the old whole or the new whole, never half of one.
#include <string>

namespace forming_sim {

/// Writes to a temporary name beside `path`, then renames.
/// Throws Error(output_error) with the file and the system's reason.
void replace_file(const std::string& path, const std::string& text);

/// Whole content. Throws Error(output_error) with the file and the reason.
std::string read_text(const std::string& path);

/// Creates a directory (and its parents) and makes sure that files can be
/// written there. Throws Error(output_error) with the directory and the reason.
void make_output_directory(const std::string& directory);

/// directory + "/" + file.
std::string in_directory(const std::string& directory, const std::string& file);

}  // namespace forming_sim
