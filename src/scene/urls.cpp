#include "forming_sim/scene/urls.h"

#include "forming_sim/config/reflect.h"

namespace forming_sim {

std::vector<std::pair<std::string, std::string*>> urls_of(Scene& scene) {
  std::vector<std::pair<std::string, std::string*>> urls;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].mesh) urls.emplace_back(join_path("bodies", i) + ".mesh.url", &scene.bodies[i].mesh->url);
    if (scene.bodies[i].formed) urls.emplace_back(join_path("bodies", i) + ".formed.url", &scene.bodies[i].formed->url);
  }
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    if (scene.tools[i].mesh) urls.emplace_back(join_path("tools", i) + ".mesh.url", &scene.tools[i].mesh->url);
  return urls;
}

}  // namespace forming_sim
