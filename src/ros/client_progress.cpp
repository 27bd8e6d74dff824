#include "forming_sim/ros/client_progress.h"

#include <unistd.h>

#include <algorithm>

#include "forming_sim/results/progress_line.h"

namespace forming_sim {

ClientProgress::ClientProgress(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0) {}

void ClientProgress::show(const RunStatus& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (ended_) return;
  const double progress = std::clamp(status.progress, 0.0, 1.0);
  const int tenth = static_cast<int>(10 * progress);
  if (!terminal_ && status.stage == stage_ && tenth == tenth_) return;
  stage_ = status.stage;
  tenth_ = tenth;
  const std::string text = progress_text(status.stage, progress, status.eta_s);
  std::fprintf(out_, terminal_ ? "\r\033[K%s  t = %.3f ms" : "%s  t = %.3f ms\n", text.c_str(), 1e3 * status.time_s);
  open_ = terminal_;
  std::fflush(out_);
}

void ClientProgress::say(const char* text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  end_line();
  std::fprintf(out_, "%s\n", text);
  std::fflush(out_);
}

void ClientProgress::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  end_line();
  ended_ = true;
}

void ClientProgress::end_line() {
  if (open_) std::fputc('\n', out_);
  open_ = false;
  std::fflush(out_);
}

}  // namespace forming_sim
