#pragma once
// The declared rules, held against the values of a Config: finite numbers,
// ranges, choices, what is required, and what does not apply. A value equal to
// the default counts as not given, as in a message.
#include <cmath>
#include <string>
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/reflect.h"
#include "forming_sim/config/words.h"

namespace forming_sim {

/// What would be right for a field: "give a number above 0, in kg/m3 (mass density)".
template <class T> std::string wanted(const Field& field) {
  std::string text;
  if (!field.choices().empty()) {
    std::vector<std::string> words;
    for (const std::string& word : field.choices()) if (!word.empty()) words.push_back(word);
    text = (is_vector<T> ? "give a list out of " : "give one of ") + one_of(words, is_vector<T> ? ", " : " or ");
  } else if constexpr (is_config<T> || is_optional<T>) {
    text = "give its fields, each as `name: value`";
  } else if constexpr (is_vector<T>) {
    text = "give a list";
    if (!range_text(field).empty()) text += " of numbers " + range_text(field);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    text = "give [x, y, z], or [x, y] for z = 0" + (range_text(field).empty() ? "" : ", of a length " + range_text(field));
  } else if constexpr (std::is_same_v<T, double>) {
    text = "give a finite number" + (range_text(field).empty() ? "" : " " + range_text(field));
  } else if constexpr (std::is_same_v<T, int>) {
    text = "give a whole number" + (range_text(field).empty() ? "" : " " + range_text(field));
  } else if constexpr (std::is_same_v<T, bool>) {
    text = "give true or false";
  } else {
    text = "give a text";
  }
  if (field.unit() != "1") text += ", in " + field.unit();
  return text + " (" + field.doc() + ")";
}

/// Collects faults, and keeps a long list of bad entries short.
class FaultList {
 public:
  explicit FaultList(std::vector<Fault>& faults) : faults_(faults) {}
  void add(std::string field, std::string given, std::string remedy) {
    faults_.push_back({Code::invalid_scene, std::move(field), std::move(given), std::move(remedy)});
  }
  /// Of many bad entries of one list the first five are told, and how many more there are.
  template <class Entries, class Check> void each(const Entries& entries, Check&& check) {
    constexpr std::size_t told = 5;
    const std::size_t before = faults_.size();
    std::size_t more = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      check(i);
      if (faults_.size() > before + told) {
        more += faults_.size() - before - told;
        faults_.resize(before + told);
      }
    }
    if (more > 0) faults_.back().remedy += "; and " + std::to_string(more) + " more faults in this list";
  }

 private:
  std::vector<Fault>& faults_;
};

constexpr double kGreatest = 1e100;  ///< of a given number: its square and cube are numbers still

/// A value by itself: finite, in range, one of the choices.
template <class T> void check_value(const T& value, const std::string& path, const Field& field, FaultList& faults) {
  if constexpr (is_number<T>) {
    const double number = value;
    if (!std::isfinite(number) || !field.contains(number)) faults.add(path, given_text(value), wanted<T>(field));
    else if (std::abs(number) > kGreatest) faults.add(path, given_text(value), "give a number of at most 1e100");
  } else if constexpr (std::is_same_v<T, Vec3>) {
    if (!value.allFinite()) faults.add(path, given_text(value), "give three finite numbers");
    else if (value.cwiseAbs().maxCoeff() > kGreatest) faults.add(path, given_text(value), "give numbers of at most 1e100");
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!is_utf8(value))
      return faults.add(path, std::to_string(value.size()) + " bytes that are not UTF-8", "give a text in UTF-8: the files of a run hold it, and whoever reads them expects that");
    if (value.find('\0') != std::string::npos) return faults.add(path, "a text with a NUL character", "leave that out: what follows it would be lost in the files of a run");
    const auto& words = field.choices();
    if (!words.empty() && std::find(words.begin(), words.end(), value) == words.end()) {
      faults.add(path, given_text(value), wanted<T>(field) + did_you_mean(value, words));
    }
  } else if constexpr (is_vector<T>) {
    faults.each(value, [&](std::size_t i) {
      check_value(static_cast<const typename T::value_type&>(value[i]), join_path(path, i), field, faults);
    });
  }
}

/// All declared rules over a Config and what it contains.
template <class Config> void check_config(const Config& config, const std::string& path, FaultList& faults) {
  const Config defaults{};
  for_each_field(config, defaults, [&](const char* name, const auto& value, const auto& standard, const Field& field) {
    using T = std::decay_t<decltype(value)>;
    const std::string here = join_path(path, name);
    const bool given = !same(value, standard);
    const Applies where = applies(config, field);
    if (given && where == Applies::no) {
      std::string text = "something";
      if constexpr (!is_group<T>) text = given_text(value);
      faults.add(here, text, "leave it out: it applies only " + when_text(field));
      return;
    }
    if constexpr (is_config<T>) {
      check_config(value, here, faults);
    } else {
      if (!given) {
        if (field.is_required() && !field.zero_is_given() && where == Applies::yes) {
          faults.add(here, "nothing", "it is required" + (field.when_field().empty() ? "" : " " + when_text(field)) +
                                          ": " + wanted<T>(field));
        }
        return;
      }
      if constexpr (is_optional<T>) {
        check_config(*value, here, faults);
      } else if constexpr (is_group<T>) {
        for (std::size_t i = 0; i < value.size(); ++i) check_config(value[i], join_path(here, i), faults);
      } else {
        check_value(value, here, field, faults);
      }
    }
  });
}

}  // namespace forming_sim
