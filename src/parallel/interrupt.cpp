#include "forming_sim/parallel/interrupt.h"

#include "forming_sim/config/fault.h"

namespace forming_sim {

namespace {
thread_local const std::atomic<bool>* told = nullptr;
}  // namespace

Interruptible::Interruptible(const std::atomic<bool>& cancelled) { told = &cancelled; }
Interruptible::~Interruptible() { told = nullptr; }

void check_interrupt() {
  if (told && *told) throw Error(Code::cancelled, "cancelled before the first step");
}

}  // namespace forming_sim
