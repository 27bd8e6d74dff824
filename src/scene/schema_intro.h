#pragma once
// The prose of docs/scene.md.
#include <string>

namespace forming_sim {

std::string schema_intro();
std::string small_example_words();
std::string flange_example_words();
std::string fields_words();

}  // namespace forming_sim
