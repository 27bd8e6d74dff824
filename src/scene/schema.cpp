#include "forming_sim/scene/schema.h"

#include <typeindex>

#include "forming_sim/config/words.h"
#include "forming_sim/config/reflect.h"
#include "forming_sim/scene/scene.h"
#include "schema_intro.h"

namespace forming_sim {

namespace {

template <class T> std::string type_text() {
  if constexpr (is_config<T> || is_optional<T>) return "group";
  else if constexpr (is_group<T>) return "list of groups";
  else if constexpr (is_vector<T>) return "list of " + type_text<typename T::value_type>() + (std::is_same_v<typename T::value_type, Vec3> ? "" : "s");
  else if constexpr (std::is_same_v<T, double>) return "number";
  else if constexpr (std::is_same_v<T, int>) return "whole number";
  else if constexpr (std::is_same_v<T, bool>) return "true or false";
  else if constexpr (std::is_same_v<T, Vec3>) return "[x, y, z]";
  else return "text";
}

template <class T> std::string standard_text(const T& value, const Field& field) {
  if (!field.computed().empty()) return field.computed();
  if constexpr (is_group<T>) return "none";
  else if constexpr (is_vector<T>) return "[]";
  else if constexpr (std::is_same_v<T, std::string>) return value.empty() ? "none" : value;
  else return given_text(value);
}

template <class T> FieldText words_of(const char* name, const T& value, const Field& field) {
  std::vector<std::string> words;
  for (const std::string& word : field.choices()) {
    if (!word.empty()) words.push_back(word);
  }
  FieldText text{name, type_text<T>(), field.unit() == "1" ? "" : field.unit(), range_text(field), "", when_text(field), field.doc(), field.is_required()};
  if (!words.empty()) text.range = one_of(words, ", ");
  if (!field.is_required()) text.standard = standard_text(value, field);
  return text;
}

class Collector {
 public:
  template <class Config> void collect(const std::string& path, const std::string& doc) {
    for (std::size_t i = 0; i < types_.size(); ++i) {
      if (types_[i] != std::type_index(typeid(Config))) continue;
      groups[i].paths.push_back(path);
      return;
    }
    types_.push_back(typeid(Config));
    groups.push_back({{path}, doc, {}});
    const std::size_t mine = groups.size() - 1;
    const Config standard{};
    for_each_field(standard, [&](const char* name, const auto& value, const Field& field) {
      groups[mine].fields.push_back(words_of(name, value, field));
    });
    for_each_field(standard, [&](const char* name, const auto& value, const Field& field) {
      using T = std::decay_t<decltype(value)>;
      if constexpr (is_config<T>) collect<T>(join_path(path, name), field.doc());
      else if constexpr (is_group<T>) collect<typename T::value_type>(join_path(path, name) + (is_vector<T> ? "[]" : ""), field.doc());
    });
  }

  std::vector<GroupText> groups;

 private:
  std::vector<std::type_index> types_;
};

std::string title_of(const GroupText& group) {
  return group.paths.front().empty() ? "scene" : one_of(group.paths, ", ");
}

std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string markdown_table(const GroupText& group) {
  std::string text = "| field | type | unit | range | default | applies | meaning |\n|---|---|---|---|---|---|---|\n";
  for (const FieldText& field : group.fields) {
    text += "| `" + field.name + "` | " + cell(field.type) + " | " + field.unit + " | " + cell(field.range) + " | " +
            (field.required ? "**required**" : cell(field.standard)) + " | " + (field.when.empty() ? "always" : cell(field.when)) + " | " + cell(field.doc) + " |\n";
  }
  return text;
}

}  // namespace

std::vector<GroupText> schema() {
  Collector collector;
  collector.collect<Scene>("", "the whole file");
  return collector.groups;
}

std::string schema_text() {
  std::string text = "Fields of a scene. SI units. * marks what is required (where it applies).\n";
  for (const GroupText& group : schema()) {
    text += "\n" + title_of(group) + ": " + group.doc + "\n";
    for (const FieldText& field : group.fields) {
      text += "  " + std::string(field.required ? "* " : "  ") + field.name + ": " + field.type;
      if (!field.unit.empty()) text += ", " + field.unit;
      if (!field.range.empty()) text += "; " + field.range;
      if (!field.required) text += "; default: " + field.standard;
      if (!field.when.empty()) text += "; only " + field.when;
      text += "\n        " + field.doc + "\n";
    }
  }
  return text;
}

std::string schema_markdown() {
  std::string text = schema_intro();
  text += "\n## A complete small scene\n\n" + small_example_words() + "\n```yaml\n" + minimal_example() + "```\n";
  text += "\n## A flange: tools, stages, springback\n\n" + flange_example_words() + "\n```yaml\n" + flange_example() + "```\n";
  text += "\n" + fields_words();
  for (const GroupText& group : schema()) {
    text += "\n### " + title_of(group) + "\n\n" + group.doc + ".\n\n" + markdown_table(group);
  }
  return text;
}

}  // namespace forming_sim
