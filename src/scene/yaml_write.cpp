#include <yaml-cpp/yaml.h>

#include <sstream>

#include "forming_sim/config/reflect.h"
#include "forming_sim/config/words.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {

namespace {

template <class T> void write(YAML::Emitter& out, const T& value);

template <class Config> void write_config(YAML::Emitter& out, const Config& config) {
  const Config defaults{};
  out << YAML::BeginMap;
  for_each_field(config, defaults, [&](const char* name, const auto& value, const auto& standard, const Field& field) {
    const bool said = field.is_required() && field.zero_is_given();  // zero was given
    if (!said && same(value, standard)) return;
    out << YAML::Key << name << YAML::Value;
    write(out, value);
  });
  out << YAML::EndMap;
}

/// Numbers as the shortest text that reads back to the same number.
void write_number(YAML::Emitter& out, double value) {
  out << (std::isnan(value) ? ".nan" : std::isinf(value) ? (value > 0 ? ".inf" : "-.inf") : number_text(value));
}

template <class T> void write(YAML::Emitter& out, const T& value) {
  if constexpr (is_config<T>) {
    write_config(out, value);
  } else if constexpr (is_optional<T>) {
    write_config(out, *value);  // an absent one is the default and not written
  } else if constexpr (is_vector<T>) {
    if constexpr (!is_config<typename T::value_type>) out << YAML::Flow;
    out << YAML::BeginSeq;
    for (const auto& entry : value) write(out, entry);
    out << YAML::EndSeq;
  } else if constexpr (std::is_same_v<T, Vec3>) {
    out << YAML::Flow << YAML::BeginSeq;
    for (int i = 0; i < 3; ++i) write_number(out, value[i]);
    out << YAML::EndSeq;
  } else if constexpr (std::is_same_v<T, double>) {
    write_number(out, value);
  } else {
    out << value;
  }
}

template <class Config> std::string text_of(const Config& config) {
  YAML::Emitter out;
  out.SetBoolFormat(YAML::TrueFalseBool);
  write_config(out, config);
  return std::string(out.c_str()) + "\n";
}

}  // namespace

std::string write_scene(const Scene& scene) { return text_of(scene); }
std::string write_material(const MaterialConfig& material) { return text_of(material); }

std::string first_difference(const std::string& one, const std::string& other, const std::string& of_one, const std::string& of_other) {
  std::istringstream first(one), second(other);
  std::string left, right, part;
  for (;;) {
    const bool more_left = bool(std::getline(first, left)), more_right = bool(std::getline(second, right));
    if (!more_left) left = "(end)";
    if (!more_right) right = "(end)";
    const auto indented = [](const std::string& line) { return line.find_first_of(" -") == 0; };
    if (left != right || (!more_left && !more_right)) return (indented(left) || indented(right) ? part : "") + "'" + left + "' " + of_one + ", '" + right + "' " + of_other;
    if (!indented(left)) part = "in " + left.substr(0, left.find(':')) + ": ";
  }
}

}  // namespace forming_sim
