#pragma once
// Follows a run and keeps what its end cannot tell any more: minima and maxima,
// the formed state before the tools left, the stages.
#include "forming_sim/results/gauge.h"
#include "forming_sim/results/schedule.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

class Recorder : public Observer {
 public:
  /// interval: s between looks. record: of the earlier part of a resumed run, or empty.
  Recorder(const OutputConfig& output, double interval, Gauge& gauge, RunRecord& record)
      : output_(output), schedule_(interval), gauge_(gauge), record_(record) {}
  void on_start(const Simulation& simulation) override;
  void on_step(const Simulation& simulation) override;
  void on_stage_end(const Simulation& simulation, int index) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  void look(const Simulation& simulation);
  void see_formed_angle(const Simulation& simulation);
  void tell_inertia(const Simulation& simulation, const StageConfig& stage);  ///< of the stage that ends
  void tell_sharp_bends(const Simulation& simulation, int stage);             ///< when the last of the form stages ends
  void tell_great_strain(const Simulation& simulation, int stage);
  void tell_short_steps(const Simulation& simulation, int stage);
  void tell_damage(const Simulation& simulation);
  void tell_forming_limit(const Simulation& simulation);
  void tell_thinning(const Simulation& simulation);
  void tell_once(const std::string& told, const std::string& more);
  const OutputConfig output_;
  Schedule schedule_;
  Gauge& gauge_;
  RunRecord& record_;
};

}  // namespace forming_sim
