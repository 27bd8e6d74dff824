#pragma once
// Gauss-Seidel sweeps over the pairs: each visit replaces a pair's impulse by
// the one that goes with its end-of-step gap, all others held, and its friction
// impulse by the nearest one within the Coulomb cone.
//
// Where two have not been enough, what every second one leaves is mixed with what those before it have left (mixing.h); the
// last tenth of the allowed number is plain again.
//
// The pairs are visited tile by tile: a tile is a run of pairs in the order of their keys,
// which lie near each other, so that their nodes stay in cache. Within a tile pairs have colours: those of
// one colour share no node that can move, and as many as a Pack holds are visited at a time (pair_pack.h). Tiles have
// colours in the same way: the order of those of one colour does not matter either, so that the
// threads share them, and the result is that of one thread.
#include <cstdint>
#include <vector>

#include "forming_sim/contact/contact_times.h"
#include "forming_sim/contact/driven.h"
#include "forming_sim/contact/mixing.h"
#include "forming_sim/contact/pair_pack.h"
#include "forming_sim/contact/ties.h"
#include "forming_sim/parallel/team.h"

namespace forming_sim {

struct SweepResult {
  int sweeps = 0;
  bool settled = true;    ///< nothing changed by more than the tolerance in the last one
  bool open = true;       ///< every pair that can be moved ends with a gap > 0
};

class Sweeps {
 public:
  /// kernels: see choose_isa.
  explicit Sweeps(Team& team, const char* kernels = nullptr);

  /// From the impulses and slips that the pairs come with, sweeps until every pair ends with a gap > 0 and nothing changes
  /// by more than `tolerance`, at most `most` times; in each sweep ties come before pairs, and the tools that forces drive after them. Changes
  /// work.v, the ties' impulses and the tools' pushes; what was found of the pairs is for take_back to fetch. times: for who asks for them.
  SweepResult solve(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, const LargeArray<ContactPair>& pairs,
                    const std::vector<Rub>& rubs, std::vector<DrivenTool>& driven, ContactTimes* times = nullptr);
  /// Sets impulse and end_gap of the pairs first ... last - 1, and slip and radiated of their rubs.
  void take_back(long first, long last, LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) const;

 private:
  struct Tile {
    long first, last;             ///< of the pairs
    std::vector<PairPack> packs;
    std::vector<RubPack> rubs;    ///< one per pack; empty: none of the pairs rubs
    std::vector<long> part_empty; ///< packs with lanes that are not in use
    std::vector<long> still;      ///< pairs that nothing can move: they bear no impulse and are in no pack
    std::vector<double> still_gap;  ///< at the end of the step, m
    std::vector<long> pressed;    ///< pairs that bear an impulse where mixing begins
    long place;                   ///< of their first number in the state that is mixed
    const RubPack* rub() const { return rubs.empty() ? nullptr : rubs.data(); }
    RubPack* rub() { return rubs.empty() ? nullptr : rubs.data(); }
  };
  void cut(std::size_t nodes, const LargeArray<ContactPair>& pairs);
  void pack(Tile& tile, const LargeArray<ContactPair>& pairs, const std::vector<Rub>& rubs);
  void end_still(double dt, const Workspace& work, const LargeArray<ContactPair>& pairs, Tile& tile) const;
  /// driven.cpp: u of a tool as the impulses stand, that of its entries with it; begins: m = 0, so that it is what they give. Returns the change of place, m.
  double push_driven(double dt, bool begins, Workspace& work, const std::vector<TiePair>& ties, DrivenTool& tool) const;
  /// Of mixing.h: the state is what pairs, ties and tools that forces drive bear; the velocities follow it.
  void read_state(const LargeArray<ContactPair>& pairs, const std::vector<TiePair>& ties, const std::vector<DrivenTool>& driven);
  void begin_mixing(const LargeArray<ContactPair>& pairs, const std::vector<TiePair>& ties, const std::vector<DrivenTool>& driven);
  void mix(Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<TiePair>& ties, std::vector<DrivenTool>& driven);
  static constexpr int kNumbers = 7;
  /// Where what pair i bears lies: its impulse, slip, radiated. Returns how many numbers that is.
  int numbers_of(long i, const ContactPair& pair, double* (&at)[kNumbers]);
  /// Of pair i, which rubs or not, as it stands.
  double impulse(long i) const;
  Node slip(long i) const;
  Node radiated(long i) const;
  /// Calls work(tile) for all tiles, colour by colour; tiles of a colour by all threads.
  template <class Work> void each_tile(Work&& work);

  Team& team_;
  const PairKernels& kernels_;
  std::vector<Tile> tiles_;            ///< the first tile_count_ are in use; the others keep their memory
  long tile_count_ = 0, tile_size_ = 0, tiles_of_a_thread_ = 1;
  std::vector<int> colour_of_;         ///< of the tiles
  std::vector<long> order_;            ///< of the tiles, by colour
  std::vector<long> colour_ends_;      ///< places in order_
  std::vector<std::uint64_t> taken_;   ///< per node: colours of its tiles, then of its pairs in a tile; one bit each
  std::vector<long> place_;            ///< per pair: its lane, counted through the packs of its tile; -1 - place in `still`
  std::vector<const double*> projector_;
  Mixing mixing_;
  Mixing::Numbers state_, mixed_, weight_;
};

}  // namespace forming_sim
