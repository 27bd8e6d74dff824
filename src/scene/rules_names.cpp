#include <map>

#include "forming_sim/scene/topic_name.h"
#include "rules.h"

namespace forming_sim {

namespace {

/// Letters, digits, and _ - . : they head CSV columns, name groups of result.h5 and markers.
bool fits_a_file(const std::string& name) {
  return name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") == std::string::npos;
}

template <class Config> void check_names_of(const std::vector<Config>& parts, const std::string& list, FaultList& faults) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& name = parts[i].name;
    if (name.empty()) continue;
    const std::string path = join_path(join_path(list, i), "name");
    if (!fits_a_file(name)) faults.add(path, given_text(name), "give a name of letters, digits, _, - and . only");
    const auto [entry, is_new] = first.emplace(name, i);
    if (!is_new) faults.add(path, given_text(name), "give a name of its own: " + join_path(list, entry->second) + " has this one");
  }
}

/// The forces of every tool have a topic.
void check_topics(const std::vector<ToolConfig>& tools, FaultList& faults) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const std::string topic = topic_name(tools[i].name);
    const auto [entry, is_new] = first.emplace(topic, i);
    if (is_new || tools[i].name.empty() || tools[i].name == tools[entry->second].name) continue;
    faults.add(join_path(join_path("tools", i), "name"), given_text(tools[i].name),
               "give a name that is another as a topic, with _ for - and . and tool_ before a digit: the forces of tools[" + std::to_string(entry->second) + "], " + tools[entry->second].name + ", have the topic tool_forces/" + topic + " already");
  }
}

}  // namespace

void check_names(const Scene& scene, FaultList& faults) {
  check_names_of(scene.bodies, "bodies", faults);
  check_names_of(scene.tools, "tools", faults);
  check_topics(scene.tools, faults);
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      if (!scene.tools[i].name.empty() && scene.tools[i].name == scene.bodies[b].name)
        faults.add(join_path(join_path("tools", i), "name"), given_text(scene.tools[i].name), "give a name of its own: " + body_path(b) + " has this one, and contact.pairs tells them apart by their names");
  check_names_of(scene.stages, "stages", faults);
  check_names_of(scene.output.probes, "output.probes", faults);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyConfig& body = scene.bodies[i];
    check_names_of(body.sets, join_path(body_path(i), "sets"), faults);
    if (!body.blank) continue;
    const std::vector<std::string> taken = predefined_sets(*body.blank);
    for (std::size_t k = 0; k < body.sets.size(); ++k) {
      if (std::find(taken.begin(), taken.end(), body.sets[k].name) == taken.end()) continue;
      faults.add(join_path(join_path(body_path(i), "sets"), k) + ".name", given_text(body.sets[k].name),
                 "give another name: the blank has the sets " + one_of(taken, ", ") + " already");
    }
  }
}

}  // namespace forming_sim
