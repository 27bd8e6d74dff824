#include <algorithm>
#include <set>

#include "forming_sim/config/words.h"
#include "rules.h"

namespace forming_sim {
namespace {

/// A limit needs friction that it limits; method geometric, which puts nodes back one by one, knows none.
void check_limit(const ContactConfig& contact, double limit, bool rubs, const std::string& path, FaultList& faults) {
  if (!(limit > 0)) return;
  if (!rubs) faults.add(path, given_text(limit), "give friction beside it, which it limits, or leave it out");
  else if (contact.method == "geometric") faults.add(path, given_text(limit), "set contact.method to implicit or explicit: method geometric knows no limit of friction");
}

void check_pair(const Scene& scene, const PairConfig& pair, const std::string& path, FaultList& faults) {
  std::vector<std::string> bodies, all;
  for (const BodyConfig& body : scene.bodies) bodies.push_back(body.name);
  all = bodies;
  for (const ToolConfig& tool : scene.tools) all.push_back(tool.name);
  const auto knows = [](const std::vector<std::string>& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const auto look = [&](const std::string& name, const std::string& other, const char* field) {
    const bool body_asked = knows(all, other) && !knows(bodies, other);  // tools do not meet each other
    const std::vector<std::string>& names = body_asked ? bodies : all;
    if (!name.empty() && !knows(names, name))
      faults.add(path + field, given_text(name), (body_asked ? "give one of the bodies " : "give one of the bodies and tools ") + one_of(names, ", ") + did_you_mean(name, names));
  };
  look(pair.first, "", ".first");
  look(pair.second, pair.first, ".second");
  if (pair.kind == "tied" && scene.contact.method != "implicit")
    faults.add(path + ".kind", given_text(pair.kind), "set contact.method to implicit: the baselines know no ties");
  if (pair.first != pair.second || pair.first.empty()) return;
  if (pair.kind == "tied") faults.add(path + ".kind", "tied, of a body and itself", "give two different names");
  for (const BodyConfig& body : scene.bodies)
    if (body.name == pair.first && !body.self_contact && pair.kind != "none")
      faults.add(path, "a pair of " + pair.first + " and itself", "set self_contact of the body to true, or leave the pair out");
}

}  // namespace

void check_contact(const Scene& scene, FaultList& faults) {
  const ContactConfig& contact = scene.contact;
  check_limit(contact, contact.friction_limit, contact.friction > 0, "contact.friction_limit", faults);
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    check_limit(contact, scene.tools[i].friction_limit, scene.tools[i].friction > 0, join_path("tools", i) + ".friction_limit", faults);
  if (contact.method == "explicit" && contact.coefficient > 0 && contact.stiffness > 0)
    faults.add("contact.stiffness", given_text(contact.stiffness), "leave it out, or leave out coefficient: the coefficient c of the force already says how stiff the layer is");
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t i = 0; i < contact.pairs.size(); ++i) {
    const PairConfig& pair = contact.pairs[i];
    const std::string path = join_path("contact.pairs", i);
    check_pair(scene, pair, path, faults);
    if (pair.kind != "none" && pair.kind != "frictionless") check_limit(contact, pair.friction_limit, pair.kind == "sticking" || pair.friction > 0, path + ".friction_limit", faults);
    if (!seen.insert(std::minmax(pair.first, pair.second)).second)
      faults.add(path, pair.first + " and " + pair.second + " again", "give each pair once");
  }
}

}  // namespace forming_sim
