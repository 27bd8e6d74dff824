#include "forming_sim/contact/sweeps.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>

#include "forming_sim/contact/impulse.h"
#include "forming_sim/parallel/stage_clock.h"

namespace forming_sim {

namespace {

constexpr int kBits = 64;              ///< colours of tiles, of pairs in a tile; what finds none of them comes after them, one by one
constexpr long kMostPairsOfATile = 2048, kLeastPairsOfATile = 256;  ///< many enough to fill the packs of some 20 colours, few enough for the cache
constexpr long kTilesAimedAt = 16;     ///< where there are not pairs enough for as many full ones

constexpr int kPlainSweeps = 2;        ///< before any are mixed; pairs that share no node are done after two
constexpr int kSweepsAMixture = 2;     ///< to mix each costs as much again as the sweep, and ends no sooner
constexpr double kTied = 1e-5;         ///< of what ties change in the first sweep: what they leave is taken back a step later, and lags gather energy
constexpr double kLeastTied = 1e-9;    ///< of the tolerance of pairs: where nothing moves, a change of this is none
constexpr double kWorse = 2;           ///< a change that has grown by more is of other pairs than those that are mixed

/// Calls each(n) for the nodes of a pair that can move.
template <class Each> void each_mover(const ContactPair& pair, Each&& each) {
  for (int k = 0; k < pair.nodes; ++k)
    if (pair.movers >> k & 1) each(pair.node[k]);
}

int first_free(std::uint64_t taken) { return ~taken == 0 ? kBits : __builtin_ctzll(~taken); }

PairPack empty_pack() {
  PairPack pack{};
  for (double& layer : pack.layer) layer = 1;
  return pack;
}
RubPack empty_rub() {
  RubPack rub{};
  for (double& w : rub.w) w = 1;
  return rub;
}

}  // namespace

const PairKernels& pair_kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::pair_kernels() : isa == Isa::avx2 ? avx2::pair_kernels() : sse2::pair_kernels();
}

Sweeps::Sweeps(Team& team, const char* kernels) : team_(team), kernels_(pair_kernels_of(choose_isa(kernels))), mixing_(team) {}

// Every tile takes the first colour that none of its nodes has yet.
void Sweeps::cut(std::size_t nodes, const LargeArray<ContactPair>& pairs) {
  const long count = static_cast<long>(pairs.size());
  const long size = tile_size_ = std::clamp((count / kTilesAimedAt + kLanes - 1) / kLanes * kLanes, kLeastPairsOfATile, kMostPairsOfATile);
  tile_count_ = (count + size - 1) / size;
  tiles_of_a_thread_ = std::max(1L, kPairsOfAThread / size);
  if (static_cast<long>(tiles_.size()) < tile_count_) tiles_.resize(tile_count_);
  place_.resize(pairs.size());
  if (tile_count_ == 1) {
    tiles_[0].first = 0;
    tiles_[0].last = count;
    taken_.resize(nodes);
    order_ = {0};
    colour_ends_ = {1};
    return;
  }
  taken_.assign(nodes, 0);
  colour_of_.resize(tile_count_);
  colour_ends_.assign(kBits, 0);  // first how many tiles have each
  for (long t = 0; t < tile_count_; ++t) {
    Tile& tile = tiles_[t];
    tile.first = t * size;
    tile.last = std::min(count, tile.first + size);
    std::uint64_t taken = 0;
    for (long i = tile.first; i < tile.last; ++i) each_mover(pairs[i], [&](int n) { taken |= taken_[n]; });
    const int colour = first_free(taken);
    if (colour == kBits) {  // none is free: one of its own, behind all
      colour_of_[t] = static_cast<int>(colour_ends_.size());
      colour_ends_.push_back(1);
      continue;
    }
    colour_of_[t] = colour;
    ++colour_ends_[colour];
    for (long i = tile.first; i < tile.last; ++i) each_mover(pairs[i], [&](int n) { taken_[n] |= std::uint64_t{1} << colour; });
  }
  long before = 0;  // tiles of the colours before, where those of this one begin
  for (long& tiles : colour_ends_) before += std::exchange(tiles, before);
  order_.resize(tile_count_);
  for (long t = 0; t < tile_count_; ++t) order_[colour_ends_[colour_of_[t]]++] = t;
  colour_ends_.erase(std::unique(colour_ends_.begin(), colour_ends_.end()), colour_ends_.end());  // colours that no tile has end where those before them do
}

template <class Work> void Sweeps::each_tile(Work&& work) {
  long begin = 0;
  for (const long end : colour_ends_) {
    team_.share(end - begin, tiles_of_a_thread_, [&](long first, long last) {
      for (long i = first; i < last; ++i) work(tiles_[order_[begin + i]]);
    });
    begin = end;
  }
}

// Every pair takes the first colour that none of its nodes has in this tile; a colour fills packs of its own, so that
// packs that follow each other mostly do not wait for each other's nodes. Tiles of the same colour do so at the same
// time: none writes to a node of another.
void Sweeps::pack(Tile& tile, const LargeArray<ContactPair>& pairs, const std::vector<Rub>& rubs) {
  for (long i = tile.first; i < tile.last; ++i) each_mover(pairs[i], [&](int n) { taken_[n] = 0; });
  long of_colour[kBits + 1] = {};  // the last: pairs left over
  bool any_rubs = false;
  tile.still.clear();
  for (long i = tile.first; i < tile.last; ++i) {
    const ContactPair& pair = pairs[i];
    if (!(pair.w > 0)) {
      tile.still.push_back(i);
      place_[i] = -static_cast<long>(tile.still.size());
      continue;
    }
    std::uint64_t taken = 0;
    each_mover(pair, [&](int n) { taken |= taken_[n]; });
    const int colour = first_free(taken);
    if (colour < kBits) each_mover(pair, [&](int n) { taken_[n] |= std::uint64_t{1} << colour; });
    any_rubs = any_rubs || pair.rub >= 0;
    place_[i] = colour;
    ++of_colour[colour];
  }
  long next[kBits + 1], packs = 0;
  std::vector<long>& part_empty = tile.part_empty;
  part_empty.clear();
  for (int c = 0; c < kBits; ++c) {
    next[c] = packs * kLanes;
    packs += (of_colour[c] + kLanes - 1) / kLanes;
    if (of_colour[c] % kLanes > 0) part_empty.push_back(packs - 1);
  }
  next[kBits] = packs * kLanes;
  for (long p = 0; p < of_colour[kBits]; ++p) part_empty.push_back(packs++);  // a pack each
  for (long i = tile.first; i < tile.last; ++i) {
    const long colour = place_[i];
    if (colour < 0) continue;
    place_[i] = next[colour];
    next[colour] += colour < kBits ? 1 : kLanes;
  }
  static const PairPack no_pairs = empty_pack();
  static const RubPack no_rubs = empty_rub();
  tile.packs.resize(packs);
  tile.rubs.assign(any_rubs ? packs : 0, no_rubs);
  for (long p : part_empty) tile.packs[p] = no_pairs;
  for (PairPack& p : tile.packs) p.nodes = p.held = 0;
  for (long i = tile.first; i < tile.last; ++i) {
    if (place_[i] < 0) continue;
    const ContactPair& pair = pairs[i];
    PairPack& p = tile.packs[place_[i] / kLanes];
    const int l = static_cast<int>(place_[i] % kLanes);
    for (int k = 0; k < 4; ++k) {
      const bool used = k < pair.nodes;
      p.node[k][l] = used ? pair.node[k] : 0;
      p.weight[k][l] = used ? pair.weight[k] : 0;
    }
    if (pair.held) p.held = 1;
    p.nodes = std::max<int>(p.nodes, pair.nodes);
    for (int j = 0; j < 3; ++j) p.normal[j][l] = pair.normal[j];
    p.gap[l] = pair.gap;
    p.layer[l] = pair.layer;
    p.stiffness[l] = pair.stiffness;
    p.w[l] = pair.w;
    p.impulse[l] = pair.impulse;
    if (pair.rub < 0) continue;
    const Rub& rub = rubs[pair.rub];
    RubPack& r = tile.rubs[place_[i] / kLanes];
    const double along = pair.normal.dot(rub.steady);
    for (int j = 0; j < 3; ++j) {
      r.slip[j][l] = rub.slip[j];
      r.steady[j][l] = rub.steady[j] - along * pair.normal[j];
    }
    r.beta[l] = rub.beta;
    r.own[l] = rub.own;
    r.before[l] = rub.before;
    r.friction[l] = rub.friction;
    r.most[l] = rub.most;
    r.w[l] = rub.w;
  }
}

void Sweeps::end_still(double dt, const Workspace& work, const LargeArray<ContactPair>& pairs, Tile& tile) const {
  tile.still_gap.clear();
  for (const long i : tile.still) tile.still_gap.push_back(pairs[i].gap + dt * pairs[i].normal.dot(relative(pairs[i], work.v)));
}

double Sweeps::impulse(long i) const { return place_[i] < 0 ? 0 : tiles_[i / tile_size_].packs[place_[i] / kLanes].impulse[place_[i] % kLanes]; }
Node Sweeps::slip(long i) const {
  if (place_[i] < 0) return Node::Zero();
  const RubPack& r = tiles_[i / tile_size_].rubs[place_[i] / kLanes];
  const long l = place_[i] % kLanes;
  return node(r.slip[0][l], r.slip[1][l], r.slip[2][l]) + radiated(i);
}
Node Sweeps::radiated(long i) const {
  if (place_[i] < 0) return Node::Zero();
  const RubPack& r = tiles_[i / tile_size_].rubs[place_[i] / kLanes];
  const long l = place_[i] % kLanes;
  return node(r.radiated[0][l], r.radiated[1][l], r.radiated[2][l]);
}

void Sweeps::take_back(long first, long last, LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) const {
  for (long i = first; i < last; ++i) {
    ContactPair& pair = pairs[i];
    pair.impulse = impulse(i);
    const Tile& tile = tiles_[i / tile_size_];
    pair.end_gap = place_[i] < 0 ? tile.still_gap[-1 - place_[i]] : tile.packs[place_[i] / kLanes].end_gap[place_[i] % kLanes];
    if (pair.rub < 0) continue;
    rubs[pair.rub].slip = slip(i);
    rubs[pair.rub].radiated = radiated(i);
  }
}

int Sweeps::numbers_of(long i, const ContactPair& pair, double* (&at)[kNumbers]) {
  Tile& tile = tiles_[i / tile_size_];
  const long pack = place_[i] / kLanes, lane = place_[i] % kLanes;
  at[0] = &tile.packs[pack].impulse[lane];
  if (pair.rub < 0) return 1;
  for (int k = 0; k < 3; ++k) {
    at[1 + k] = &tile.rubs[pack].slip[k][lane];
    at[4 + k] = &tile.rubs[pack].radiated[k][lane];
  }
  return kNumbers;
}

void Sweeps::read_state(const LargeArray<ContactPair>& pairs, const std::vector<TiePair>& ties, const std::vector<DrivenTool>& driven) {
  state_.resize(weight_.size());
  each_tile([&](Tile& tile) {
    long place = tile.place;
    for (const long i : tile.pressed) {
      double* at[kNumbers];
      const int count = numbers_of(i, pairs[i], at);
      for (int k = 0; k < count; ++k) state_[place++] = *at[k];
    }
  });
  auto next = state_.end() - static_cast<long>(3 * ties.size() + driven.size());
  for (const TiePair& tie : ties) next = std::copy_n(tie.impulse.data(), 3, next);
  for (const DrivenTool& tool : driven) *next++ = tool.push;
}

void Sweeps::begin_mixing(const LargeArray<ContactPair>& pairs, const std::vector<TiePair>& ties, const std::vector<DrivenTool>& driven) {
  weight_.clear();
  for (long t = 0; t < tile_count_; ++t) {
    Tile& tile = tiles_[t];
    tile.place = static_cast<long>(weight_.size());
    tile.pressed.clear();
    for (long i = tile.first; i < tile.last; ++i) {
      if (!(impulse(i) > 0)) continue;
      tile.pressed.push_back(i);
      weight_.push_back(std::sqrt(pairs[i].w));
      if (pairs[i].rub >= 0) weight_.insert(weight_.end(), kNumbers - 1, std::sqrt(tile.rubs[place_[i] / kLanes].w[place_[i] % kLanes]));
    }
  }
  for (const TiePair& tie : ties) {
    const double mass = tie.mass.trace() / 3;
    weight_.insert(weight_.end(), 3, mass > 0 ? 1 / std::sqrt(mass) : 0);
  }
  for (const DrivenTool& tool : driven) weight_.push_back(1 / std::sqrt(tool.inverse_mass));
  read_state(pairs, ties, driven);
  mixing_.begin(state_, weight_);
}

void Sweeps::mix(Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<TiePair>& ties, std::vector<DrivenTool>& driven) {
  mixed_ = state_;
  mixing_.mix(mixed_);
  each_tile([&](Tile& tile) {
    long place = tile.place;
    for (const long i : tile.pressed) {
      double* at[kNumbers];
      const int count = numbers_of(i, pairs[i], at);
      double more[kNumbers] = {};
      for (int k = 0; k < count; ++k, ++place) {
        more[k] = mixed_[place] - state_[place];
        *at[k] = mixed_[place];
      }
      push(pairs[i], more[0] * pairs[i].normal + node(more[1] + more[4], more[2] + more[5], more[3] + more[6]), work, work.v);
    }
  });
  long place = static_cast<long>(mixed_.size() - 3 * ties.size() - driven.size());
  for (TiePair& tie : ties) {
    const Node more(mixed_[place] - state_[place], mixed_[place + 1] - state_[place + 1], mixed_[place + 2] - state_[place + 2], 0);
    tie.impulse += more;
    push(tie, more, work, work.v);
    place += 3;
  }
  for (DrivenTool& tool : driven) {
    const double more = mixed_[place] - state_[place];
    tool.push += more;
    for (const DrivenTool::Entry& e : tool.entries) work.v[e.entry] += more * e.along;
    ++place;
  }
}

SweepResult Sweeps::solve(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, const LargeArray<ContactPair>& pairs,
                          const std::vector<Rub>& rubs, std::vector<DrivenTool>& driven, ContactTimes* times) {
  StageClock clock(times);
  cut(work.share.size(), pairs);
  projector_.resize(work.share.size());
  for (std::size_t i = 0; i < projector_.size(); ++i) projector_[i] = work.projector[i] ? work.projector[i]->data() : nullptr;
  // While the sweeps last, a node's inverse mass stands beside its velocity.
  for (std::size_t i = 0; i < work.v.size(); ++i) work.v[i][3] = work.share[i].inverse_mass;
  const Movers movers{work.v.front().data(), projector_.data()};
  each_tile([&](Tile& tile) {
    pack(tile, pairs, rubs);
    kernels_.start(movers, tile.packs.data(), tile.rub(), static_cast<long>(tile.packs.size()));
  });
  for (DrivenTool& tool : driven) push_driven(dt, true, work, ties, tool);
  SweepResult result;
  double change = 0, before = 0, tied_tolerance = tolerance;
  int begun = 0;  // after so many sweeps
  std::mutex one;
  clock.ends(&ContactTimes::lanes);
  for (;;) {
    if (result.sweeps >= kPlainSweeps && result.sweeps < most - most / 10) {
      if (result.sweeps == kPlainSweeps || change > kWorse * before) {
        begin_mixing(pairs, ties, driven);
        begun = result.sweeps;
      } else {
        read_state(pairs, ties, driven);
        mixing_.see(state_);
        if ((result.sweeps - begun) % kSweepsAMixture == 0) mix(work, pairs, ties, driven);
      }
    }
    before = change;
    change = 0;
    double tied = 0;
    for (TiePair& tie : ties) tied = std::max(tied, sweep_tie(dt, work, tie));
    if (result.sweeps == 0) tied_tolerance = std::min(tolerance, std::max(kTied * tied, kLeastTied * tolerance));
    change = tied * (tolerance / tied_tolerance);
    each_tile([&](Tile& tile) {
      const double most_of_tile = kernels_.sweep(dt, movers, tile.packs.data(), tile.rub(), static_cast<long>(tile.packs.size()));
      const std::lock_guard<std::mutex> lock(one);
      if (!(most_of_tile <= change)) change = most_of_tile;
    });
    for (DrivenTool& tool : driven) {
      const double way = push_driven(dt, false, work, ties, tool);
      if (!(way <= change)) change = way;
    }
    ++result.sweeps;
    result.settled = change < tolerance;
    if (!result.settled && result.sweeps < most) continue;
    std::atomic<bool> open{true};
    each_tile([&](Tile& tile) {
      end_still(dt, work, pairs, tile);
      if (!kernels_.end_gaps(dt, movers, tile.packs.data(), static_cast<long>(tile.packs.size()))) open = false;
    });
    result.open = open;
    if (result.open || result.sweeps >= most) break;
  }
  clock.ends(&ContactTimes::sweeps);
  for (Node& v : work.v) v[3] = 0;
  return result;
}

}  // namespace forming_sim
