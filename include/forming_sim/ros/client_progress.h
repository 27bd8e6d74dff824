#pragma once
// How far a run on a server has come, for people: a line that is rewritten on a
// terminal, plain lines in a log.
#include <cstdio>
#include <string>

#include "forming_sim/RunStatus.h"

namespace forming_sim {

class ClientProgress {
 public:
  explicit ClientProgress(std::FILE* out);
  /// On a terminal rewrites the line; in a log writes one for each new stage and
  /// each tenth of the run.
  void show(const RunStatus& status);
  /// Ends the line, so that other text can follow.
  void end();

 private:
  std::FILE* out_;
  bool terminal_, open_ = false;
  std::string stage_;
  int tenth_ = -1;
};

}  // namespace forming_sim
