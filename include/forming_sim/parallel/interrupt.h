#pragma once
// Preparations that take long, and may be told that nobody waits for them any more.
#include <atomic>

namespace forming_sim {

/// While it lasts, what this thread prepares stops once `cancelled` is true, the next time that it asks: within about a second, but not before a
/// mesh file that is being read, or the contact that is being set up, is done.
class Interruptible {
 public:
  explicit Interruptible(const std::atomic<bool>& cancelled);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  const std::atomic<bool>* outer_;  ///< of this thread before
};

/// Between two parts of a long preparation. Throws Error(cancelled) where this thread is told to stop.
void check_interrupt();

}  // namespace forming_sim
