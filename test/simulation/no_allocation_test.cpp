// A step asks for no memory: what it needs it has from the steps before. Memory is asked for where lists of pairs are built anew, where
// the bound of the step is found, and where more is in contact than ever before. It counts by a malloc of its own, over that of glibc.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "forming_sim/scene/build.h"
#include "forming_sim/scene/yaml.h"
#include "forming_sim/simulation/simulation.h"

extern "C" void* __libc_malloc(std::size_t);
extern "C" void* __libc_memalign(std::size_t, std::size_t);

namespace {
std::atomic<long> asked{0};
}
// Those of the whole program, operator new of all libraries included.
extern "C" void* malloc(std::size_t bytes) {
  ++asked;
  return __libc_malloc(bytes);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  ++asked;
  return __libc_memalign(alignment, bytes);
}

namespace forming_sim {
namespace {

struct Case { const char* scene; int threads; };
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << ", " << c.threads << " threads"; }

class OfScenes : public ::testing::TestWithParam<Case> {};

TEST_P(OfScenes, MostStepsAskForNoMemory) {
  const Scene scene = read_scene_file(std::string(FORMING_SIM_SOURCE_DIR "/scenes/") + GetParam().scene + ".yaml");
  Simulation simulation(build_plan(scene), build_model(scene), GetParam().threads);
  constexpr int kFirst = 300, kSteps = 1500;
  for (int k = 0; k < kFirst; ++k) simulation.step();
  int with = 0;
  long all = 0;
  for (int k = 0; k < kSteps; ++k) {
    const long before = asked;
    simulation.step();
    with += asked > before;
    all += asked - before;
  }
  std::printf("  %d of %d steps ask for memory, %ld times in all\n", with, kSteps, all);
  EXPECT_LT(with, kSteps / 10);
}

TEST(Counter, SeesWhatIsAskedFor) {
  const long before = asked;
  std::vector<double> some(1000);
  struct alignas(64) Wide { double value[8]; };
  std::vector<Wide> wide(10);
  EXPECT_GE(asked, before + 2) << some.size() + wide.size();
}

INSTANTIATE_TEST_SUITE_P(Shipped, OfScenes, ::testing::Values(Case{"flange", 1}, Case{"flange", 2}, Case{"cup", 1}, Case{"draw_bend", 1}, Case{"hem_flat", 1}, Case{"strip_draw", 1}, Case{"rolling", 1}, Case{"flange_3d_one_point", 1},
                                                              Case{"two_blocks", 1}, Case{"drop_hammer", 1}));

}  // namespace
}  // namespace forming_sim
