#pragma once
// What a scene means: two that mean the same make the same run.
#include <string>

#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// write_scene(), with the name and a hash of the content in the place of every url: wherever the files lie and however the urls
/// are spelled, what is in them is the same. The url of a file that cannot be read stays as it is.
std::string meaning_of(const Scene& scene);

}  // namespace forming_sim
