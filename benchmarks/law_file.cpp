#include "law_file.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "forming_sim/results/text_file.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim::bench {
namespace {

// The smallest scene around a material: so every rule of a scene holds for it.
const std::string kBefore =
    "name: law\n"
    "dimension: 3\n"
    "stages: [{kind: form, duration: 1}]\n"
    "bodies:\n"
    "  - name: body\n"
    "    blank: {shape: plate, length: 1, width: 1, thickness: 1, cells_along: 1, cells_across: 1, cells_through: 1}\n"
    "    material:\n";
const std::string kIndent = "      ";
const std::string kField = "bodies[0].material";

/// "line 9" -> "line 2", "column 9" -> "column 3": of the file, not of the scene around it.
std::string in_file(std::string text) {
  const long lines = std::count(kBefore.begin(), kBefore.end(), '\n');
  for (const auto& [word, shift] : {std::pair<std::string, long>{"line ", lines}, {"column ", static_cast<long>(kIndent.size())}}) {
    std::smatch found;
    if (!std::regex_search(text, found, std::regex(word + "([0-9]+)"))) continue;
    const long number = std::max(1L, std::stol(found[1]) - shift);
    text = found.prefix().str() + word + std::to_string(number) + found.suffix().str();
  }
  return text;
}

}  // namespace

MaterialConfig read_law(const std::string& path) {
  std::istringstream text(read_text(path));
  std::string scene_text = kBefore;
  for (std::string line; std::getline(text, line);) scene_text += kIndent + line + "\n";
  std::vector<Fault> faults;
  const Scene scene = read_scene(scene_text, ".", faults);
  if (!faults.empty()) {
    std::string all = path + " is not the material block of a scene:";
    for (const Fault& fault : faults) {
      std::string field = fault.field;
      if (field.compare(0, kField.size(), kField) == 0) field = "material" + field.substr(kField.size());
      else if (field == "scene") field = "file";
      all += "\n  " + field + ": given " + in_file(fault.given) + "; " + in_file(fault.remedy);
    }
    throw std::runtime_error(all);
  }
  return scene.bodies.at(0).material;
}

}  // namespace forming_sim::bench
