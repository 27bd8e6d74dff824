#pragma once
// A strip that a punch presses on a plane: every file of a run in a fraction of a second.
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "forming_sim/results/text_file.h"
#include "forming_sim/scene/yaml.h"
#include "results/example_run.h"

namespace forming_sim {

inline Scene small_scene() {
  const std::string text = R"(
name: small
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, length: 0.01, thickness: 0.002, cells_along: 10, cells_through: 2}
    material:
      density: 2700
      youngs_modulus: 70e9
      poissons_ratio: 0.33
      hardening: {curve: perfect, yield_stress: 50e6}
      damage: {critical: 1e-4}
    boundaries:
      - {set: left, kind: fixed}
tools:
  - name: punch
    profile:
      start: [8e-3, 8e-3, 0]
      pieces:
        - to: [8e-3, 3e-3, 0]
        - {to: [9e-3, 2e-3, 0], radius: 1e-3}
        - to: [12e-3, 2e-3, 0]
    motion: {kind: trajectory, times: [0, 2e-4], positions: [[0, 0, 0], [0, -4e-4, 0]]}
stages:
  - {kind: form, duration: 2e-4}
  - {kind: withdraw, duration: 2e-5, displacement: [0, 1e-3, 0]}
  - {kind: settle, limit: 4e-5}
output:
  interval: 2e-5
  checkpoint_interval: 3e-5
  probes:
    - {name: root, point: [0, 1e-3, 0]}
    - {name: tip, point: [0.01, 1e-3, 0]}
    - {name: all, set: top}
  springback: {from: root, to: tip}
)";
  std::vector<Fault> faults;
  Scene scene = read_scene(text, ".", faults);
  if (!faults.empty()) throw SceneError(faults);
  return scene;
}

inline nlohmann::json read_json(const std::string& path) { return nlohmann::json::parse(read_text(path)); }

}  // namespace forming_sim
