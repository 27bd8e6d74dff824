#pragma once
// result.xdmf: tells ParaView and VTK how to read result.h5.
#include <string>
#include <vector>

#include "forming_sim/results/frame.h"

namespace forming_sim {

/// A temporal collection; at each time a spatial collection of the bodies'
/// simplices ("blank") and of every tool with a mesh that is present. Points
/// are XYZ, z = 0 in dimension 2. `stress` is a matrix of six columns in the
/// order xx yy zz xy yz zx, which is VTK's order of a symmetric tensor.
class Xdmf {
 public:
  /// header must outlive it. h5_name: file name of the result relative to the XDMF file.
  Xdmf(const ResultHeader& header, const std::string& h5_name) : header_(header), h5_name_(h5_name) {}
  /// The whole text. frames: those of the last call, unchanged, and what came after them, which alone is written anew.
  std::string text(const std::vector<FrameEntry>& frames);

 private:
  const ResultHeader& header_;
  std::string h5_name_, grids_;
  std::size_t written_ = 0;
};

}  // namespace forming_sim
