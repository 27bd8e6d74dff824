// Reads a scene and runs it through the installed headers and library.
//   consumer SCENE.yaml DIRECTORY
#include <atomic>
#include <cstdio>
#include <exception>

#include "forming_sim/results/run_scene.h"
#include "forming_sim/scene/yaml.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const std::atomic<bool> cancel{false};
    const forming_sim::Scene scene = forming_sim::read_scene_file(argv[1]);
    const forming_sim::Outcome outcome = forming_sim::run_scene(scene, argv[2], 1, "", cancel);
    std::printf("%s: %s\n", scene.name.c_str(), outcome.message.c_str());
    return outcome.code == forming_sim::Code::success ? 0 : 1;
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
