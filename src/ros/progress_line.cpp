#include "forming_sim/ros/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace forming_sim {

std::string duration_text(double seconds) {
  if (!(seconds >= 0)) return "?";
  const long s = std::lround(std::ceil(seconds));
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
  return std::to_string(s / 3600) + " h " + std::to_string(s / 60 % 60) + " min";
}

ProgressLine::ProgressLine(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0) {}

void ProgressLine::show(const RunStatus& status) {
  const double progress = std::clamp(status.progress, 0.0, 1.0);
  const std::string eta = duration_text(status.eta_s);
  if (terminal_) {
    constexpr int width = 32;
    const int full = static_cast<int>(std::lround(width * progress));
    const std::string bar = std::string(full, '#') + std::string(width - full, '-');
    std::fprintf(out_, "\r\033[K[%s] %3.0f %%  %s  t = %.3f ms  %s left", bar.c_str(), 100 * progress,
                 status.stage.c_str(), 1e3 * status.time_s, eta.c_str());
    open_ = true;
  } else {
    const int tenth = static_cast<int>(10 * progress);
    if (status.stage == stage_ && tenth == tenth_) return;
    stage_ = status.stage;
    tenth_ = tenth;
    std::fprintf(out_, "%3.0f %%  %s  t = %.3f ms  step %ld  %s left\n", 100 * progress, status.stage.c_str(),
                 1e3 * status.time_s, static_cast<long>(status.step), eta.c_str());
  }
  std::fflush(out_);
}

void ProgressLine::end() {
  if (open_) std::fputc('\n', out_);
  open_ = false;
  std::fflush(out_);
}

}  // namespace forming_sim
