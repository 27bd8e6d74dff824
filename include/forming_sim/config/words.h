#pragma once
// How faults and documents word numbers, lists and conditions.
#include <string>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// The shortest decimal that reads back to the same number: 0.1, 7.05e+10; "nan", "inf".
std::string number_text(double value);
/// A value above 0, rounded for notes and faults.
std::string three_digits(double value);

/// Whether its bytes are UTF-8.
bool is_utf8(const std::string& text);

/// What was given, as a user would write it: numbers, [x, y, z], words in quotes,
/// lists of more than 6 shortened.
std::string given_text(double value);
std::string given_text(int value);
std::string given_text(bool value);
std::string given_text(const std::string& value);
std::string given_text(const Vec3& value);
template <class T> std::string given_text(const std::vector<T>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size() && i < 6; ++i) {
    text += (i ? ", " : "") + given_text(static_cast<const T&>(values[i]));
  }
  return text + (values.size() > 6 ? ", ... (" + std::to_string(values.size()) + " in all)]" : "]");
}

/// "a, b or c".
std::string one_of(const std::vector<std::string>& words, const char* last = " or ");

/// The word of the list nearest to the given one by edits (insert, drop, change,
/// swap neighbours), empty if none is near enough to be meant.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

/// "; did you mean density?" or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& words);

/// "above 0 and at most 100000", "at least 0"; empty without bounds.
std::string range_text(const Field& field);

/// " kg/m3"; empty for pure numbers.
std::string unit_text(const Field& field);

/// "where shape is strip or plate"; empty for a field that always applies.
std::string when_text(const Field& field);

}  // namespace forming_sim
