#include "forming_sim/contact/sweeps.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

namespace forming_sim {

namespace {

/// A node may be in pairs of so many colours; the pairs of a busier one are visited
/// one by one, each a colour of its own.
constexpr int kColours = 64;
/// Colours of pairs without, then with friction; the last of each: pairs left over.
constexpr int kBuckets = 2 * (kColours + 1);
constexpr long kPacksOfAThread = 128;  ///< fewer are not worth another thread

constexpr int kPlainSweeps = 3;        ///< before over-relaxation; pairs that share no node are done after two
constexpr double kMostOmega = 1.9;

/// The factor that is best where sweeps without it shrink the error by `rate` each (Young).
double over_relaxation(double rate) { return std::min(kMostOmega, 2 / (1 + std::sqrt(1 - rate))); }

int bucket_of(int colour, bool rubs) { return colour + (rubs ? kColours + 1 : 0); }
bool left_over(int bucket) { return bucket % (kColours + 1) == kColours; }

}  // namespace

const PairKernels& pair_kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::pair_kernels() : isa == Isa::avx2 ? avx2::pair_kernels() : sse2::pair_kernels();
}

Sweeps::Sweeps(Team* team, const char* kernels) : team_(team), kernels_(pair_kernels_of(choose_isa(kernels))) {}

// Every pair takes the first colour that none of its nodes has yet.
void Sweeps::paint(const Workspace& work, const std::vector<ContactPair>& pairs) {
  taken_.assign(work.inverse_mass.size(), 0);
  place_.resize(pairs.size());
  long count[kBuckets] = {};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPair& pair = pairs[i];
    std::uint64_t taken = 0;
    for (int k = 0; k < pair.nodes; ++k)
      if (work.inverse_mass[pair.node[k]] > 0) taken |= taken_[pair.node[k]];
    const int colour = ~taken == 0 ? kColours : __builtin_ctzll(~taken);
    if (colour < kColours)
      for (int k = 0; k < pair.nodes; ++k) taken_[pair.node[k]] |= std::uint64_t{1} << colour;
    const int bucket = bucket_of(colour, pair.rub >= 0);
    place_[i] = bucket;
    ++count[bucket];
  }
  colours_.clear();
  long packs = 0, next[kBuckets];
  for (int b = 0; b < kBuckets; ++b) {
    const bool rub = b > kColours;
    if (b == bucket_of(0, true)) first_rub_ = packs;
    next[b] = packs * kLanes;
    const long pairs_of_a_colour = left_over(b) ? 1 : std::max(1L, count[b]);
    for (long i = 0; i < count[b]; i += pairs_of_a_colour) {
      const long last = packs + (pairs_of_a_colour + kLanes - 1) / kLanes;
      colours_.push_back({packs, last, rub});
      packs = last;
    }
  }
  for (int& place : place_) {
    const int bucket = place;
    place = static_cast<int>(next[bucket]);
    next[bucket] += left_over(bucket) ? kLanes : 1;
  }
  packs_.resize(packs);
  rub_packs_.resize(packs - first_rub_);
}

void Sweeps::fill(const Workspace& work, const std::vector<ContactPair>& pairs, const std::vector<Rub>& rubs) {
  // The last pack of a colour may be part empty.
  for (const Colour& c : colours_) {
    packs_[c.last - 1] = PairPack();
    for (int l = 0; l < kLanes; ++l) packs_[c.last - 1].layer[l] = 1;
    if (c.rub) {
      rub_packs_[c.last - 1 - first_rub_] = RubPack();
      for (int l = 0; l < kLanes; ++l) rub_packs_[c.last - 1 - first_rub_].w[l] = 1;
    }
    for (long i = c.first; i < c.last; ++i) packs_[i].nodes = packs_[i].held = 0;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPair& pair = pairs[i];
    PairPack& p = packs_[place_[i] / kLanes];
    const int l = place_[i] % kLanes;
    for (int k = 0; k < 4; ++k) {
      const bool used = k < pair.nodes;
      p.node[k][l] = used ? pair.node[k] : 0;
      p.weight[k][l] = used ? pair.weight[k] : 0;
      if (used && work.projector[pair.node[k]]) p.held = 1;
    }
    p.nodes = std::max(p.nodes, pair.nodes);
    for (int i = 0; i < 3; ++i) p.normal[i][l] = pair.normal[i];
    p.gap[l] = pair.gap;
    p.layer[l] = pair.layer;
    p.stiffness[l] = pair.stiffness;
    p.w[l] = pair.w;
    p.impulse[l] = 0;
    if (pair.rub < 0) continue;
    const Rub& rub = rubs[pair.rub];
    RubPack& r = rub_packs_[place_[i] / kLanes - first_rub_];
    for (int i = 0; i < 3; ++i) r.slip[i][l] = 0;
    r.friction[l] = rub.friction;
    r.w[l] = rub.w;
  }
}

/// Calls work(first, last) over the packs of a colour, by all threads where they are many.
template <class Work> void Sweeps::share(const Colour& colour, Work&& work) const {
  const long count = colour.last - colour.first;
  if (!team_ || count < 2 * kPacksOfAThread) return work(colour.first, colour.last);
  team_->share(count, kPacksOfAThread, [&](long first, long last) { work(colour.first + first, colour.first + last); });
}

RubPack* Sweeps::rubs_of(const Colour& colour, long pack) { return colour.rub ? rub_packs_.data() + (pack - first_rub_) : nullptr; }

double Sweeps::sweep(double dt, double omega, const Movers& movers) {
  std::mutex one;
  double most = 0;
  for (const Colour& c : colours_)
    share(c, [&](long first, long last) {
      const double change = kernels_.sweep(dt, omega, movers, packs_.data() + first, rubs_of(c, first), last - first);
      const std::lock_guard<std::mutex> lock(one);
      most = std::max(most, change);
    });
  return most;
}

bool Sweeps::end_gaps(double dt, const Movers& movers) {
  std::atomic<bool> open{true};
  share({0, static_cast<long>(packs_.size()), false}, [&](long first, long last) {
    if (!kernels_.end_gaps(dt, movers, packs_.data() + first, last - first)) open = false;
  });
  return open;
}

void Sweeps::start(double dt, const Movers& movers, const std::vector<ContactPair>& pairs) {
  std::size_t k = 0;
  for (std::size_t i = 0; i < pairs.size() && k < kept_.size(); ++i) {
    const ContactPair& pair = pairs[i];
    while (k < kept_.size() && kept_[k].key < pair.key) ++k;
    if (k == kept_.size() || !(kept_[k].key == pair.key)) continue;
    const Kept& kept = kept_[k++];
    if (pair.w == 0) continue;
    const int l = place_[i] % kLanes;
    packs_[place_[i] / kLanes].impulse[l] = dt * kept.force;
    if (pair.rub >= 0)
      for (int j = 0; j < 3; ++j) rub_packs_[place_[i] / kLanes - first_rub_].slip[j][l] = dt * kept.drag[j];
  }
  if (kept_.empty()) return;
  for (const Colour& c : colours_)
    share(c, [&](long first, long last) { kernels_.start(movers, packs_.data() + first, rubs_of(c, first), last - first); });
}

void Sweeps::give_back(double dt, std::vector<ContactPair>& pairs, std::vector<Rub>& rubs) {
  kept_.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ContactPair& pair = pairs[i];
    const PairPack& p = packs_[place_[i] / kLanes];
    const int l = place_[i] % kLanes;
    pair.impulse = p.impulse[l];
    pair.end_gap = p.end_gap[l];
    Node slip = Node::Zero();
    if (pair.rub >= 0) {
      const RubPack& r = rub_packs_[place_[i] / kLanes - first_rub_];
      slip = rubs[pair.rub].slip = Node(r.slip[0][l], r.slip[1][l], r.slip[2][l], 0);
    }
    if (pair.impulse > 0) kept_.push_back({pair.key, pair.impulse / dt, {slip[0] / dt, slip[1] / dt, slip[2] / dt}});
  }
}

SweepResult Sweeps::solve(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, std::vector<ContactPair>& pairs,
                          std::vector<Rub>& rubs) {
  paint(work, pairs);
  fill(work, pairs, rubs);
  projector_.resize(work.projector.size());
  for (std::size_t i = 0; i < projector_.size(); ++i) projector_[i] = work.projector[i] ? work.projector[i]->data() : nullptr;
  // While the sweeps last, a node's inverse mass stands beside its velocity.
  for (std::size_t i = 0; i < work.v.size(); ++i) work.v[i][3] = work.inverse_mass[i];
  const Movers movers{work.v.front().data(), projector_.data()};
  start(dt, movers, pairs);
  SweepResult result;
  const auto begin = std::chrono::steady_clock::now();
  double omega = 1, before = 0;
  for (;;) {
    double change = 0;
    for (TiePair& tie : ties) change = std::max(change, sweep_tie(dt, work, tie));
    change = std::max(change, sweep(dt, omega, movers));
    ++result.sweeps;
    if (result.sweeps == kPlainSweeps && change < before) omega = over_relaxation(change / before);
    if (result.sweeps == most / 2) omega = 1;
    before = change;
    if (change >= tolerance && result.sweeps < most) continue;
    result.open = end_gaps(dt, movers);
    if (result.open || result.sweeps >= most) break;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (Node& v : work.v) v[3] = 0;
  give_back(dt, pairs, rubs);
  return result;
}

}  // namespace forming_sim
