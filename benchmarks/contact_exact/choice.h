#pragma once
// The words by which a run names itself.
#include <cstdio>
#include <string>

namespace forming_sim::bench {

/// "mu 0.2": what printf makes of a format for some numbers.
template <class... Number> std::string words(const char* format, Number... number) {
  char text[120];
  std::snprintf(text, sizeof text, format, number...);
  return text;
}

}  // namespace forming_sim::bench
