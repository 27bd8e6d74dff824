#pragma once
// result.xdmf and surface.xdmf: tell ParaView and VTK how to read result.h5.
#include <string>
#include <vector>

#include "forming_sim/results/frame.h"

namespace forming_sim {

/// A temporal collection; at each time a spatial collection of the bodies and of every tool with a mesh that is present. Points
/// are XYZ, z = 0 in dimension 2. `stress` is a matrix of six columns in the
/// order xx yy zz xy yz zx, which is VTK's order of a symmetric tensor. The readers number the names of grids on from frame to
/// frame, so every cell carries the number of its `body`, which stays: 0, 1, ... in their order, of the tools -1, -2, ...
class Xdmf {
 public:
  /// The bodies' simplices, or their surface with what lives on it alone.
  enum class Shows { bodies, surface };
  /// header must outlive it. h5_name: file name of the result relative to the XDMF file.
  Xdmf(const ResultHeader& header, const std::string& h5_name, Shows shows) : header_(header), h5_name_(h5_name), shows_(shows) {}
  /// The whole text. frames: those of the last call, unchanged, and what came after them, which alone is written anew.
  std::string text(const std::vector<FrameEntry>& frames);

 private:
  const ResultHeader& header_;
  std::string h5_name_, grids_;
  Shows shows_;
  std::size_t written_ = 0;
};

}  // namespace forming_sim
