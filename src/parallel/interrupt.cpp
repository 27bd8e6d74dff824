#include "forming_sim/parallel/interrupt.h"

#include <utility>

#include "forming_sim/config/fault.h"

namespace forming_sim {

namespace {
thread_local const std::atomic<bool>* told = nullptr;
}  // namespace

Interruptible::Interruptible(const std::atomic<bool>& cancelled) : outer_(std::exchange(told, &cancelled)) {}
Interruptible::~Interruptible() { told = outer_; }

void check_interrupt() {
  if (told && *told) throw Error(Code::cancelled, "cancelled before the first step");
}

}  // namespace forming_sim
