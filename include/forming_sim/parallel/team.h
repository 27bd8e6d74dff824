#pragma once
// The threads of a run. They share out a loop in equal parts and wait for each
// other at its end. A thread without work watches for it for a
// millisecond, which spans the gap between two loops of a step, and then sleeps.
// To share a loop costs some microseconds, and what one thread wrote comes to the other slowly:
// the constants that say how much is worth another thread are some 5 to 30 microseconds of work.
// On a machine that does other things as well a thread may not be there when its
// part is due: then another takes it, and the loop waits for no more than the part
// in which a thread was stopped.
#include <algorithm>
#include <memory>
#include <mutex>
#include <type_traits>

namespace forming_sim {

constexpr int kMostThreads = 1024;
constexpr long kNodesOfAThread = 5000;  ///< fewer are not worth another thread, where another one has not worked on them before (element/node_team.h)

class Team {
 public:
  /// threads: with the calling one, 1 to kMostThreads. Throws SceneError where the system does not start as many.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const;

  /// Calls work(first, last) over [0, count), in as many parts as give each of
  /// them at least `least`, at most four a thread. The parts depend on nothing but
  /// count, least and size(); which thread takes which is open. Work must not throw.
  /// In all of them denormal numbers are zero.
  /// One loop at a time.
  template <class Work> void share(long count, long least, Work&& work) {
    run(count, least, [](void* w, long first, long last) { (*static_cast<std::remove_reference_t<Work>*>(w))(first, last); }, &work);
  }

  /// Likewise; the largest of the numbers that work returns, at least 0.
  template <class Work> double largest(long count, long least, Work&& work) {
    std::mutex one;
    double most = 0;
    share(count, least, [&](long first, long last) {
      const double of_piece = work(first, last);
      const std::lock_guard<std::mutex> lock(one);
      most = std::max(most, of_piece);
    });
    return most;
  }

 private:
  using Call = void (*)(void* work, long first, long last);
  void run(long count, long least, Call call, void* work);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace forming_sim
