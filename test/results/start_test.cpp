// Whatever the numbers of a scene are, it is refused with a reason or starts, and its steps end with a named error if not well.
#include "forming_sim/results/start.h"
#include "forming_sim/config/words.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>

#include "forming_sim/scene/yaml.h"

namespace forming_sim {
namespace {

const char* const kSection = R"(
name: section
dimension: 2
gravity: [0.1, -9.81]
bodies:
  - name: strip
    blank: {shape: strip, length: 0.01, thickness: 0.001, cells_along: 6, cells_through: 2}
    material: {density: 2710, youngs_modulus: 70.5e9, poissons_ratio: 0.34, hardening: {curve: voce, yield_stress: 192.1e6, saturation_stress: 400e6, rate: 8}}
    boundaries: [{set: left, kind: velocity, times: [0, 1e-5], velocities: [[0, 0], [0.1, 0]], spins_deg_s: [[0, 0, 0], [0, 0, 10]], centre: [0, 0.001]}]
    pressures: [{set: right, times: [0, 1e-5], values: [0, 1e5]}]
    sets: [{name: middle, choose: box, min: [0.002, -1], max: [0.008, 1]}]
tools:
  - {name: press, point: [0, 0.0011], normal: [0, -1], friction: 0.1, motion: {kind: velocity, times: [0, 5e-6], velocities: [[0, 0], [0, -5]]}}
  - name: roll
    profile: {start: [-0.001, 0.002], pieces: [{to: [0.001, 0.002], radius: 0.001}], closed: true}
    position: [0.005, 0.002]
    rotation_deg: [0, 0, 5]
    motion: {kind: trajectory, times: [0, 1e-5], positions: [[0, 0], [0, 0.0001]], rotations_deg: [[0, 0, 0], [0, 0, 3]]}
stages:
  - {kind: form, duration: 2e-5}
  - {kind: settle, limit: 2e-5, kinetic_fraction: 1e-3}
time_step: {safety: 0.5, maximum: 1e-7, damping: 10, mass_scaling: 2, raise_to: 1e-9, linear_viscosity: 0.06}
output: {interval: 1e-6, history_interval: 1e-7, probes: [{name: tip, point: [0.01, 0.001]}, {name: root, set: middle}], springback: {from: root, to: tip}}
)";

const char* const kSolid = R"(
name: solid
dimension: 3
bodies:
  - name: plate
    blank: {shape: plate, origin: [0, 0, 0], length: 0.01, width: 0.01, thickness: 0.001, cells_along: 2, cells_across: 2, cells_through: 1}
    material: {density: 2710, youngs_modulus: 70.5e9, poissons_ratio: 0.34, layers: [{weight: 0.5, hardening: {curve: table, plastic_strains: [0, 0.1], stresses: [1e8, 2e8]}}, {weight: 0.5}]}
    boundaries: [{set: bottom, kind: symmetric, normal: [0, 0, 1]}]
    initial_velocity: [0, 0, 0.1]
    initial_spin_deg_s: [0, 0, 10]
    spin_centre: [0.005, 0.005, 0]
  - name: rubber
    blank: {shape: plate, origin: [0.02, 0, 0], length: 0.01, width: 0.01, thickness: 0.001, cells_along: 2, cells_across: 2, cells_through: 1}
    material: {density: 1100, law: hyperelastic, h1: 1e6, h2: 1e5, bulk_modulus: 1e9}
tools:
  - name: holder
    mesh: {unit_scale: 0.001, points: [[-1, -1, 0], [31, -1, 0], [31, 11, 0], [-1, 11, 0]], cells: [0, 2, 1, 0, 3, 2], cell_type: triangle}
    position: [0, 0, 0.00101]
    motion: {kind: force, times: [0, 1e-5], forces: [[0, 0, 0], [0, 0, -1000]], mass: 0.001, damping: 2.5, initial_velocity: [0, 0, -0.5]}
contact: {layer: 1e-6, stiffness: 1e10, push_speed: 0.1, friction: 0.1, max_sweeps: 50, max_halvings: 20}
stages:
  - {kind: form, duration: 5e-6}
  - {kind: withdraw, duration: 1e-6, displacement: [0, 0, 0.001]}
)";

void start_and_step(const std::string& text, int& started) {
  std::vector<Fault> faults;
  const Scene scene = read_scene(text, ".", faults);
  StartCheck start = check_start(scene, faults, 1);
  for (const Fault& fault : start.faults) EXPECT_NE(fault.code, Code::internal_error) << fault.sentence();
  if (!start.simulation) {
    EXPECT_FALSE(start.faults.empty());
    return;
  }
  ++started;
  try {
    for (int k = 0; k < 5 && start.simulation->step(); ++k) {}
    EXPECT_TRUE(std::isfinite(start.simulation->energies().kinetic));
  } catch (const Error& error) {
    EXPECT_NE(error.code(), Code::internal_error) << error.what();
  }
}

class AbsurdNumbers : public testing::TestWithParam<const char*> {};

TEST_P(AbsurdNumbers, AreRefusedOrEndWithANamedError) {
  const std::string text = GetParam();
  int started = 0, tried = 0;
  start_and_step(text, started);
  ASSERT_EQ(started, 1) << "the scene itself";
  const std::regex number(R"([ \[]([-+]?[0-9]+\.?[0-9]*(e[-+]?[0-9]+)?)(?=[,\]}\n]))");
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) {
    for (const char* absurd : {"1e308", "-1e308", "1e90", "-1e90", "1e20", "1e-300", "0", "-1", "nan"}) {
      std::string changed = text;
      changed.replace(at->position(1), at->length(1), absurd);
      SCOPED_TRACE(changed.substr(changed.rfind('\n', at->position(1)) + 1, 300));
      start_and_step(changed, started);
      ++tried;
    }
  }
  EXPECT_GT(tried, 500);
  EXPECT_GT(started, 50);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AbsurdNumbers, testing::Values(kSection, kSolid));

std::string ring(const std::string& name, double inner, double outer) {
  constexpr int n = 12;
  std::string points, cells;
  for (int i = 0; i < n; ++i) {
    const double c = std::cos(2 * M_PI * i / n), s = std::sin(2 * M_PI * i / n);
    for (double r : {inner, outer}) points += "[" + number_text(r * c) + ", " + number_text(r * s) + "], ";
    const int next = (i + 1) % n;
    for (int corner : {2 * i, 2 * i + 1, 2 * next + 1, 2 * next}) cells += std::to_string(corner) + ", ";
  }
  return "  - {name: " + name + ", mesh: {unit_scale: 1, points: [" + points + "], cells: [" + cells + "], cell_type: quadrilateral}, material: {density: 7850, youngs_modulus: 2e11, poissons_ratio: 0.3}}\n";
}

// What lies in the hole of a body is not in the body; in its metal it is.
TEST(StartCheck, ABodyMayLieInTheHoleOfAnother) {
  const auto faults = [](double outer) {
    std::vector<Fault> found;
    const Scene scene = read_scene("name: rings\ndimension: 2\nbodies:\n" + ring("outside", 5e-3, 8e-3) + ring("inside", 1e-3, outer) + "stages:\n  - {kind: form, duration: 1e-6}\n", ".", found);
    return check_start(scene, found, 1).faults.size();
  };
  EXPECT_EQ(faults(4e-3), 0u);
  EXPECT_EQ(faults(6e-3), 1u);
}

}  // namespace
}  // namespace forming_sim
