#include "forming_sim/ros/signals.h"

#include <csignal>

namespace forming_sim {
namespace {

volatile std::sig_atomic_t stop_flag = 0;

extern "C" void forming_sim_on_stop(int) { stop_flag = 1; }

}  // namespace

void catch_stop_signals() {
  std::signal(SIGINT, forming_sim_on_stop);
  std::signal(SIGTERM, forming_sim_on_stop);
}

bool stop_requested() { return stop_flag != 0; }

}  // namespace forming_sim
