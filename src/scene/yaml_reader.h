#pragma once
// From YAML nodes into Configs, by their declarations.
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "forming_sim/config/check.h"

namespace forming_sim {

class YamlReader {
 public:
  explicit YamlReader(std::vector<Fault>& faults) : faults_(faults) {}

  /// Line on which a path, or the nearest thing that holds it, was given; 0: nowhere.
  int line_of(std::string path) const {
    while (!path.empty()) {
      const auto found = lines_.find(path);
      if (found != lines_.end()) return found->second;
      const std::size_t cut = path.find_last_of(".[");
      path = cut == std::string::npos ? "" : path.substr(0, cut);
    }
    return 0;
  }

  template <class Config> void read_config(const YAML::Node& node, Config& config, const std::string& path) {
    if (!node.IsMap()) {
      faults_.add(path.empty() ? "scene" : path, told(node), "give its fields, each as `name: value`: " + one_of(field_names<Config>(), ", "));
      return;
    }
    const std::map<std::string, YAML::Node> members = members_of<Config>(node, path);
    for_each_field(config, [&](const char* name, auto& value, const Field& field) {
      const auto found = members.find(name);
      if (found != members.end()) read_value(found->second, value, join_path(path, name), field);
    });
    for_each_field(config, [&](const char* name, auto& value, const Field& field) {
      using T = std::decay_t<decltype(value)>;
      const std::string here = join_path(path, name);
      const Applies where = applies(config, field);
      const auto found = members.find(name);
      if (found == members.end() && field.is_required() && where == Applies::yes) {
        faults_.add(here, "nothing", "it is required" + (field.when_field().empty() ? "" : " " + when_text(field)) + ": " + wanted<T>(field));
      } else if (found != members.end() && where == Applies::no) {
        faults_.add(here, told(found->second), "leave it out: it applies only " + when_text(field));
      } else if constexpr (std::is_same_v<T, Vec3>) {
        if (found != members.end() && field.is_required() && !field.zero_is_given() && is_zero(found->second)) faults_.add(here, told(found->second) + " zeros", wanted<T>(field));
      }
    });
  }

 private:
  /// What was given, as text.
  static std::string told(const YAML::Node& node) {
    if (!node.IsDefined() || node.IsNull()) return "nothing";
    if (node.IsMap()) return "a group of fields";
    if (node.IsSequence()) return "a list of " + std::to_string(node.size());
    constexpr std::size_t longest = 80;
    return node.Scalar().size() <= longest ? "'" + node.Scalar() + "'" : "'" + node.Scalar().substr(0, longest) + "...'";
  }

  template <class Config> std::map<std::string, YAML::Node> members_of(const YAML::Node& node, const std::string& path) {
    const std::vector<std::string> names = field_names<Config>();
    std::map<std::string, YAML::Node> members;
    std::vector<YAML::Node> merged;
    for (const auto& pair : node) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "?";
      if (path.empty() && key.rfind("x-", 0) == 0) continue;  // of the user, to be named by an alias
      if (key == "<<") {
        if (!pair.second.IsSequence()) merged.push_back(pair.second);
        else
          for (const YAML::Node& other : pair.second) merged.push_back(other);
        continue;
      }
      const std::string here = join_path(path, key);
      const bool twice = members.count(key) > 0;
      if (!twice) lines_[here] = pair.first.Mark().line + 1;
      if (std::find(names.begin(), names.end(), key) == names.end()) {
        refuse_key(here, "a key that does not exist", key, names);
      } else if (twice) {
        faults_.add(here, "twice, again on line " + std::to_string(pair.first.Mark().line + 1), "give it once");
      } else {
        members.emplace(key, pair.second);
      }
    }
    for (const YAML::Node& other : merged) merge(other, names, path, members);
    return members;
  }

  void refuse_key(const std::string& here, const std::string& given, const std::string& key, const std::vector<std::string>& names) {
    faults_.add(here, given, "the keys here are " + one_of(names, ", ") + did_you_mean(key, names));
  }

  /// What `<<: *other` brings: the members of other that were not given here.
  void merge(const YAML::Node& other, const std::vector<std::string>& names, const std::string& path, std::map<std::string, YAML::Node>& members) {
    if (!other.IsMap()) {
      faults_.add(join_path(path, "<<"), told(other), "give the alias of a group of fields, as in <<: *steel, or a list of such");
      return;
    }
    for (const auto& pair : other) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "?", here = join_path(path, key);
      if (std::find(names.begin(), names.end(), key) == names.end()) {
        refuse_key(here, "a key that does not exist, by <<", key, names);
      } else if (members.emplace(key, pair.second).second) {
        lines_[here] = pair.first.Mark().line + 1;
      }
    }
  }

  template <class T> void read_value(const YAML::Node& node, T& value, const std::string& path, const Field& field) {
    if constexpr (is_config<T>) {
      read_config(node, value, path);
    } else if constexpr (is_optional<T>) {
      read_config(node, value.emplace(), path);
    } else if constexpr (is_vector<T>) {
      if (!node.IsSequence()) {
        faults_.add(path, told(node), wanted<T>(field));
        return;
      }
      value.resize(node.size());
      std::vector<YAML::Node> entries(node.begin(), node.end());
      if constexpr (is_group<T>) {
        for (std::size_t i = 0; i < entries.size(); ++i) {
          lines_[join_path(path, i)] = entries[i].Mark().line + 1;
          read_value(entries[i], value[i], join_path(path, i), field);
        }
      } else {
        faults_.each(entries, [&](std::size_t i) { read_value(entries[i], value[i], join_path(path, i), field); });
      }
    } else if constexpr (std::is_same_v<T, Vec3>) {
      value.setZero();  // a list of vectors was grown without values
      if (!node.IsSequence() || (node.size() != 2 && node.size() != 3)) {
        faults_.add(path, told(node), wanted<T>(field));
        return;
      }
      if (is_zero(node) && !field.contains(0)) faults_.add(path, told(node), wanted<T>(field));  // as of numbers, below
      for (std::size_t i = 0; i < node.size(); ++i) {
        if (!convert(node[i], value[static_cast<int>(i)])) {
          faults_.add(join_path(path, i), told(node[i]), "give a finite number" + (unit_text(field).empty() ? "" : ", in" + unit_text(field)));
        }
      }
    } else if (!convert(node, value)) {
      faults_.add(path, told(node), wanted<T>(field));
    } else if constexpr (is_number<T>) {  // a zero that is not allowed: for all that comes later it would not be there
      if (value == 0 && !field.contains(0)) faults_.add(path, told(node), wanted<T>(field));
    }
  }

  static bool is_zero(const YAML::Node& vector) {
    double value = 1;
    return vector.IsSequence() && std::all_of(vector.begin(), vector.end(), [&](const auto& entry) { return convert(entry, value) && value == 0; });
  }

  static bool convert(const YAML::Node& node, double& value) {
    return node.IsScalar() && YAML::convert<double>::decode(node, value) && std::isfinite(value);
  }
  static bool convert(const YAML::Node& node, int& value) {
    double number = 0;
    if (!convert(node, number) || number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max()) return false;
    value = static_cast<int>(number);
    return true;
  }
  static bool convert(const YAML::Node& node, bool& value) { return node.IsScalar() && YAML::convert<bool>::decode(node, value); }
  static bool convert(const YAML::Node& node, std::string& value) {
    if (!node.IsScalar()) return false;
    value = node.Scalar();
    return true;
  }

  FaultList faults_;
  std::map<std::string, int> lines_;
};

}  // namespace forming_sim
