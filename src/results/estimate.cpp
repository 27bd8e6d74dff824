#include "forming_sim/results/estimate.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>

#include "forming_sim/scene/build.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

namespace {

/// Memory of this process that is in use, bytes.
double resident_memory() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double seconds_of(const RunPlan& plan) {
  double seconds = 0;
  for (const StageConfig& stage : plan.stages) seconds += stage.kind == "settle" ? stage.limit : stage.duration;
  return seconds;
}

}  // namespace

RunEstimate estimate_cost(const Scene& scene, int threads) {
  const RunPlan plan = build_plan(scene);
  Simulation simulation(plan, build_model(scene), threads);
  RunEstimate estimate;
  estimate.nodes = simulation.model().node_count();
  estimate.elements = simulation.model().element_count();
  estimate.sim_time_s = seconds_of(plan);
  estimate.time_step_s = simulation.first_dt();

  using Clock = std::chrono::steady_clock;
  constexpr double longest = 1;  // s
  simulation.step();  // lists and caches are set up once
  const auto start = Clock::now();
  double elapsed = 0;
  long steps = 0;
  while (elapsed < longest && steps < 1000 && simulation.step()) {
    ++steps;
    elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  }
  if (estimate.time_step_s <= 0) estimate.time_step_s = simulation.dt();
  estimate.steps = estimate.sim_time_s / estimate.time_step_s;
  if (steps > 0) estimate.wall_time_s = estimate.steps * elapsed / static_cast<double>(steps);
  estimate.memory_bytes = resident_memory();
  return estimate;
}

std::string estimate_text(const RunEstimate& estimate) {
  char text[512];
  std::snprintf(text, sizeof text,
                "nodes            %ld\nelements         %ld\ntime step        %.3g s (in the initial configuration)\n"
                "simulated time   %.3g s (settling by its limit)\nsteps            about %.3g\n"
                "wall time        about %.3g s on this machine (contact not yet at work)\nmemory           %.3g MB\n",
                estimate.nodes, estimate.elements, estimate.time_step_s, estimate.sim_time_s, estimate.steps,
                estimate.wall_time_s, estimate.memory_bytes / 1e6);
  return text;
}

}  // namespace forming_sim
