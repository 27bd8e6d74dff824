#include "forming_sim/results/estimate.h"

#include <cmath>
#include <cstdio>

#include "forming_sim/simulation/stage_times.h"
#include "forming_sim/simulation/ways.h"

namespace forming_sim {
namespace {

constexpr long kWarmSteps = 5;         ///< first touch of the memory, choice of the kernels
constexpr long kLeastSteps = 30, kMostSteps = 2000;
constexpr double kMeasuredTime = 0.2;  ///< s
constexpr double kBytesOfTriangle = 450;  ///< of a tool: its mesh, features, index and sides; measured, of tools of 8e4 to 2e6 triangles

}  // namespace

Estimate estimate_run(Simulation& simulation) {
  Estimate estimate;
  const double whole = longest_time(simulation.plan().stages);
  double settling = 0;  // s
  for (const StageConfig& stage : simulation.plan().stages) {
    if (stage.kind != "settle") continue;
    estimate.settles = true;
    settling += longest_time(stage);
  }
  estimate.nodes = simulation.model().node_count();
  estimate.elements = simulation.model().element_count();
  // The state and its copy in a checkpoint, with what settle stages know of each node, and per element what is kept besides:
  // connectivity, the blocks of the kernels, the fields of a frame.
  const double of_settling = estimate.settles ? static_cast<double>(Ways::kBytesOfNode * estimate.nodes) : 0;
  estimate.memory_bytes = 2.0 * (static_cast<double>(simulation.save().size()) + of_settling) + 400.0 * static_cast<double>(estimate.elements);
  for (const ToolModel& tool : simulation.model().tools) estimate.memory_bytes += kBytesOfTriangle * static_cast<double>(tool.mesh.surface.size());

  bool more = true;
  const auto step = [&] {
    try {
      more = simulation.step();
    } catch (const Error& error) {
      more = false;
      estimate.broken = error.what();
    }
  };
  for (long i = 0; i < kWarmSteps && more; ++i) step();
  const double time = simulation.time(), wall = simulation.wall_time();
  const long first = simulation.steps();
  const auto enough = [&] {
    const long steps = simulation.steps() - first;
    return steps >= kMostSteps || (steps >= kLeastSteps && simulation.wall_time() - wall >= kMeasuredTime);
  };
  while (more && !enough()) step();

  const auto share_out = [&] { estimate.settling_steps = std::lround(settling / whole * static_cast<double>(estimate.steps)); };
  const long measured = simulation.steps() - first;
  if (measured == 0) {  // the whole run is shorter than the warm-up, or broke in it
    const double taken = static_cast<double>(first);
    estimate.time_step_s = first > 0 ? time / taken : simulation.dt();
    estimate.steps = estimate.broken.empty() ? first : static_cast<long>(std::ceil(whole / estimate.time_step_s));
    estimate.wall_time_s = first > 0 ? wall / taken * static_cast<double>(estimate.steps) : 0;
    share_out();
    return estimate;
  }
  estimate.time_step_s = (simulation.time() - time) / static_cast<double>(measured);
  estimate.steps = static_cast<long>(std::ceil(whole / estimate.time_step_s));
  estimate.wall_time_s = (simulation.wall_time() - wall) / static_cast<double>(measured) * static_cast<double>(estimate.steps);
  share_out();
  return estimate;
}

std::string estimate_text(const Estimate& estimate) {
  const double part = estimate.steps > 0 ? static_cast<double>(estimate.settling_steps) / static_cast<double>(estimate.steps) : 0;
  char text[768], settling[128] = "";
  if (estimate.settles) std::snprintf(settling, sizeof settling, ", of these at most %ld to settle", estimate.settling_steps);
  char seconds[128] = "";
  if (estimate.settles) std::snprintf(seconds, sizeof seconds, "%.3g s before it settles, with that at most ", (1 - part) * estimate.wall_time_s);
  std::snprintf(text, sizeof text,
                "nodes        %ld\nelements     %ld\ntime step    %.3g s in the first steps; it falls where cells are squeezed\nsteps        about %ld%s\n"
                "wall time    about %s%.3g s on this machine (of the solver, without contact that comes later, which can take several times as much)\n"
                "memory       about %.3g MB for the solver's data\n",
                estimate.nodes, estimate.elements, estimate.time_step_s, estimate.steps, settling, seconds, estimate.wall_time_s, estimate.memory_bytes / 1e6);
  return estimate.broken.empty() ? text : text + ("note: the run breaks in its first steps: " + estimate.broken + "\n");
}

}  // namespace forming_sim
