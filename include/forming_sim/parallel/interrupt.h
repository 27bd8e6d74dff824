#pragma once
// Preparations that take long, and may be told that nobody waits for them any more.
#include <atomic>

namespace forming_sim {

/// While it lasts, what this thread prepares stops once `cancelled` is true. One at a time in a thread.
class Interruptible {
 public:
  explicit Interruptible(const std::atomic<bool>& cancelled);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
};

/// Between two parts of a long preparation. Throws Error(cancelled) where this thread is told to stop.
void check_interrupt();

}  // namespace forming_sim
