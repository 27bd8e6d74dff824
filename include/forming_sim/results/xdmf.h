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
/// h5_name: file name of the result relative to the XDMF file.
std::string xdmf_text(const ResultHeader& header, const std::vector<FrameEntry>& frames, const std::string& h5_name);

}  // namespace forming_sim
