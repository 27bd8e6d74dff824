#include "forming_sim/config/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace forming_sim {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char buffer[64];
  const bool plain = value == 0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e7);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format).ptr;
  return std::string(buffer, end);
}

std::string three_digits(double value) {
  if (value == 0) return "0";
  const double digits = std::pow(10, 2 - std::floor(std::log10(std::abs(value))));
  return number_text(std::round(value * digits) / digits);
}

bool is_utf8(const std::string& text) {
  if (std::none_of(text.begin(), text.end(), [](unsigned char c) { return c > 0x7f; })) return true;
  try {
    nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
  return true;
}

std::string given_text(double value) { return number_text(value); }
std::string given_text(int value) { return std::to_string(value); }
std::string given_text(bool value) { return value ? "true" : "false"; }
std::string given_text(const std::string& value) { return value.empty() ? "nothing" : "'" + value + "'"; }
std::string given_text(const Vec3& value) {
  return "[" + number_text(value.x()) + ", " + number_text(value.y()) + ", " + number_text(value.z()) + "]";
}

std::string one_of(const std::vector<std::string>& words, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? last : ", ";
    text += words[i];
  }
  return text;
}

namespace {

/// Edit distance with swaps of neighbours (optimal string alignment).
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  constexpr std::size_t longest = 100;  // beyond it, nobody meant a field
  if (word.size() > longest) return "";
  std::string best;
  std::size_t least = longest;
  for (const std::string& candidate : words) {
    std::size_t distance = edits(word, candidate);
    // A word written in part, or with a unit or an adjective too many: "modulus", "length_mm".
    const bool part = word.size() > 2 && candidate.size() > 2 &&
                      (candidate.find(word) != std::string::npos || word.find(candidate) != std::string::npos);
    if (part) distance = std::min<std::size_t>(distance, 2);
    const std::size_t enough = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    if ((part || distance <= enough) && distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(word, words);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::string range_text(const Field& field) {
  std::string text;
  if (std::isfinite(field.min())) text = (field.min_open() ? "above " : "at least ") + number_text(field.min());
  if (std::isfinite(field.max())) {
    text += (text.empty() ? "" : " and ") + std::string(field.max_open() ? "below " : "at most ") + number_text(field.max());
  }
  return text;
}

std::string unit_text(const Field& field) { return field.unit() == "1" ? "" : " " + field.unit(); }

std::string when_text(const Field& field) {
  return field.when_field().empty() ? "" : "where " + field.when_field() + " is " + one_of(field.when_values());
}

}  // namespace forming_sim
