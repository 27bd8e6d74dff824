// result.xdmf and surface.xdmf: VTK's readers show what result.h5 holds, tools that come and go included.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "forming_sim/results/result_file.h"
#include "forming_sim/results/text_file.h"
#include "forming_sim/results/xdmf.h"
#include "results/example_run.h"

namespace forming_sim {
namespace {

void expect_vtk_reads(const ResultHeader& header) {
  const TemporaryDirectory directory;
  {
    ResultFile file(directory.file("result.h5"), header);
    Xdmf bodies(header, "result.h5", Xdmf::Shows::bodies), surface(header, "result.h5", Xdmf::Shows::surface);
    for (int i = 0; i < 6; ++i) {
      Frame frame = example_frame(header, i);
      frame.tools.resize(header.tools.size());
      file.write(frame);
      if (i % 3 != 2) continue;
      replace_file(directory.file("result.xdmf"), bodies.text(file.frames()));
      replace_file(directory.file("surface.xdmf"), surface.text(file.frames()));
    }
    EXPECT_EQ(bodies.text(file.frames()), Xdmf(header, "result.h5", Xdmf::Shows::bodies).text(file.frames()));
  }
  const std::string command =
      "/usr/bin/python3 " FORMING_SIM_SOURCE_DIR "/test/results/read_xdmf.py " + directory.path();
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "77: VTK's XDMF readers are missing, package python3-paraview";
}

TEST(Xdmf, IsReadByVtkInPlaneStrain) { expect_vtk_reads(example_header(3)); }

TEST(Xdmf, IsReadByVtkInThreeDimensions) {
  ResultHeader header = example_header(2);
  header.dimension = 3;
  header.initial_positions = {Node(0, 0, 0, 0), Node(1, 0, 0, 0), Node(0, 1, 0, 0), Node(0, 0, 1, 0), Node(1, 1, 1, 0)};
  header.elements = {{0, 1, 2, 3}, {1, 4, 2, 3}};
  header.element_body = {0, 0};
  header.surface = {{{0, 2, 1}, 0}};
  header.sets.clear();
  header.tools[0].facets = {{0, 1, 2}};
  expect_vtk_reads(header);
}

TEST(Xdmf, IsReadByVtkWithoutTools) {
  ResultHeader header = example_header(2);
  header.tools.clear();
  expect_vtk_reads(header);
}

}  // namespace
}  // namespace forming_sim
