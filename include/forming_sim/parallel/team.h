#pragma once
// The threads of a run. They share out a loop in equal pieces and wait for each
// other at its end. A thread without work watches for it for a tenth of a
// millisecond, which spans the gap between two loops of a step, and then sleeps:
// a machine that does other things as well is neither held up nor does it hold
// up the run for longer than that.
#include <algorithm>
#include <memory>
#include <mutex>
#include <type_traits>

namespace forming_sim {

constexpr long kNodesOfAThread = 1000;  ///< fewer are not worth another thread

class Team {
 public:
  /// threads: with the calling one, at least 1.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const;

  /// Calls work(first, last) over [0, count), in as many pieces as give each of
  /// them at least `least`, at most one a thread. The pieces depend on nothing but
  /// count, least and size(). Work must not throw. One loop at a time.
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
