#include <set>

#include "forming_sim/simulation/release.h"
#include "rules.h"

namespace forming_sim {

namespace {

template <class Config> std::vector<std::string> names_of(const std::vector<Config>& parts) {
  std::vector<std::string> names;
  for (const Config& part : parts) names.push_back(part.name);
  return names;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The tools that leave in a stage, and whether they are there to leave.
void check_withdrawal(const StageConfig& stage, const std::string& path, const std::vector<std::string>& tools, std::set<std::string>& gone, FaultList& faults) {
  if (gone.size() == tools.size()) {
    faults.add(path, "a withdrawal", tools.empty() ? "leave the stage out: the scene has no tools" : "leave the stage out: all tools are gone before it");
    return;
  }
  for (std::size_t k = 0; k < stage.tools.size(); ++k) {
    const std::string& tool = stage.tools[k];
    const std::string here = join_path(path + ".tools", k);
    if (!holds(tools, tool)) faults.add(here, given_text(tool), "the tools are " + one_of(tools, ", ") + did_you_mean(tool, tools));
    else if (!gone.insert(tool).second) faults.add(here, given_text(tool), "leave it out: this tool is withdrawn already");
  }
  if (stage.tools.empty()) gone.insert(tools.begin(), tools.end());
}

void check_stopping(const std::vector<StageConfig>& stages, std::size_t index, const std::string& path, const std::vector<ToolConfig>& tools, const std::set<std::string>& gone, FaultList& faults) {
  const std::string& name = stages[index].until_stopped;
  if (name.empty()) return;
  std::vector<std::string> stopping;
  for (const ToolConfig& tool : tools)
    if (tool.motion && tool.motion->stop_force > 0 && gone.count(tool.name) == 0 && first_stage(tool.motion->since, stages) <= static_cast<int>(index)) stopping.push_back(tool.name);
  if (holds(stopping, name)) return;
  faults.add(path + ".until_stopped", given_text(name),
             stopping.empty() ? "give the tool's motion a stop_force, or leave this out: no tool that is there, and has begun to move, stops" : "the tools that stop are " + one_of(stopping, ", ") + did_you_mean(name, stopping));
}

}  // namespace

bool check_stage_name(const std::string& name, const std::vector<StageConfig>& stages, std::size_t least, const std::string& path, FaultList& faults) {
  std::vector<std::string> possible = names_of(stages);
  possible.erase(possible.begin(), possible.begin() + std::min(least, possible.size()));
  if (name.empty() || holds(possible, name)) return true;
  faults.add(path, given_text(name),
             possible.empty() ? "leave it out: there is no stage after the first" : (least == 0 ? "the stages are " : "the stages after the first are ") + one_of(possible, ", ") + did_you_mean(name, possible));
  return false;
}

int body_of(const ProbeConfig& probe, const Scene& scene) {
  if (probe.body.empty()) return scene.bodies.empty() ? -1 : 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == probe.body) return static_cast<int>(i);
  }
  return -1;
}

void check_stages(const Scene& scene, FaultList& faults) {
  const std::vector<std::string> tools = names_of(scene.tools);
  const std::vector<StageConfig> stages = named(scene.stages);
  std::set<std::string> gone;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    check_stopping(stages, i, join_path("stages", i), scene.tools, gone, faults);
    if (scene.stages[i].kind == "withdraw") check_withdrawal(scene.stages[i], join_path("stages", i), tools, gone, faults);
  }
}

void check_output(const Scene& scene, FaultList& faults) {
  const OutputConfig& output = scene.output;
  const double duration = longest_time(scene.stages);
  const auto check_rows = [&](double interval, double most, const std::string& field) {
    if (interval > 0 && duration / interval > most) {
      faults.add("output." + field, given_text(interval), "give at least " + number_text(duration / most) + " s: at most " + number_text(most) + " outputs in the " + number_text(duration) + " s of all stages");
    }
  };
  check_rows(output.interval, 1e5, "interval");
  check_rows(output.history_interval, 1e7, "history_interval");
  check_rows(output.checkpoint_interval, 1e5, "checkpoint_interval");

  for (std::size_t i = 0; i < output.probes.size(); ++i) {
    const ProbeConfig& probe = output.probes[i];
    const std::string path = join_path("output.probes", i);
    const int body = body_of(probe, scene);
    if (body < 0) {
      const auto bodies = names_of(scene.bodies);
      faults.add(path + ".body", given_text(probe.body), "the bodies are " + one_of(bodies, ", ") + did_you_mean(probe.body, bodies));
      continue;
    }
    const auto sets = known_sets(scene.bodies[static_cast<std::size_t>(body)]);
    if (!probe.set.empty() && sets && !holds(*sets, probe.set)) {
      add_missing_set(probe.set, scene.bodies[static_cast<std::size_t>(body)].name, *sets, path + ".set", faults);
    }
  }

  if (!output.springback) return;
  const auto probes = names_of(output.probes);
  const auto check_end = [&](const std::string& name, const std::string& field) {
    if (name.empty() || holds(probes, name)) return;
    faults.add("output.springback." + field, given_text(name), probes.empty() ? "declare the probe under output.probes" : "the probes are " + one_of(probes, ", ") + did_you_mean(name, probes));
  };
  const auto check_line = [&](const std::string& from, const std::string& to, const std::string& before) {
    check_end(from, before + "from");
    check_end(to, before + "to");
    if (!from.empty() && from == to) faults.add("output.springback." + before + "to", given_text(to), "give another probe than " + before + "from: a line needs two points");
  };
  const SpringbackConfig& springback = *output.springback;
  check_line(springback.from, springback.to, "");
  check_line(springback.reference_from, springback.reference_to, "reference_");
  if (springback.reference_from.empty() != springback.reference_to.empty())
    faults.add(springback.reference_from.empty() ? "output.springback.reference_from" : "output.springback.reference_to", "nothing", "give both reference_from and reference_to, or neither: a line needs two points");
}

}  // namespace forming_sim
