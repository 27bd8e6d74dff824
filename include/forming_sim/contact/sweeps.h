#pragma once
// Gauss-Seidel sweeps over the pairs: each visit replaces a pair's impulse by
// the one that goes with its end-of-step gap, all others held, and its friction
// impulse by the nearest one within the Coulomb cone.
//
// Where the first sweeps show that they will be slow, the later ones are over-relaxed, by
// the factor that is best for the rate at which they shrank; in the second half of the
// allowed number they are plain again, which cannot fail to approach.
//
// The pairs are visited colour by colour. Pairs of a colour share no node that can
// move, so that within a colour the order does not matter: they are visited eight at
// a time (pair_pack.h) and by all threads, and the result is that of one thread.
#include <cstdint>
#include <vector>

#include "forming_sim/contact/pair_pack.h"
#include "forming_sim/contact/ties.h"
#include "forming_sim/parallel/team.h"

namespace forming_sim {

struct SweepResult {
  int sweeps = 0;
  bool open = true;       ///< every pair that can be moved ends with a gap > 0
  double seconds = 0;     ///< that the sweeps took, without what comes before and after them
};

/// Keeps its memory from step to step.
class Sweeps {
 public:
  /// team: the threads; null: one. kernels: see choose_isa.
  explicit Sweeps(Team* team = nullptr, const char* kernels = nullptr);

  /// Pairs in the order of their keys. Sweeps until every pair ends with a gap > 0 and nothing changes by more than
  /// `tolerance`, at most `most` times; in each sweep ties come before pairs. Changes
  /// work.v, the impulses and end_gap of the pairs, the slip of the rubs.
  SweepResult solve(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, std::vector<ContactPair>& pairs,
                    std::vector<Rub>& rubs);

  /// Forces of pairs of the last step, N: all that the next step takes from this one.
  struct Kept {
    PairKey key;
    double force;      ///< along the normal
    double drag[3];    ///< of friction
  };
  const std::vector<Kept>& kept() const { return kept_; }
  void start_from(std::vector<Kept> kept) { kept_ = std::move(kept); }

 private:
  /// Packs of one colour; all of them rub, or none does.
  struct Colour {
    long first, last;
    bool rub;
  };
  void paint(const Workspace& work, const std::vector<ContactPair>& pairs);
  void fill(const Workspace& work, const std::vector<ContactPair>& pairs, const std::vector<Rub>& rubs);
  template <class Work> void share(const Colour& colour, Work&& work) const;
  RubPack* rubs_of(const Colour& colour, long pack);
  double sweep(double dt, double omega, const Movers& movers);
  bool end_gaps(double dt, const Movers& movers);
  void start(double dt, const Movers& movers, const std::vector<ContactPair>& pairs);
  void give_back(double dt, std::vector<ContactPair>& pairs, std::vector<Rub>& rubs);

  Team* team_;
  const PairKernels& kernels_;
  std::vector<std::uint64_t> taken_;   ///< per node: the colours of its pairs, one bit each
  std::vector<int> place_;             ///< per pair: its lane, counted through all packs
  std::vector<Colour> colours_;
  std::vector<PairPack> packs_;
  std::vector<RubPack> rub_packs_;     ///< of the last packs
  long first_rub_ = 0;                 ///< the pack of the first
  std::vector<const double*> projector_;
  std::vector<Kept> kept_;             ///< in the order of their keys
};

}  // namespace forming_sim
