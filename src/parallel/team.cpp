#include "forming_sim/parallel/team.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace forming_sim {
namespace {

constexpr std::chrono::microseconds kWatch(100);

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Watches for `done` for kWatch; false where it did not come.
template <class Done> bool watch(Done&& done) {
  const auto end = std::chrono::steady_clock::now() + kWatch;
  for (;;) {
    for (int i = 0; i < 64; ++i) {
      if (done()) return true;
      pause();
    }
    if (std::chrono::steady_clock::now() >= end) return false;
  }
}

}  // namespace

struct Team::Impl {
  // The loop under way: written before `loop` counts up, read after.
  Call call = nullptr;
  void* work = nullptr;
  long count = 0;
  int pieces = 0;

  std::atomic<long> loop{0};
  std::atomic<int> left{0};      // pieces of other threads that are not done
  std::atomic<int> asleep{0};
  std::atomic<bool> ends{false};
  std::mutex mutex;
  std::condition_variable wake;
  std::vector<std::thread> others;

  void piece(int k) const { call(work, count * k / pieces, count * (k + 1) / pieces); }

  void serve(int me) {
    long seen = 0;
    for (;;) {
      const auto called = [&] { return loop.load() != seen; };
      if (!watch(called)) {
        std::unique_lock<std::mutex> lock(mutex);
        ++asleep;
        wake.wait(lock, called);
        --asleep;
      }
      ++seen;  // the next loop begins only when this one has been served
      if (ends) return;
      if (me < pieces) piece(me);
      --left;
    }
  }
  void call_others() {
    left = static_cast<int>(others.size());
    ++loop;
    if (asleep == 0) return;
    { const std::lock_guard<std::mutex> lock(mutex); }  // whoever is about to sleep sleeps now
    wake.notify_all();
  }
};

Team::Team(int threads) : impl_(std::make_unique<Impl>()) {
  for (int k = 1; k < threads; ++k) impl_->others.emplace_back([this, k] { impl_->serve(k); });
}

Team::~Team() {
  impl_->ends = true;
  impl_->call_others();
  for (std::thread& other : impl_->others) other.join();
}

int Team::size() const { return static_cast<int>(impl_->others.size()) + 1; }

void Team::run(long count, long least, Call call, void* work) {
  if (count <= 0) return;
  const long pieces = std::clamp(count / std::max(1L, least), 1L, static_cast<long>(size()));
  if (pieces == 1) return call(work, 0, count);
  Impl& m = *impl_;
  m.call = call;
  m.work = work;
  m.count = count;
  m.pieces = static_cast<int>(pieces);
  m.call_others();
  m.piece(0);
  const auto done = [&] { return m.left.load() == 0; };
  while (!watch(done)) std::this_thread::yield();
}

}  // namespace forming_sim
