#pragma once
// From a goal to a scene that can run, or to all that is wrong with it.
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/SceneSpec.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

struct Prepared {
  Scene scene;
  std::vector<Fault> faults;       ///< empty: the scene can run
  std::vector<std::string> notes;  ///< what is taken but looks odd
  std::unique_ptr<Simulation> simulation;  ///< of a scene that can run: its run at the start
};

/// Reads, validates and builds the scene of a message, so that a body that starts
/// inside a tool is found too. Never throws: what goes wrong is among the faults.
/// threads: 1 to kMostThreads, else a fault. scene_text: as its author wrote it; empty: written from the message; with a message without name and bodies it is the scene, beside another it has to say the same, but for urls.
Prepared prepare(const SceneSpec& message, const std::string& scene_text, int threads);

/// The directory of a run, made and found writable: `given`, or where that is
/// empty a new one under `output_root`, named by the scene and the local time.
/// Throws Error(output_error).
std::string make_output_directory(const std::string& given, const std::string& output_root, const std::string& scene);

/// Why no run can have a directory of its own under `output_root`; empty: it can. Makes nothing.
std::string fault_of_root(const std::string& output_root);

/// Path of the checkpoint file that a goal names, empty where it names none; adds a fault where the run that is prepared cannot go on from it.
std::string check_resume(const std::string& given, Prepared& prepared);

/// True for a file that can be opened for reading.
bool is_readable_file(const std::string& path);

/// Threads for a request: `asked`, or where that is 0 `standard`, or where that
/// is 0 too one for each processor.
int choose_threads(int asked, int standard);

}  // namespace forming_sim
