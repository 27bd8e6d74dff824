#pragma once
// Sweeps whose changes shrink slowly, mixed: of all mixtures of the last states the one of which a sweep would have changed the least
// (Anderson 1965, in the form of Walker and Ni 2011), with plain sweeps between one mixture and the next (Pratapa and others 2016).
//
//   f_k = g(x_k) - x_k,   gamma = argmin |f_k - dF gamma|,   x_k+1 = g(x_k) - dG gamma,
//
// g(x) what a sweep makes of the state x, columns of dF and dG the differences of the last f and g. Pairs that hold nearly the same
// nodes in nearly the same way pass an impulse to and fro in ever the same proportion: some such modes at a time a few columns take away.
// What a mixture breaks (an impulse that pulls, friction outside of its cone) the next sweep mends.
#include "forming_sim/parallel/large_array.h"
#include "forming_sim/parallel/team.h"

namespace forming_sim {

class Mixing {
 public:
  using Numbers = LargeArray<double>;

  explicit Mixing(Team& team) : team_(team) {}

  /// Forgets what was before. x: the state that the next sweep begins with; weight: by which changes of its numbers are measured.
  void begin(const Numbers& x, const Numbers& weight);
  /// state: what a sweep has made of the last one that was seen or mixed.
  void see(const Numbers& state);
  /// The state to go on with.
  void mix(Numbers& state);

 private:
  static constexpr int kColumns = 5;
  struct Sums {
    double of[kColumns] = {};
  };

  /// Calls work(k, first, last) for the numbers of every chunk k.
  template <class Work> void each_chunk(Work&& work);
  /// The products of the columns of dF with one of them or with f.
  Sums products_with(const Numbers& other);

  Team& team_;
  std::vector<Sums> of_chunk_;             ///< room for products_with()
  Numbers weight_, x_, g_, f_;             ///< of the last sweep
  Numbers dF_[kColumns], dG_[kColumns];
  int columns_ = 0, newest_ = -1;          ///< in use; in turns
  bool seen_ = false;                      ///< a sweep
  double products_[kColumns][kColumns];    ///< dF^T dF
};

}  // namespace forming_sim
