#include "forming_sim/results/start.h"

#include <new>

#include "forming_sim/config/words.h"
#include "forming_sim/results/probe.h"
#include "forming_sim/scene/build.h"
#include "forming_sim/scene/validate.h"
#include "forming_sim/simulation/stage_times.h"

namespace forming_sim {
namespace {

/// Throws SceneError where the run would take more than 1e12 steps.
void check_length(const Simulation& simulation) {
  constexpr double most = 1e12;  // years, for the smallest of scenes
  const double time = longest_time(simulation.plan().stages), dt = simulation.dt();
  if (time <= most * dt) return;
  throw SceneError({{Code::invalid_scene, "stages", number_text(time) + " s, at a first time step of " + number_text(dt) + " s",
                     "give stages of at most 1e12 steps: shorten them, or look for what makes the step so small: time_step.maximum, tiny cells, "
                     "or a modulus or density of other units"}});
}

}  // namespace

std::unique_ptr<Simulation> build_run(const Scene& scene, Model model, int threads) {
  auto simulation = std::make_unique<Simulation>(build_plan(scene), std::move(model), threads);
  check_length(*simulation);
  std::vector<int> asked;
  for (const Probe& probe : place_probes(scene.output.probes, simulation->model()))
    asked.insert(asked.end(), probe.nodes.begin(), probe.nodes.end());
  simulation->keep_reactions(asked);
  return simulation;
}

StartCheck check_start(const Scene& scene, std::vector<Fault> known, int threads) {
  CheckedModel checked = validated_model(scene, std::move(known));
  StartCheck found{std::move(checked.faults), {}, nullptr};
  if (!found.faults.empty()) return found;
  try {
    found.simulation = build_run(scene, std::move(checked.model), threads);
    found.notes = found.simulation->warnings();
  } catch (const SceneError& error) {
    found.faults = error.faults();
  } catch (const Error& error) {
    if (error.code() == Code::cancelled) throw;
    found.faults.push_back({error.code(), "scene", error.what(), "change the scene so that it can start"});
  } catch (const std::bad_alloc&) {
    found.faults.push_back({Code::invalid_scene, "scene", "more than the memory that there is", "give fewer cells, or run it where there is more (--estimate tells how much a scene takes)"});
  } catch (const std::exception& error) {
    found.faults.push_back({Code::internal_error, "scene", error.what(), "please report this as a defect"});
  }
  return found;
}

}  // namespace forming_sim
