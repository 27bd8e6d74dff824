// What a run tells of itself in the warnings of its summary.
#include <gtest/gtest.h>

#include "forming_sim/config/words.h"
#include "results/run_files_tools.h"

namespace forming_sim {
namespace {

using nlohmann::json;

TEST(RunWarnings, TellsToolsThatTouchedNothing) {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  ToolConfig idle;
  idle.name = "idle";
  idle.normal = Vec3(0, 1, 0);
  idle.point = Vec3(0, -1, 0);
  scene.tools.push_back(idle);
  const Outcome outcome = run_scene(scene, directory.path(), 1, "", kNever);
  ASSERT_TRUE(outcome.code == Code::success || outcome.code == Code::limit_reached) << outcome.message;
  int told = 0;
  const json summary = read_json(directory.file("summary.json"));
  for (const json& warning : summary["warnings"])
    if (warning.get<std::string>().find("has touched nothing") != std::string::npos) {
      ++told;
      EXPECT_NE(warning.get<std::string>().find("tool idle "), std::string::npos) << warning;
    }
  EXPECT_EQ(told, 1);
}

/// The warnings of a scene's run that hold the words.
std::vector<std::string> warnings_with(const std::string& words, const std::string& scene_text) {
  const TemporaryDirectory directory;
  std::vector<Fault> faults;
  const Scene scene = read_scene(scene_text, ".", faults);
  EXPECT_TRUE(faults.empty());
  const Outcome outcome = run_scene(scene, directory.path(), 1, "", kNever);
  EXPECT_EQ(outcome.code, Code::success) << outcome.message;
  std::vector<std::string> found;
  const json summary = read_json(directory.file("summary.json"));
  for (const json& warning : summary["warnings"])
    if (warning.get<std::string>().find(words) != std::string::npos) found.push_back(warning);
  return found;
}

/// Warnings that hold the words, of a strip shut in between symmetries whose top goes down by this part of its height.
long told_of_a_press(double part, const std::string& words) {
  const std::string text = R"(
name: press
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, length: 0.001, thickness: 0.001, cells_along: 2, cells_through: 2}
    material: {density: 2700, youngs_modulus: 70e9, poissons_ratio: 0.3, hardening: {curve: perfect, yield_stress: 50e6}}
    boundaries:
      - {set: left, kind: symmetric, normal: [1, 0]}
      - {set: right, kind: symmetric, normal: [1, 0]}
      - {set: bottom, kind: symmetric, normal: [0, 1]}
      - {set: top, kind: velocity, axes: [y], times: [0, 2e-5], velocities: [[0, )" + number_text(-part * 50) + "], [0, " + number_text(-part * 50) + R"(]]}
stages:
  - {name: press, kind: form, duration: 2e-5}
)";
  return static_cast<long>(warnings_with(words, text).size());
}

TEST(RunWarnings, TellsMetalThatIsPressedAsItNeverIs) {
  EXPECT_EQ(told_of_a_press(.15, "% of its bulk modulus, in element"), 1);
  EXPECT_EQ(told_of_a_press(.05, "% of its bulk modulus, in element"), 0);
}

// A C whose upper arm is driven into the lower one.
TEST(RunWarnings, TellsABodyThatPassesThroughItself) {
  const std::string text = R"(
name: c
dimension: 2
bodies:
  - name: c
    mesh:
      unit_scale: 0.001
      cell_type: quadrilateral
      points: [[0,0],[1,0],[2,0],[3,0], [0,1],[1,1],[2,1],[3,1], [0,2],[1,2],[2,2],[3,2], [0,3],[1,3],[2,3],[3,3]]
      cells: [0,1,5,4, 1,2,6,5, 2,3,7,6, 4,5,9,8, 8,9,13,12, 9,10,14,13, 10,11,15,14]
    material: {density: 1000, law: hyperelastic, h1: 1e6, bulk_modulus: 1e7}
    sets:
      - {name: foot, choose: plane, point: [0, 0], normal: [0, 1]}
      - {name: lip, choose: box, min: [0.0029, 0.0019], max: [0.0031, 0.0031]}
    boundaries:
      - {set: foot, kind: fixed}
      - {set: lip, kind: velocity, axes: [y], times: [0, 1e-3, 2e-3], velocities: [[0, 0], [0, -1.6], [0, 0]]}
tools:
  - {name: table, point: [0, -0.001], normal: [0, 1]}
stages:
  - {kind: form, duration: 2e-3}
)";
  const std::vector<std::string> told = warnings_with("passes through itself", text);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("body c lies in itself"), 0u) << told[0];
  std::string meets = text;
  meets.replace(meets.find("    sets:"), 0, "    self_contact: true\n");
  meets.replace(meets.find("-1.6]"), 5, "-1.2]");  // as far as there is room for both
  EXPECT_TRUE(warnings_with("passes through itself", meets).empty());
}

TEST(RunWarnings, TellsThatInertiaTakesPart) {
  const auto pressed = [](double speed) {
    const std::string time = number_text(4e-4 / speed);
    return R"(
name: press
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, length: 0.001, thickness: 0.001, cells_along: 4, cells_through: 4}
    material: {density: 2700, youngs_modulus: 70e9, poissons_ratio: 0.3, hardening: {curve: perfect, yield_stress: 50e6}}
tools:
  - {name: table, point: [0, 0], normal: [0, 1]}
  - {name: press, point: [0, 0.001], normal: [0, -1], motion: {kind: trajectory, profile: linear, times: [0, )" + time + R"(], positions: [[0, 0], [0, -0.0004]]}}
stages:
  - {name: press, kind: form, duration: )" + time + "}\n";
  };
  EXPECT_EQ(warnings_with("inertia takes part", pressed(200)).size(), 1u);
  EXPECT_TRUE(warnings_with("inertia takes part", pressed(20)).empty());
}

// The strip is pulled out from under the holder.
TEST(RunWarnings, TellsAHolderThatHasLostWhatItPressed) {
  const auto held = [](double way) {
    return R"(
name: hold
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, length: 0.01, thickness: 0.001, cells_along: 20, cells_through: 2}
    material: {density: 2700, youngs_modulus: 70e9, poissons_ratio: 0.3}
    boundaries: [{set: left, kind: velocity, axes: [x], times: [0, 2e-4, 4e-4], velocities: [[0, 0], [)" + number_text(-way / 2e-4) + R"(, 0], [0, 0]]}]
tools:
  - {name: table, point: [0, 0], normal: [0, 1]}
  - name: holder
    profile: {start: [0.006, 0.003], pieces: [{to: [0.006, 0.001]}, {to: [0.009, 0.001]}, {to: [0.009, 0.003]}]}
    motion: {kind: force, times: [0, 5e-5], forces: [[0, 0], [0, -1e4]], mass: 0.02}
stages:
  - {kind: form, duration: 6e-4}
)";
  };
  const std::vector<std::string> told = warnings_with("pressed on the bodies no more", held(6e-3));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("tool holder, which a force drives"), 0u) << told[0];
  EXPECT_TRUE(warnings_with("pressed on the bodies no more", held(1e-3)).empty());
}

TEST(RunWarnings, TellsThatTwoTrianglesACellLock) {
  const auto sheet = [](const std::string& pattern) {
    return R"(
name: sheet
dimension: 2
bodies:
  - name: sheet
    blank: {shape: strip, length: 0.01, thickness: 0.001, cells_along: 20, cells_through: 2, pattern: )" + pattern + R"(}
    material: {density: 2700, youngs_modulus: 70e9, poissons_ratio: 0.3}
stages:
  - {kind: form, duration: 1e-6}
)";
  };
  EXPECT_EQ(warnings_with("lock in bending", sheet("coarse")).size(), 1u);
  EXPECT_TRUE(warnings_with("lock in bending", sheet("fine")).empty());
}

/// A strip that is drawn from between a tool and a holder of this mass, kg/m; its own is .314.
std::string drawn_strip(const std::string& mass) {
  const auto tool = [](const std::string& name, int side) {
    const auto at = [&](const char* x, double y) { return std::string("[") + x + ", " + std::to_string(side * y) + "]"; };
    const std::string from = side < 0 ? "1" : "-1", to = side < 0 ? "-1" : "1";
    return "  - name: " + name + "\n    friction: 0.12\n    profile: {start: " + at((from + "e-2").c_str(), .005) + ", pieces: [{to: " + at((from + "e-2").c_str(), .001) +
           "}, {to: " + at((from + "e-2").c_str(), 0) + "}, {to: " + at((to + "e-2").c_str(), 0) + "}, {to: " + at((to + "e-2").c_str(), .005) + "}]}\n";
  };
  return R"(
name: drawn
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, origin: [-0.02, 0], length: 0.04, thickness: 0.001, cells_along: 40, cells_through: 2, pattern: one_point}
    material: {density: 7850, youngs_modulus: 210e9, poissons_ratio: 0.3}
    boundaries: [{set: right, kind: velocity, axes: [x], times: [0, 4e-4, 8e-4], velocities: [[0, 0], [0, 0], [2, 0]], profile: smooth}]
tools:
)" + tool("table", -1) + tool("holder", 1) +
         "    position: [0, 0.001]\n    motion: {kind: force, times: [0, 3e-4], forces: [[0, 0], [0, -5e4]], mass: " + mass + "}\nstages: [{kind: form, duration: 1.2e-3}]\n";
}

TEST(RunWarnings, TellsThatAHolderSwingsOnWhatSlides) {
  const std::vector<std::string> told = warnings_with("had lifted off the bodies and come back", drawn_strip("8"));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("tool holder, which a force drives, "), 0u) << told[0];
  EXPECT_NE(told[0].find("25.5 times the mass of the bodies"), std::string::npos) << told[0];
  EXPECT_TRUE(warnings_with("had lifted off the bodies", drawn_strip("1")).empty());
  EXPECT_TRUE(warnings_with("had lifted off the bodies", drawn_strip("8, damping: 4e5")).empty());
}

// What stands on a table with nodes that are held bears on these.
TEST(RunWarnings, AToolThatTouchesFromTheStartIsNotIdle) {
  EXPECT_TRUE(warnings_with("has touched nothing", R"(
name: held
dimension: 2
bodies:
  - name: block
    blank: {shape: strip, length: 0.004, thickness: 0.004, cells_along: 2, cells_through: 2}
    material: {density: 2710, youngs_modulus: 70.5e9, poissons_ratio: 0.34}
    boundaries: [{set: bottom, kind: fixed}]
tools:
  - {name: table, normal: [0, 1]}
stages: [{kind: form, duration: 1e-5}]
)").empty());
}

/// Warnings of what a settle stage that ends early cuts off; its limit is 4 ms.
std::vector<std::string> told_unfinished(const std::string& ends) {
  const std::string text = R"(
name: cut_off
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, length: 0.004, thickness: 0.001, cells_along: 4, cells_through: 1}
    material: {density: 2700, youngs_modulus: 70e9, poissons_ratio: 0.3}
    boundaries:
      - {set: left, kind: fixed}
      - {set: right, kind: velocity, axes: [y], times: [4.1e-3, 4.3e-3], velocities: [[0, 0], [0, 0.1]], until: open}
    pressures: [{set: top, times: [4.1e-3, 4.3e-3], values: [0, 1e5]}]
    loads: [{set: top, kind: force, times: [4.1e-3, 4.3e-3], forces: [[0, 0], [100, 0]]}]
tools:
  - {name: early, point: [0, 0.01], normal: [0, -1], motion: {kind: trajectory, times: [0, 1e-4], positions: [[0, 0], [0, -0.001]]}}
  - {name: late, point: [0, 0.01], normal: [0, -1], motion: {kind: trajectory, times: [4.1e-3, 4.3e-3], positions: [[0, 0], [0, -0.001]]}}
  - {name: after, point: [0, 0.01], normal: [0, -1], motion: {kind: trajectory, since: second, times: [0, 3e-4], positions: [[0, 0], [0, -0.001]]}}
  - {name: on, point: [0, 0.01], normal: [0, -1], motion: {kind: trajectory, times: [4.1e-3, 9e-3], positions: [[0, 0], [0, -0.001]]}}
stages:
  - {kind: form, duration: 1e-4}
  - {kind: settle, limit: 4e-3, ends: )" + ends + R"(}
  - {name: second, kind: form, duration: 3e-4}
  - {name: open, kind: withdraw, duration: 1e-5}
)";
  return warnings_with("count from the start of the run", text);
}

TEST(RunWarnings, TellsWhatAnEarlyRestCutOff) {
  const std::vector<std::string> told = told_unfinished("rest"), starts{"the motion of tool late ", "the motion of set right of body strip ", "the pressure on set top of body strip ", "the load on set top of body strip "};
  ASSERT_EQ(told.size(), starts.size());
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i].find(starts[i]), 0u) << told[i];
  EXPECT_NE(told[0].find("stage open, which ends it, began at "), std::string::npos) << told[0];
  EXPECT_NE(told[2].find("the run ended at "), std::string::npos) << told[2];
  EXPECT_TRUE(told_unfinished("limit").empty());
}

}  // namespace
}  // namespace forming_sim
