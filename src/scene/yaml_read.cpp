#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "forming_sim/scene/validate.h"
#include "forming_sim/scene/yaml.h"
#include "yaml_reader.h"

namespace forming_sim {

namespace {

/// `inner` is `outer` or lies in it: "a.b[1]" in "a.b" and in "a".
bool lies_in(const std::string& inner, const std::string& outer) {
  return inner.compare(0, outer.size(), outer) == 0 &&
         (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
}

/// A fault of a whole list says nothing new where an entry of it is at fault.
bool is_list_of(const std::string& list, const std::string& entry) {
  return lies_in(entry, list) && entry.size() > list.size() && entry[list.size()] == '[';
}

/// Characters that YAML does not bear and nobody sees.
std::string odd_characters(const std::string& text) {
  const auto line_of = [&](std::size_t place) { return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(place), '\n')); };
  if (const auto nul = text.find('\0'); nul != std::string::npos) return "; line " + line_of(nul) + " has a NUL character: the file is no text, or damaged";
  if (const auto tab = text.find('\t'); tab != std::string::npos) return "; line " + line_of(tab) + " has a tab: YAML is indented with spaces";
  return "";
}

/// The first line that is not UTF-8, from 1; 0: there is none.
int line_in_other_encoding(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!is_utf8(line)) return number;
  }
  return 0;
}

}  // namespace

void merge_faults(std::vector<Fault>& known, const std::vector<Fault>& more) {
  const std::size_t before = known.size();
  for (const Fault& fault : more) {
    const auto told = [&](const Fault& other) { return lies_in(fault.field, other.field) || is_list_of(fault.field, other.field); };
    if (std::none_of(known.begin(), known.begin() + static_cast<long>(before), told)) known.push_back(fault);
  }
}

Scene read_scene(const std::string& yaml_text, const std::string& base_directory, std::vector<Fault>& faults) {
  Scene scene;
  scene.base_directory = base_directory;
  scene.text = yaml_text;
  if (const int line = line_in_other_encoding(yaml_text); line > 0) {
    FaultList(faults).add("scene", "a text that is not UTF-8 at line " + std::to_string(line), "save it as UTF-8: the files of a run hold it, and whoever reads them expects that");
    return scene;
  }
  std::vector<Fault> found;
  YamlReader reader(found);
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(yaml_text);
    if (documents.size() == 1) {
      reader.read_config(documents.front(), scene, "");
      if (documents.front().IsMap()) merge_faults(found, check_scene(scene));
    } else {
      FaultList(found).add("scene", std::to_string(documents.size()) + " YAML documents", "give one document with the fields of a scene");
    }
  } catch (const YAML::Exception& error) {
    found.clear();
    FaultList(found).add("scene", "a text that is not YAML at line " + std::to_string(error.mark.line + 1) + ", column " + std::to_string(error.mark.column + 1), error.msg + odd_characters(yaml_text));
  }
  for (Fault& fault : found) {
    const int line = reader.line_of(fault.field);
    if (line > 0) fault.given += " (line " + std::to_string(line) + ")";
  }
  faults.insert(faults.end(), found.begin(), found.end());
  return scene;
}

Scene read_scene_file(const std::string& path, std::vector<Fault>& faults) {
  namespace fs = std::filesystem;
  constexpr std::size_t kMost = 256 << 20;  // bytes: what comes from a device never ends
  std::error_code problem;
  std::ifstream file(path, std::ios::binary);
  std::string text, part(1 << 16, '\0');
  while (text.size() <= kMost && file.read(part.data(), static_cast<std::streamsize>(part.size())).gcount() > 0) text.append(part, 0, static_cast<std::size_t>(file.gcount()));
  if (text.empty() || fs::is_directory(path, problem)) {
    const char* why = fs::is_directory(path, problem) ? "is a directory" : !fs::exists(path, problem) ? "does not exist" : !file.is_open() ? "cannot be opened for reading; check its permissions" : "is empty";
    throw Error(Code::output_error, "The scene file '" + path + "' " + why + "; give the path of a YAML file.");
  }
  if (text.size() > kMost) throw Error(Code::output_error, "The scene file '" + path + "' is longer than 256 MiB; give the path of a YAML file.");
  const fs::path whole = fs::absolute(path, problem);  // empty where the working directory is gone
  return read_scene(text, (problem ? fs::path(path) : whole).parent_path().string(), faults);
}

Scene read_scene_file(const std::string& path) {
  std::vector<Fault> faults;
  Scene scene = read_scene_file(path, faults);
  if (!faults.empty()) throw SceneError(faults);
  return scene;
}

}  // namespace forming_sim
