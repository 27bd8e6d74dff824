#pragma once
// Arrays that are gone through in every step. Where one is large it asks for large pages, so that
// the processor need not look up every four kilobytes where the next ones are.
#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace forming_sim {

template <class T> struct LargePages {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{2} << 20;  ///< bytes
  static constexpr std::align_val_t aligned(std::size_t bytes) { return std::align_val_t(bytes >= kPage ? kPage : alignof(T) > 64 ? alignof(T) : 64); }

  LargePages() = default;
  template <class U> LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* const memory = ::operator new(bytes, aligned(bytes));
    if (bytes >= kPage) madvise(memory, bytes / kPage * kPage, MADV_HUGEPAGE);  // a wish: without it all is the same, if slower
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, aligned(count * sizeof(T))); }
  template <class U> bool operator==(const LargePages<U>&) const { return true; }
  template <class U> bool operator!=(const LargePages<U>&) const { return false; }
};

template <class T> using LargeArray = std::vector<T, LargePages<T>>;

}  // namespace forming_sim
