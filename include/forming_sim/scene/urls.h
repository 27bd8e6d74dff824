#pragma once
// The files that a scene names.
#include <string>
#include <utility>
#include <vector>

#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// Paths of its fields that name a file, "tools[0].mesh.url", and what stands there; in their order.
std::vector<std::pair<std::string, std::string*>> urls_of(Scene& scene);

}  // namespace forming_sim
