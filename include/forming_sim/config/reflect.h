#pragma once
// What every reader, writer and checker of Configs needs of their declarations:
// the kinds of members, a walk over them, equality, and where a field applies.
#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "forming_sim/config/field.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

struct IgnoreField {
  template <class Access> void operator()(const char*, Access, const Field&) const {}
};

template <class T, class = void> struct IsConfig : std::false_type {};
template <class T>
struct IsConfig<T, std::void_t<decltype(T::declare(std::declval<IgnoreField>()))>> : std::true_type {};
template <class T> constexpr bool is_config = IsConfig<T>::value;

template <class T> struct IsVector : std::false_type {};
template <class T> struct IsVector<std::vector<T>> : std::true_type {};
template <class T> constexpr bool is_vector = IsVector<T>::value;

template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};
template <class T> constexpr bool is_optional = IsOptional<T>::value;

/// A group of fields, one that may be absent, or a list of them: not a plain value.
template <class T> struct IsGroup : std::bool_constant<is_config<T> || is_optional<T>> {};
template <class T> struct IsGroup<std::vector<T>> : IsGroup<T> {};
template <class T> constexpr bool is_group = IsGroup<T>::value;

template <class T> constexpr bool is_number = std::is_same_v<T, double> || std::is_same_v<T, int>;

/// Calls function(name, value, field) for every member of the config, in the
/// order of its declaration; the value is const where the config is.
template <class Config, class Function> void for_each_field(Config& config, Function&& function) {
  std::decay_t<Config>::declare(
      [&](const char* name, auto access, const Field& field) { function(name, access(config), field); });
}

/// The same for two configs of one type at once: function(name, a, b, field).
template <class A, class B, class Function> void for_each_field(A& a, B& b, Function&& function) {
  std::decay_t<A>::declare(
      [&](const char* name, auto access, const Field& field) { function(name, access(a), access(b), field); });
}

/// Equal in every declared field; NaN equals nothing.
template <class T> bool same(const T& a, const T& b) {
  if constexpr (is_config<T>) {
    bool equal = true;
    for_each_field(a, b, [&](const char*, const auto& x, const auto& y, const Field&) { equal = equal && same(x, y); });
    return equal;
  } else if constexpr (is_optional<T>) {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
  } else if constexpr (is_vector<T>) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) { return same(x, y); });
  } else {
    return a == b;
  }
}

/// "bodies[0]" and "name" give "bodies[0].name"; the scene itself has the path "".
inline std::string join_path(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}
inline std::string join_path(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

/// Whether a field applies, by the value of the sibling its `when` names.
enum class Applies { yes, no, unknown /* the sibling itself is missing or wrong */ };

template <class Config> Applies applies(const Config& config, const Field& field) {
  if (field.when_field().empty()) return Applies::yes;
  Applies answer = Applies::unknown;
  for_each_field(config, [&](const std::string& name, const auto& value, const Field& sibling) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
      if (name != field.when_field()) return;
      const auto among = [&](const std::vector<std::string>& words) {
        return std::find(words.begin(), words.end(), value) != words.end();
      };
      if (among(field.when_values())) answer = Applies::yes;
      else if (among(sibling.choices())) answer = Applies::no;
    }
  });
  return answer;
}

/// Names of all fields of a Config.
template <class Config> std::vector<std::string> field_names() {
  std::vector<std::string> names;
  Config::declare([&](const char* name, auto, const Field&) { names.push_back(name); });
  return names;
}

}  // namespace forming_sim
