#pragma once
// Packs of a group of cells: kWidth of the kLanes cells of a block each. Where their lanes lie, how kernels go through them, and
// what a block has of its packs. For files that are compiled once per vector width only.
#include <cstdint>

#include "forming_sim/element/cell_group.h"
#include "forming_sim/tensor/pack.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// Packs are counted through the blocks of a group. The block of one, and where its lanes begin there.
inline long block_of(long pack) { return pack / kPacks; }
inline int first_lane(long pack) { return static_cast<int>(pack % kPacks) * kWidth; }
/// Where the lanes of a pack are, of arrays with so many items a block.
template <class T> T* lanes_of(T* array, long items, long pack) { return array + block_of(pack) * items * kLanes + first_lane(pack); }

/// Packs [pack, pack + count) of a group that are worked on now, and behind them, up to the end of their tile, those that the same thread goes on with.
/// What lies farther may be another thread's: to fetch that would take it away from where it is being written.
struct PacksNow {
  long pack;
  int count;
  long end;

  bool goes_on(long blocks_ahead) const { return pack + count - 1 + blocks_ahead * kPacks < end; }
};
/// A pack in a step: what every bundle of material/von_mises_points.h that is one knows of itself.
struct PackOfGroup {
  const CellGroup* group;
  const NodalView* view;
  long pack;
  bool fetches;  ///< what is kept of packs that are ahead

  const CellGroup& g() const { return *group; }
};
template <class InStep> void set_pack(const CellGroup& g, const NodalView& view, const PacksNow& now, long pack, long blocks_ahead, InStep& one) {
  static_cast<PackOfGroup&>(one) = {&g, &view, pack, now.goes_on(blocks_ahead)};
}
/// Room for `most` of them; what is behind those of now is not used.
template <class InStep, int most> void set_packs(const CellGroup& g, const NodalView& view, const PacksNow& now, long blocks_ahead, InStep (&packs)[most]) {
  for (int b = 0; b < most; ++b) set_pack(g, view, now, now.pack + b, blocks_ahead, packs[b]);
}
/// Calls work(now) with the packs of the blocks [first, last), `most` at a time.
template <class Work> void packs_at_a_time(int first, int last, int most, Work&& work) {
  const long end = static_cast<long>(last) * kPacks;
  for (long pack = static_cast<long>(first) * kPacks; pack < end; pack += most) work(PacksNow{pack, static_cast<int>(end - pack < most ? end - pack : most), end});
}
/// Calls work(pack) with each of them.
template <class Work> void each_pack(int first, int last, Work&& work) {
  packs_at_a_time(first, last, 1, [&](const PacksNow& now) { work(now.pack); });
}
/// Lanes of a pack that are not copies.
inline int lanes_in_use(const CellGroup& g, long pack) {
  const long left = g.cells - pack * kWidth;
  return left >= kWidth ? kWidth : left > 0 ? static_cast<int>(left) : 0;
}
/// What holds of a block where it holds of each of its packs, in turn.
inline void holds(bool* of_blocks, long pack, bool of_pack) {
  bool& of_block = of_blocks[block_of(pack)];
  of_block = of_pack && (first_lane(pack) == 0 || of_block);
}
/// What a block has of a number that its packs add up to, in turn.
inline void add_to_block(double* of_blocks, long pack, double of_pack) {
  double& of_block = of_blocks[block_of(pack)];
  of_block = first_lane(pack) == 0 ? of_pack : of_block + of_pack;
}

/// Fetches so many lines of what is needed soon into the second cache: what the processor fetches ahead by itself ends with a
/// page, and the first cache is too small for what comes early. Behind the end of an array there is nothing to fetch, which does
/// no harm. The first pack of a block fetches for all of it. (Where it is not inlined at once the compiler takes it for a function that does nothing, and leaves it out.)
[[gnu::always_inline]] inline void fetch_ahead(const void* from, long bytes_ahead, long lines) {
  const std::uintptr_t here = reinterpret_cast<std::uintptr_t>(from), ahead = here + static_cast<std::uintptr_t>(bytes_ahead);
  if (kPacks > 1 && here % sizeof(Lane) != 0) return;
  for (long i = 0; i < lines; ++i) __builtin_prefetch(reinterpret_cast<const void*>(ahead + static_cast<std::uintptr_t>(i) * sizeof(Lane)), 0, 2);
}
/// The memory of the simplex so many behind this one.
[[gnu::always_inline]] inline void fetch_memory(const CellGroup& g, const double* memory, int simplices) {
  fetch_ahead(memory, static_cast<long>(simplices) * g.items * static_cast<long>(sizeof(Lane)), g.items);
}
/// V0 of the simplex so many behind this one.
[[gnu::always_inline]] inline void fetch_initial_volume(const CellGroup& g, const double* memory, int simplices) {
  fetch_ahead(memory, (static_cast<long>(simplices) * g.items + g.items - 1) * static_cast<long>(sizeof(Lane)), 1);
}
/// V0 of a simplex whose memory that is.
inline Pack initial_volume(const CellGroup& g, const double* memory) { return Pack::load(memory + (g.items - 1) * kLanes); }

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
