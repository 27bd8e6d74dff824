#include "forming_sim/results/unfinished.h"

#include <algorithm>
#include <type_traits>

#include "forming_sim/config/words.h"
#include "forming_sim/loads/course.h"
#include "forming_sim/simulation/release.h"
#include "forming_sim/simulation/stage_times.h"

namespace forming_sim {
namespace {

class Unfinished {
 public:
  Unfinished(const Simulation& simulation, const RunRecord& record, std::vector<std::string>& warnings)
      : stages_(simulation.plan().stages), record_(record), end_(simulation.time()), warnings_(warnings) {}

  int count() const { return static_cast<int>(stages_.size()); }
  int leaving_stage(const std::string& tool) const {
    return static_cast<int>(std::find_if(stages_.begin(), stages_.end(), [&](const StageConfig& stage) { return takes_away(stage, tool); }) - stages_.begin());
  }
  /// until: the stage at whose beginning it ends, or their number.
  template <class Config> void tell(const std::string& what, const Config& config, int until) const {
    const bool at_end = until == count();
    const int since = first_stage(config.since, stages_);
    const double last = last_change(config), began = begun(since), ended = (at_end ? end_ : begun(until)) - began,
                 planned = longest_time({stages_.begin() + since, stages_.begin() + until});
    constexpr double kRounding = 1 + 1e-9;
    if (last <= ended * kRounding || last > planned * kRounding) return;
    warnings_.push_back(what + " goes to " + number_text(last) + (since == 0 ? " s, and " : " s from " + three_digits(began) + " s on, and ") + (at_end ? "the run ended at " : "stage " + stages_[until].title() + ", which ends it, began at ") + three_digits(began + ended) + " s: its times count from the start of " +
                        (since == 0 ? "the run, or of a stage that its `since` names" : "stage " + stages_[since].title()) +
                        ", and a settle stage ends when the bodies rest, unless it has `ends: limit`, a stage with until_stopped when its tool has stopped");
  }

 private:
  double begun(int stage) const {
    if (stage == 0) return 0;
    return static_cast<std::size_t>(stage) <= record_.stages.size() ? record_.stages[stage - 1].end_time : end_;
  }

  const std::vector<StageConfig>& stages_;
  const RunRecord& record_;
  double end_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void tell_unfinished(const Simulation& simulation, const RunRecord& record, std::vector<std::string>& warnings) {
  const Unfinished unfinished(simulation, record, warnings);
  const Model& model = simulation.model();
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    const ToolModel& tool = model.tools[k];
    if (!tool.motion || simulation.tools()[k].stopped) continue;
    unfinished.tell("the motion of tool " + tool.name, *tool.motion, unfinished.leaving_stage(tool.name));
  }
  const auto tell = [&](const std::string& what, const auto& config) {
    int until = unfinished.count();
    if constexpr (std::is_same_v<std::decay_t<decltype(config)>, BoundaryConfig>) until = release_stage(config.until, simulation.plan().stages);
    unfinished.tell(what, config, until);
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b) each_named_course(simulation.plan().bodies[b], model.bodies[b].name, tell);
}

}  // namespace forming_sim
