#pragma once
// Room on the disk, made sure of before a file that must stay readable is touched.
#include <cstdint>
#include <string>

namespace forming_sim {

/// Allots room for `bytes` beyond the end of an existing file, so that writing them
/// cannot fail half way; the file keeps its size. What is not used stays for the next call.
/// Does nothing where the file system cannot allot. Throws Error(output_error).
void allot(const std::string& path, std::uint64_t bytes);
/// Frees what was allotted to the file and is beyond its end.
void give_back(const std::string& path);

}  // namespace forming_sim
