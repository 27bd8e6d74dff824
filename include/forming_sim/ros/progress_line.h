#pragma once
// How far a run has come, for people: a bar on a terminal, plain lines in a log.
#include <cstdio>
#include <string>

#include "forming_sim/RunStatus.h"

namespace forming_sim {

/// "2 min 5 s"; "?" for a negative time.
std::string duration_text(double seconds);

class ProgressLine {
 public:
  /// out: where to write; a bar where it is a terminal.
  explicit ProgressLine(std::FILE* out);
  /// Redraws the bar; in a log, a line for each new stage and each tenth of the run.
  void show(const RunStatus& status);
  /// Ends the bar, so that other text can follow.
  void end();

 private:
  std::FILE* out_;
  bool terminal_, open_ = false;
  std::string stage_;
  int tenth_ = -1;
};

}  // namespace forming_sim
