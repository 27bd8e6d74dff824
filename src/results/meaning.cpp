#include "forming_sim/results/meaning.h"

#include <filesystem>
#include <functional>
#include <iomanip>
#include <sstream>

#include "forming_sim/mesh/url.h"
#include "forming_sim/results/text_file.h"
#include "forming_sim/scene/urls.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {
namespace {

void take_content(std::string& url, const std::string& base_directory) {
  if (url.empty()) return;
  try {
    const std::string path = resolve_url(url, base_directory), content = read_text(path);
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
  for (const auto& [path, url] : urls_of(meant)) take_content(*url, scene.base_directory);
  return write_scene(meant);
}

}  // namespace forming_sim
