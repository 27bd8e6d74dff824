#pragma once
// The libraries that read meshes may crash, hang or take all memory over a damaged file. They do it in a process of their own.
#include <functional>
#include <string>
#include <vector>

namespace forming_sim {

/// The bytes that `read` makes of the file at `path`, in a child of this process; its time and memory are limited by the
/// size of the file. Throws the Error that `read` throws, and Error(mesh_error) where the child ends in another way.
/// source: as messages name the file.
std::vector<char> read_apart(const std::string& source, const std::string& path, const std::function<std::vector<char>()>& read);

}  // namespace forming_sim
