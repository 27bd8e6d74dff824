#include <yaml-cpp/yaml.h>

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

}  // namespace

std::string write_scene(const Scene& scene) {
  YAML::Emitter out;
  out.SetBoolFormat(YAML::TrueFalseBool);
  write_config(out, scene);
  return std::string(out.c_str()) + "\n";
}

}  // namespace forming_sim
