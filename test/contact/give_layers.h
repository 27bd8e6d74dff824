#pragma once
// What the search does with the pairs that it finds: their layers, one by one, then those that are handed over.
#include "forming_sim/contact/layers.h"

namespace contact_test {

inline void give_layers(const forming_sim::Layers& layers, forming_sim::LargeArray<forming_sim::ContactPair>& pairs, std::vector<forming_sim::Rub>& rubs) {
  forming_sim::Layers::Place place;
  std::vector<long> born;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (layers.give(pairs[i], rubs, place)) born.push_back(static_cast<long>(i));
  layers.hand_over(born, pairs);
}

}  // namespace contact_test
