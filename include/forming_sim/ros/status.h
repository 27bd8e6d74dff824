#pragma once
// What a run has to say of itself, as messages.
#include <string>

#include "forming_sim/EnergyLedger.h"
#include "forming_sim/RunStatus.h"
#include "forming_sim/ToolState.h"
#include "forming_sim/ros/run_view.h"

namespace forming_sim {

EnergyLedger energy_message(const Energies& energies, double balance_error);
ToolState tool_message(const std::string& name, const ToolStatus& status);

/// Status of a running simulation. `frame` is of the same instant.
/// eta_s: wall time left, s, negative where it is not known; min_thickness the same, m.
RunStatus status_of(const Simulation& simulation, const RunFrame& frame, const std::string& scene, double eta_s,
                    double min_thickness);

/// Wall time that is left, from the progress made since a start.
class EtaClock {
 public:
  void start(double progress, double now_s) { first_progress_ = progress, start_s_ = now_s; }
  /// s; -1 until a thousandth of the run has been done.
  double left(double progress, double now_s) const {
    const double done = progress - first_progress_;
    return done < 1e-3 ? -1 : (now_s - start_s_) * (1 - progress) / done;
  }

 private:
  double first_progress_ = 0, start_s_ = 0;
};

}  // namespace forming_sim
