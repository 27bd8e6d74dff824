#pragma once
// Room on the disk, made sure of before a file that must stay readable is touched.
#include <cstdint>
#include <string>

namespace forming_sim {

/// Allots room for `bytes` beyond the end of an existing file, so that writing them
/// cannot fail half way. The file may be cut back to what is in it afterwards.
/// Does nothing where the file system cannot allot. Throws Error(output_error).
void allot(const std::string& path, std::uint64_t bytes);

}  // namespace forming_sim
