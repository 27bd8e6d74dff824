#pragma once
// How far a run on a server has come, for people: a line that is rewritten on a
// terminal, plain lines in a log.
#include <cstdio>
#include <mutex>
#include <string>

#include "forming_sim/RunStatus.h"

namespace forming_sim {

/// Feedback comes in a thread of its own, and may come when the run has ended.
class ClientProgress {
 public:
  explicit ClientProgress(std::FILE* out);
  /// On a terminal rewrites the line; in a log writes one for each new stage and
  /// each tenth of the run. Nothing after the end.
  void show(const RunStatus& status);
  /// Ends the line and writes one of other text.
  void say(const char* text);
  /// Ends the line, so that other text can follow.
  void end();

 private:
  void end_line();

  std::mutex mutex_;  ///< nothing foreign is called under it: actionlib calls show() under a lock of its own
  std::FILE* out_;
  bool terminal_, open_ = false, ended_ = false;
  std::string stage_;
  int tenth_ = -1;
};

}  // namespace forming_sim
