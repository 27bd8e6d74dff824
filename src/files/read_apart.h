#pragma once
// The libraries that read meshes and result files may crash, hang or take all memory over a damaged file. They do it in a process of their own.
#include <functional>
#include <string>
#include <vector>

#include "config/archive.h"

namespace forming_sim {

/// The bytes that `read_bytes` makes of the file at `path`, in a child of this process; its time and memory are limited by the
/// size of the file. Throws the Error that it throws, and Error(mesh_error) where the child ends in another way.
/// source: as messages name the file.
std::vector<char> bytes_read_apart(const std::string& source, const std::string& path, const std::function<std::vector<char>()>& read_bytes);

/// Likewise a Result; exchange(archive, result) writes and reads it.
template <class Result, class Read, class Exchange> Result read_apart(const std::string& source, const std::string& path, Read&& read, Exchange&& exchange) {
  const std::vector<char> bytes = bytes_read_apart(source, path, [&] {
    const Result result = read();
    Writer out;
    exchange(out, result);
    return out.take();
  });
  Reader in(bytes);
  Result result;
  exchange(in, result);
  return result;
}

}  // namespace forming_sim
