#pragma once
// Reads result.h5 back, complete or left by a run that was stopped.
#include <string>
#include <vector>

#include "forming_sim/results/frame.h"
#include "forming_sim/files/hdf5_file.h"

namespace forming_sim {

/// All functions throw Error(output_error) with file, dataset and reason.
class ResultReader {
 public:
  explicit ResultReader(const std::string& path);
  const ResultHeader& header() const { return header_; }
  const std::vector<FrameEntry>& frames() const { return frames_; }
  Frame frame(std::size_t index) const;

 private:
  Hdf5File file_;
  ResultHeader header_;
  std::vector<FrameEntry> frames_;
};

/// Reads all texts of the file once in a process of their own: over damaged ones libhdf5 breaks, or does not end.
void require_sound(const std::string& path);
ResultHeader read_header(const Hdf5Group& root);
std::vector<FrameEntry> read_entries(const Hdf5Group& root);

}  // namespace forming_sim
