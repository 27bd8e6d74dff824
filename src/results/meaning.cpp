#include "forming_sim/results/meaning.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iterator>
#include <sstream>

#include "forming_sim/mesh/url.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {
namespace {

void take_content(std::string& url, const std::string& base_directory) {
  if (url.empty()) return;
  try {
    const std::string path = resolve_url(url, base_directory);
    std::ifstream file(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::ostringstream text;
    text << std::filesystem::path(path).filename().string() << ", content " << std::hex << std::setw(16) << std::setfill('0') << std::hash<std::string>()(content);
    url = text.str();
  } catch (const Error&) {
    // Who reads the file says what is wrong with it.
  }
}

}  // namespace

std::string meaning_of(const Scene& scene) {
  Scene meant = scene;
  for (BodyConfig& body : meant.bodies) {
    if (body.mesh) take_content(body.mesh->url, scene.base_directory);
    if (body.formed) take_content(body.formed->url, scene.base_directory);
  }
  for (ToolConfig& tool : meant.tools)
    if (tool.mesh) take_content(tool.mesh->url, scene.base_directory);
  return write_scene(meant);
}

}  // namespace forming_sim
