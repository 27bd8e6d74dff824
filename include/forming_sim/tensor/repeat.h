#pragma once
// A short loop whose index is a constant in every turn. The compiler decides early which arrays can live in
// registers, and those that a variable indexes are not among them: of a law written with plain loops over
// components every intermediate tensor would go through memory.
#include <type_traits>
#include <utility>

namespace forming_sim {

template <class F, int... I> [[gnu::always_inline]] inline void repeat_each(F&& f, std::integer_sequence<int, I...>) {
  (f(std::integral_constant<int, I>()), ...);
}
/// f(0), f(1), ..., f(N - 1).
template <int N, class F> [[gnu::always_inline]] inline void repeat(F&& f) { repeat_each(f, std::make_integer_sequence<int, N>()); }

}  // namespace forming_sim
