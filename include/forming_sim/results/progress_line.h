#pragma once
// One line in a terminal that follows a run.
#include <chrono>
#include <string>

#include "forming_sim/simulation/observer.h"

namespace forming_sim {

/// "flanging  [#####.....]  48 %  ETA 0:42", rewritten in place at most 5 times
/// a second; without a terminal a line per stage.
class ProgressLine : public Observer {
 public:
  /// is_terminal: whether the stream can be rewritten in place.
  explicit ProgressLine(bool is_terminal) : is_terminal_(is_terminal) {}
  void on_start(const Simulation& simulation) override;
  void on_step(const Simulation& simulation) override;
  void on_stage_end(const Simulation& simulation, int index) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  using Clock = std::chrono::steady_clock;
  void print(const Simulation& simulation);

  bool is_terminal_;
  Clock::time_point start_, last_;
  double first_progress_ = 0;  ///< not 0 after a resume
};

/// A short table when the run has ended: what happened, forces, energies, the ledger, and the warnings of the summary that the run left in `directory`.
class EndTable : public Observer {
 public:
  explicit EndTable(const std::string& directory) : directory_(directory) {}
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  std::string directory_;
};

/// The line's text: fraction 0..1 of the run, seconds left (below 0: not known).
std::string progress_text(const std::string& stage, double fraction, double seconds_left);

}  // namespace forming_sim
