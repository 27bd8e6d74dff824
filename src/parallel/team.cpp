#include "forming_sim/parallel/team.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/parallel/denormals.h"

namespace forming_sim {
namespace {

constexpr std::chrono::microseconds kWatch(1000);

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

constexpr int kParts = 4;  // of the loop's share of a thread, at most

/// The number of the last loop in which a part was taken; one a cache line.
struct alignas(64) Claim {
  std::atomic<long> taken_in{0};
};

}  // namespace

struct Team::Impl {
  // The loop under way: written before `loop` counts up, read by who has taken a part of it, which keeps the next one away.
  Call call = nullptr;
  void* work = nullptr;
  long count = 0;
  int pieces = 0, parts = 0;     // threads that have a share, and parts of each

  std::atomic<long> loop{0};
  std::atomic<int> left{0};      // parts that are not done
  std::atomic<int> asleep{0};
  std::atomic<bool> ends{false};
  std::mutex mutex;
  std::condition_variable wake;
  std::vector<std::thread> others;
  std::unique_ptr<Claim[]> claims;  // [thread][part]

  int size() const { return static_cast<int>(others.size()) + 1; }

  void try_part(long number, int thread, int part) {
    std::atomic<long>& taken_in = claims[thread * kParts + part].taken_in;
    long before = taken_in.load();
    if (before >= number || !taken_in.compare_exchange_strong(before, number)) return;
    const long all = static_cast<long>(pieces) * parts, at = static_cast<long>(thread) * parts + part;
    call(work, count * at / all, count * (at + 1) / all);
    --left;
  }
  /// The own share first, and then what others have not begun: who stands still holds up no more than the part that he is in.
  void take_parts(long number, int me) {
    for (int part = 0; part < kParts; ++part) try_part(number, me, part);
    for (int k = 1; k < size(); ++k)
      for (int part = kParts - 1; part >= 0; --part) try_part(number, (me + k) % size(), part);
  }
  void serve(int me) {
    const DenormalsAreZero quick;
    long seen = 0;
    for (;;) {
      const auto called = [&] { return loop.load() != seen; };
      if (!watch(called)) {
        std::unique_lock<std::mutex> lock(mutex);
        ++asleep;
        wake.wait(lock, called);
        --asleep;
      }
      seen = loop.load();
      if (ends) return;
      take_parts(seen, me);
    }
  }
  /// The others begin with the parts that the next loop has.
  long call_others() {
    const long number = loop.load() + 1;
    for (int k = 0; k < size() * kParts; ++k)
      if (k / kParts >= pieces || k % kParts >= parts) claims[k].taken_in = number;
    left = pieces * parts;
    loop = number;
    if (asleep == 0) return number;
    { const std::lock_guard<std::mutex> lock(mutex); }  // whoever is about to sleep sleeps now
    wake.notify_all();
    return number;
  }

  void end() {
    ends = true;
    pieces = 0;
    call_others();
    for (std::thread& other : others) other.join();
  }
};

Team::Team(int threads) : impl_(std::make_unique<Impl>()) {
  impl_->claims = std::make_unique<Claim[]>(static_cast<std::size_t>(threads) * kParts);
  impl_->others.reserve(threads);
  try {
    for (int k = 1; k < threads; ++k) impl_->others.emplace_back([this, k] { impl_->serve(k); });
  } catch (const std::system_error& error) {
    const std::size_t started = impl_->others.size() + 1;
    impl_->end();
    throw SceneError({{Code::invalid_scene, "threads", std::to_string(threads), "the system starts no more than " + std::to_string(started) + " (" + error.what() + "): give fewer"}});
  }
}

Team::~Team() { impl_->end(); }

int Team::size() const { return impl_->size(); }

void Team::run(long count, long least, Call call, void* work) {
  if (count <= 0) return;
  const long pieces = std::clamp(count / std::max(1L, least), 1L, static_cast<long>(size()));
  const DenormalsAreZero quick;
  if (pieces == 1) return call(work, 0, count);
  Impl& m = *impl_;
  m.call = call;
  m.work = work;
  m.count = count;
  m.pieces = static_cast<int>(pieces);
  m.parts = static_cast<int>(std::clamp(count / (pieces * std::max(1L, least)), 1L, static_cast<long>(kParts)));
  m.take_parts(m.call_others(), 0);
  const auto done = [&] { return m.left.load() == 0; };
  while (!watch(done)) std::this_thread::yield();
}

}  // namespace forming_sim
