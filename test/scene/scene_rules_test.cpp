// What the fields of a scene say of each other.
#include "forming_sim/scene/build.h"
#include "forming_sim/scene/validate.h"

#include <limits>

#include "scene/scene_texts.h"

namespace forming_sim {
namespace {

/// The flange with one change, and the one fault that it makes.
void expect_flange_fault(const std::string& from, const std::string& to, const std::string& field, const std::string& word) {
  expect_fault(replaced(flange_example(), from, to), field, word);
}

TEST(SceneRules, NamesAreThereOnce) {
  expect_flange_fault("name: holder", "name: die", "tools[1].name", "tools[0] has this one");
  expect_flange_fault("name: release", "name: flanging", "stages[1].name", "stages[0]");
  expect_flange_fault("{name: leg, body", "{name: leg_far, body", "output.probes[2].name", "output.probes[1]");
  expect_fault(replaced(replaced(flange_example(), "{name: leg, choose", "{name: top, choose"), "set: leg}", "set: top}"),
               "bodies[0].sets[0].name", "the blank has the sets left, right, bottom, top");
  expect_flange_fault("name: punch", "name: upper/punch", "tools[2].name", "letters");
}

TEST(SceneRules, BodiesHaveOneSource) {
  const std::string text = minimal_example();
  expect_fault(replaced(text, "    material:", "    mesh: {url: a.msh, unit_scale: 1}\n    material:"), "bodies[0]", "blank and mesh");
  Scene scene = scene_of(text);
  scene.bodies[0].blank.reset();
  const auto faults = check_scene(scene);
  EXPECT_TRUE(fault_at(faults, "bodies[0]")) << sentences(faults);
}

TEST(SceneRules, OptionsOfAnotherContactMethodAreRefused) {
  const auto with = [](const std::string& contact) { return replaced(flange_example(), "tools:\n", "contact: {" + contact + "}\ntools:\n"); };
  expect_fault(with("exponent: 2"), "contact.exponent", "where method is explicit");
  expect_fault(with("method: geometric, pairing: node_node"), "contact.pairing", "where method is explicit");
  expect_fault(with("method: geometric, stiffness: 1e9"), "contact.stiffness", "where method is implicit or explicit");
  expect_fault(with("method: explicit, max_halvings: 7"), "contact.max_halvings", "where method is implicit");
  expect_fault(with("method: explicit, exponent: 4"), "contact.exponent", "at most 3");
  expect_fault(with("method: penalty"), "contact.method", "implicit, explicit or geometric");
  expect_fault(with("method: explicit, stiffness: 1e9, coefficient: 7e7"), "contact.stiffness", "leave out coefficient");
  expect_fault(with("friction_limit: 1e7"), "contact.friction_limit", "give friction beside it");
  expect_fault(with("friction: .1, friction_limit: 1e7, method: geometric"), "contact.friction_limit", "implicit or explicit");
}

TEST(SceneRules, APairHasABody) {
  const auto with = [](const std::string& pair) { return replaced(flange_example(), "tools:\n", "contact: {pairs: [{" + pair + "}]}\ntools:\n"); };
  const std::string body = scene_of(flange_example()).bodies[0].name;
  for (const std::string& pair : {"first: " + body + ", second: die", "first: die, second: " + body}) {
    const RunPlan plan = build_plan(scene_of(with(pair)));
    EXPECT_EQ(plan.contact.pairs[0].first, body) << pair;
    EXPECT_EQ(plan.contact.pairs[0].second, "die") << pair;
  }
  expect_fault(with("first: die, second: punch"), "contact.pairs[0].second", "give one of the bodies " + body);
  expect_fault(with("first: dye, second: " + body), "contact.pairs[0].first", "did you mean die?");
  expect_fault(with("first: " + body + ", second: punsh"), "contact.pairs[0].second", "did you mean punch?");
}

TEST(SceneRules, ToolsHaveOneSource) {
  expect_flange_fault("  - name: die\n", "  - name: die\n    normal: [0, 1]\n", "tools[0]", "profile and normal");
  expect_flange_fault("tools:\n", "tools:\n  - name: nothing\n", "tools[0]", "none of mesh");
  expect_flange_fault("tools:\n", "tools:\n  - {name: table, normal: [0, 1, 0.1]}\n", "tools[0].normal", "z = 0");
  expect_flange_fault("  - name: die\n", "  - name: die\n    point: [0, 1]\n", "tools[0].point", "rigid plane");
}

TEST(SceneRules, WhatTurnsFreely) {
  const auto with = [](const std::string& motion) {
    return minimal_example() + "tools:\n  - {name: roll, profile: {start: [0, 0.003], pieces: [{to: [0, 0.005], radius: 0.001}, {to: [0, 0.003], radius: 0.001}]}, motion: {" + motion + "}}\n";
  };
  const std::string here = "tools[0].motion", stands = "kind: velocity, times: [0], ", idle = stands + "axle: [0, 0, 2], ";
  EXPECT_TRUE(faults_of(with(idle + "torques: [3], inertia: 1, initial_spin_deg_s: 5, spin_damping: 3")).empty()) << sentences(faults_of(with(idle + "torques: [3], inertia: 1, initial_spin_deg_s: 5, spin_damping: 3")));
  expect_fault(with(idle + "damping: 3"), here + ".damping", "force");
  expect_fault(with(stands + "profile: linear"), here, "or an axle");
  for (const char* field : {"torques", "inertia", "initial_spin_deg_s", "spin_damping"})
    expect_fault(with(stands + "velocities: [[1, 0]], " + field + ": " + (field == std::string("torques") ? "[1]" : "1")), here + "." + field, "give the axle");
  expect_fault(with("kind: force, times: [0], forces: [[0, -1]], axle: [0, 0]"), here + ".axle", "of a length above 0");
  expect_fault(with(stands + "axle: [0, 1, 1]"), here + ".axle", "give [0, 0, 1]");
  expect_fault(with(idle + "spins_deg_s: [[0, 0, 3]]"), here + ".spins_deg_s[0]", "leave out the axle");
  expect_fault(with("kind: velocity, times: [0, 1], axle: [0, 0, 2], spins_deg_s: [[0, 0, 0], [0, 0, 5]]"), here + ".spins_deg_s[1]", "leave out the axle");
  expect_fault(with(idle + "torques: [1, 2]"), here + ".torques", "one for each of the 1 times");
  expect_fault(with(idle + "stop_force: 3"), here + ".stop_force", "leave it out");
  expect_fault(with("kind: trajectory, times: [0, 1], positions: [[0, 0], [1, 0]], profile: spline, axle: [0, 0, 1], torques: [0, 1]"), here + ".profile", "smooth or linear");
  expect_fault(replaced(with(idle + "inertia: 1"), "tools:", "contact: {method: explicit}\ntools:"), here + ".axle", "set contact.method to implicit");
  expect_fault(replaced(with(idle + "inertia: 1"), "dimension: 2", "dimension: 2\naxisymmetric: true"), here + ".axle", "no ring");
}

TEST(SceneRules, DimensionDecidesTheKinds) {
  expect_flange_fault("tools:\n", "tools:\n  - {name: t, mesh: {url: t.stl, unit_scale: 0.001}}\n", "tools[0].mesh", "dimension");
  const auto faults = faults_of(replaced(flange_example(), "dimension: 2", "dimension: 3"));
  EXPECT_TRUE(fault_at(faults, "bodies[0].blank.shape")) << sentences(faults);
  for (const char* field : {"tools[0].profile.sweep", "tools[1].profile.sweep", "tools[2].profile.sweep"}) EXPECT_TRUE(fault_at(faults, field)) << field;
  EXPECT_EQ(faults.size(), 4u) << sentences(faults);
  const std::string start = "      start: [0, -0.03]\n";
  expect_flange_fault(start, "      sweep: turned\n" + start, "tools[0].profile.sweep", "in dimension 2 a profile is all of the tool");
  expect_flange_fault(start, "      width: 0.1\n" + start, "tools[0].profile.width", "sweep");
  expect_fault(replaced(minimal_example(), "dimension: 2", "dimension: 4"), "dimension", "at least 2 and at most 3");
}

TEST(SceneRules, ASectionStaysInThePlane) {
  expect_flange_fault("dimension: 2", "dimension: 2\ngravity: [0, 0, -9.81]", "gravity", "z = 0");
  expect_flange_fault("[0, -0.020]", "[0, -0.020, 0.001]", "tools[2].motion.positions[1]", "z = 0");
  expect_flange_fault("positions:", "rotations_deg: [[0, 0, 0], [3, 0, 0]]\n      positions:", "tools[2].motion.rotations_deg[1]", "about z");
  EXPECT_TRUE(faults_of(replaced(flange_example(), "positions:", "rotations_deg: [[0, 0, 0], [0, 0, 3]]\n      positions:")).empty());
  expect_flange_fault("kind: fixed", "kind: fixed, axes: [x, z]", "bodies[0].boundaries[0].axes", "leave z out");
  EXPECT_TRUE(faults_of(replaced(flange_example(), "max: [1, 1]", "max: [1, 1, 1]")).empty()) << "z of a box is ignored";
}

/// The flange as a section that is turned, which it can be: what goes along the axis stays right.
TEST(SceneRules, AnAxisymmetricSceneGoesAlongItsAxis) {
  const std::string turned = replaced(flange_example(), "dimension: 2", "dimension: 2\naxisymmetric: true");
  EXPECT_TRUE(faults_of(turned).empty()) << sentences(faults_of(turned));
  const auto with = [&](const std::string& from, const std::string& to) { return replaced(turned, from, to); };
  expect_fault(with("axisymmetric: true", "axisymmetric: true\ngravity: [9.81, 0]"), "gravity", "[0, y, 0]");
  expect_fault(with("    blank:", "    initial_velocity: [1, 2]\n    blank:"), "bodies[0].initial_velocity", "along the axis");
  expect_fault(with("    blank:", "    initial_spin_deg_s: [0, 0, 1]\n    blank:"), "bodies[0].initial_spin_deg_s", "leave it out");
  expect_fault(with("    blank:", "    initial_spin_deg_s: [0, 1, 0]\n    blank:"), "bodies[0].initial_spin_deg_s", "what spins takes dimension 3");
  expect_fault(with("{set: left, kind: fixed}", "{set: left, kind: velocity, times: [0], spins_deg_s: [[0, 0, 1]]}"), "bodies[0].boundaries[0].spins_deg_s[0]", "no ring");
  expect_fault(with("[0, -0.020]", "[0.001, -0.020]"), "tools[2].motion.positions[1]", "along the axis y only");
  expect_fault(with("positions:", "rotations_deg: [[0, 0, 0], [0, 0, 3]]\n      positions:"), "tools[2].motion.rotations_deg[1]", "no ring");
  expect_fault(replaced(with("kind: trajectory", "kind: force"), "positions: [[0, 0], [0, -0.020]]", "forces: [[0, 0], [1, -2]]"), "tools[2].motion.forces[1]", "along the axis y only");
  expect_fault(replaced(with("kind: trajectory", "kind: force"), "positions: [[0, 0], [0, -0.020]]", "initial_velocity: [-3, 0]\n      forces: [[0, 0], [0, 0]]"),
               "tools[2].motion.initial_velocity", "along the axis y only");
  expect_fault(with("tools:\n", "contact: {method: geometric}\ntools:\n"), "contact.method", "implicit or explicit");
  EXPECT_TRUE(faults_of(with("axisymmetric: true", "axisymmetric: true\ngravity: [0, 9.81]")).empty());
  Scene scene = scene_of(turned);
  scene.dimension = 3;
  const auto solid = check_scene(scene);
  EXPECT_TRUE(fault_at(solid, "axisymmetric")) << sentences(solid);
}

// The flange's sheet and tools reach to x < 0.
TEST(SceneRules, ATurnedSectionLiesBesideItsAxis) {
  Scene scene = scene_of(flange_example());
  EXPECT_TRUE(validate(scene).empty());
  scene.axisymmetric = true;
  const auto faults = validate(scene);
  const Fault *sheet = fault_at(faults, "bodies[0].blank"), *die = fault_at(faults, "tools[0].profile");
  ASSERT_TRUE(sheet && die) << sentences(faults);
  EXPECT_NE(sheet->sentence().find("lies at x >= 0"), std::string::npos) << sheet->sentence();
  EXPECT_NE(die->sentence().find("beyond the axis"), std::string::npos) << die->sentence();
  scene.bodies[0].blank->origin.x() = 0;
  EXPECT_FALSE(fault_at(validate(scene), "bodies[0].blank"));
}

TEST(SceneRules, Meshes) {
  const std::string text = replaced(minimal_example(), "    boundaries:", "    # boundaries:");
  const std::size_t from = text.find("    blank:"), to = text.find("    material:");
  const auto with = [&](const std::string& mesh) {
    std::string scene = text.substr(0, from) + "    mesh: {" + mesh + "}\n" + text.substr(to);
    return scene.substr(0, scene.find("    # boundaries")) + scene.substr(scene.find("stages:"));
  };
  const std::string points = "unit_scale: 1, points: [[0, 0], [1, 0], [0, 1], [1, 1]], ";
  EXPECT_TRUE(faults_of(with(points + "cells: [0, 1, 2, 1, 3, 2], cell_type: triangle")).empty());
  expect_fault(with("unit_scale: 1"), "bodies[0].mesh", "neither url nor points");
  expect_fault(with(points + "url: a.msh"), "bodies[0].mesh", "both url and points");
  expect_fault(with("url: a.stl, unit_scale: 1"), "bodies[0].mesh.url", ".msh");
  expect_fault(with("url: a.msh"), "bodies[0].mesh.unit_scale", "metres per unit");
  expect_fault(with("url: a.msh, unit_scale: 1, cell_type: triangle"), "bodies[0].mesh.cell_type", "inline points");
  expect_fault(with(points + "cells: [0, 1, 2, 1], cell_type: triangle"), "bodies[0].mesh.cells", "3 for each triangle");
  expect_fault(with(points + "cells: [0, 1, 4], cell_type: triangle"), "bodies[0].mesh.cells[2]", "from 0 to 3");
  expect_fault(with(points + "cells: [0, 1, -1], cell_type: triangle"), "bodies[0].mesh.cells[2]", "at least 0");
  expect_fault(with(points + "cells: [0, 1, 2, 3], cell_type: tetrahedron"), "bodies[0].mesh.cell_type", "triangle or quadrilateral");
  expect_fault(with(points + "cell_type: triangle"), "bodies[0].mesh.cells", "corner indices");
}

TEST(SceneRules, VelocitiesFromFormulas) {
  const auto with = [](const std::string& field) { return replaced(minimal_example(), "    material:", "    initial_velocity_field: [" + field + "]\n    material:"); };
  EXPECT_TRUE(faults_of(with("\"sin(pi*x/0.02)\", \"0\"")).empty());
  expect_fault(with("\"x\""), "bodies[0].initial_velocity_field", "give 2, one for each coordinate");
  expect_fault(with("\"x\", \"2*sin(y\""), "bodies[0].initial_velocity_field[1]", "'2*sin(y' is none");
  expect_fault(with("\"x = 5\", \"0\""), "bodies[0].initial_velocity_field[0]", "it changes x, y or z");
}

TEST(SceneRules, OnePointCells) {
  const std::string text = replaced(minimal_example(), "cells_through: 2", "cells_through: 2\n      pattern: one_point");
  EXPECT_TRUE(faults_of(text).empty());
  expect_fault(replaced(text, "    material:", "    pressure_average: node\n    material:"), "bodies[0].pressure_average", "pressure of its own");
  EXPECT_TRUE(faults_of(replaced(text, "dimension: 2", "dimension: 2\naxisymmetric: true")).empty());
}

TEST(SceneRules, HardeningDoesNotSoften) {
  expect_flange_fault("saturation_stress: 429.8e6", "saturation_stress: 100e6", "bodies[0].material.hardening.saturation_stress", "soften");
  const auto table = [](const std::string& rows) { return replaced(minimal_example(), "{curve: linear, yield_stress: 150e6, modulus: 500e6}", "{curve: table, " + rows + "}"); };
  EXPECT_TRUE(faults_of(table("plastic_strains: [0, 0.1], stresses: [1e8, 1e8]")).empty());
  const std::string path = "bodies[0].material.hardening.";
  expect_fault(table("plastic_strains: [0.01, 0.1], stresses: [1e8, 2e8]"), path + "plastic_strains", "start at plastic strain 0");
  expect_fault(table("plastic_strains: [0, 0.1, 0.1], stresses: [1e8, 2e8, 3e8]"), path + "plastic_strains", "strictly increasing");
  expect_fault(table("plastic_strains: [0, 0.1], stresses: [2e8, 1e8]"), path + "stresses", "1e+08 after 2e+08");
  expect_fault(table("plastic_strains: [0, 0.1], stresses: [1e8, 2e8, 3e8]"), path + "stresses", "one for each of the 2");
  expect_fault(table("plastic_strains: [0, 0.1]"), path + "stresses", "required where curve is table");
}

TEST(SceneRules, PoissonsRatioUpToAHalf) {
  EXPECT_TRUE(faults_of(replaced(minimal_example(), "0.34", "0.499999")).empty());
  EXPECT_TRUE(faults_of(replaced(minimal_example(), "0.34", "0")).empty());
  expect_fault(replaced(minimal_example(), "0.34", "0.5"), "bodies[0].material.poissons_ratio", "below 0.5");
}

TEST(SceneRules, Histories) {
  const std::string motion = "tools[2].motion";
  expect_flange_fault("times: [0, 0.006]", "times: [0.006, 0.006]", motion + ".times", "strictly increasing");
  expect_flange_fault("times: [0, 0.006]", "times: [0, 0.006, 0.007]", motion + ".positions", "one for each of the 3 times");
  expect_flange_fault("positions: [[0, 0], [0, -0.020]] ", "profile: linear ", motion, "without positions");
  expect_flange_fault("positions: [[", "velocities: [[0, 0], [0, -1]]\n      positions: [[", motion + ".velocities", "where kind is velocity");
  const std::string text = replaced(flange_example(), "kind: trajectory", "kind: velocity");
  expect_fault(replaced(text, "positions:", "profile: spline\n      velocities:"), motion + ".profile", "trajectories");
  expect_fault(replaced(minimal_example(), "velocities: [[0, 0], [2, 0]]", "velocities: [[0, 0]]"), "bodies[0].boundaries[1].velocities", "2 times");
  expect_fault(replaced(minimal_example(), "velocities: [[0, 0], [2, 0]], ", ""), "bodies[0].boundaries[1]", "without velocities and spins_deg_s");
  expect_fault(replaced(minimal_example(), "velocities: [[0, 0], [2, 0]]", "spins_deg_s: [[0, 0, 1]]"), "bodies[0].boundaries[1].spins_deg_s", "2 times");
  expect_fault(replaced(minimal_example(), "velocities: [[0, 0], [2, 0]]", "spins_deg_s: [[0, 0, 0], [0, 1, 0]]"), "bodies[0].boundaries[1].spins_deg_s[1]", "about z only");
  EXPECT_TRUE(faults_of(replaced(minimal_example(), "velocities: [[0, 0], [2, 0]]", "spins_deg_s: [[0, 0, 0], [0, 0, 1]]")).empty());
  expect_fault(replaced(minimal_example(), "stages:", "    pressures: [{set: top, times: [0, 1], values: [1e6]}]\nstages:"), "bodies[0].pressures[0].values", "2 times");
}

TEST(SceneRules, AForceGoesAlongOneLine) {
  const std::string motion = "tools[2].motion", text = replaced(flange_example(), "kind: trajectory", "kind: force");
  const auto with = [&](const std::string& fields) { return replaced(text, "positions: [[0, 0], [0, -0.020]]", fields); };
  EXPECT_TRUE(faults_of(with("forces: [[0, 0], [0, -2000]]")).empty()) << sentences(faults_of(with("forces: [[0, 0], [0, -2000]]")));
  EXPECT_TRUE(faults_of(with("forces: [[1, -2], [-500, 1000]]\n      mass: 0.1\n      damping: 100")).empty());
  expect_fault(with("forces: [[0, 0], [0, 0]]"), motion + ".forces", "a tool without any rests");
  EXPECT_TRUE(faults_of(with("forces: [[0, 0], [0, 0]]\n      initial_velocity: [0, -3]")).empty());
  EXPECT_TRUE(faults_of(with("forces: [[0, 0], [0, -2000]]\n      initial_velocity: [0, 3]")).empty());
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      initial_velocity: [1, -3]"), motion + ".initial_velocity", "along the guide");
  expect_fault(with("forces: [[0, -1], [1, -2000]]"), motion + ".forces[0]", "along one line");
  expect_fault(with("forces: [[0, -1]]"), motion + ".forces", "2 times");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      stop_force: 1e3"), motion + ".stop_force", "where kind is trajectory or velocity");
  const std::string flanging = "kind: form, duration: 0.006", until = flanging + ", until_stopped: punch";
  expect_fault(replaced(flange_example(), flanging, until), "stages[0].until_stopped", "stop_force");
  const std::string stops = replaced(flange_example(), "kind: trajectory", "kind: trajectory\n      stop_force: 1e5");
  expect_fault(replaced(stops, flanging, flanging + ", until_stopped: die"), "stages[0].until_stopped", "the tools that stop are punch");
  EXPECT_TRUE(faults_of(replaced(stops, flanging, until)).empty());
  expect_fault(with("forces: [[0, 0], [0, -2000, 1]]"), motion + ".forces[1]", "z = 0");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      mass: -1"), motion + ".mass", "at least 0");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      profile: spline"), motion + ".profile", "trajectories");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      positions: [[0, 0], [0, 1]]"), motion + ".positions[1]", "in part along the guide");
  EXPECT_TRUE(faults_of(with("forces: [[0, 0], [0, -2000]]\n      positions: [[0, 0], [0.001, 0]]")).empty());
  const std::string sprung = "forces: [[0, 0], [0, 0]]\n      guide: [0.6, 0.8]\n      stiffness: 1e6\n      ";
  EXPECT_TRUE(faults_of(with(sprung + "positions: [[8e-3, -6e-3], [0.6e-3, 0.8e-3]]")).empty()) << sentences(faults_of(with(sprung + "positions: [[8e-3, -6e-3], [0.6e-3, 0.8e-3]]")));
  expect_fault(with(sprung + "positions: [[0.6e-3, 0.8e-3], [0, 0]]"), motion + ".positions[0]", "its spring is slack");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      guide: [1, 0]"), motion + ".forces[1]", "along one line");
  expect_fault(with("forces: [[0, 0], [0, 0]]\n      guide: [0, 1, 1]"), motion + ".guide", "z = 0");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      stiffness: -1"), motion + ".stiffness", "at least 0");
  expect_fault(with("forces: [[0, 0], [0, -2000]]\n      positions: [[0, 0], [0.001, 0]]\n      velocities: [[0, 0], [1, 0]]"), motion, "give one of both");
  expect_fault(replaced(with("forces: [[0, 0], [0, -2000]]"), "tools:\n", "contact: {method: geometric}\ntools:\n"), motion + ".kind", "set contact.method to implicit");
  expect_flange_fault("positions: [[", "forces: [[0, 0], [0, -1]]\n      positions: [[", motion + ".forces", "where kind is force");
  EXPECT_TRUE(fault_at(faults_of(text), motion + ".forces"));
}

TEST(SceneRules, SetsExist) {
  expect_flange_fault("set: left", "set: lefft", "bodies[0].boundaries[0].set", "left, right, bottom, top, leg; did you mean left?");
  expect_flange_fault("set: leg}", "set: lag}", "output.probes[2].set", "did you mean leg?");
}

TEST(SceneRules, ToolsHaveTopicsOfTheirOwn) {
  const auto tools = [](const std::string& first, const std::string& second) {
    const std::string at = "point: [0, 0.002, 0], normal: [0, -1, 0]}\n";
    return minimal_example() + "tools:\n  - {name: " + first + ", " + at + "  - {name: " + second + ", " + at;
  };
  expect_fault(tools("press.a", "press-a"), "tools[1].name", "tool_forces/press_a");
  expect_fault(tools("1a", "tool_1a"), "tools[1].name", "tool_forces/tool_1a");
  EXPECT_TRUE(faults_of(tools("press.a", "press-b")).empty());
  expect_fault(tools("press", "strip"), "tools[1].name", "bodies[0] has this one");
}

TEST(SceneRules, Stages) {
  expect_flange_fault("kind: withdraw, duration", "kind: withdraw, tools: [punsh], duration", "stages[1].tools[0]", "did you mean punch?");
  expect_flange_fault("  - {name: springback", "  - {kind: withdraw, duration: 1}\n  - {name: springback", "stages[2]", "all tools are gone");
  const std::string some = replaced(flange_example(), "kind: withdraw, duration", "kind: withdraw, tools: [punch], duration");
  EXPECT_TRUE(faults_of(replaced(some, "  - {name: springback", "  - {kind: withdraw, duration: 1}\n  - {name: springback")).empty());
  expect_fault(replaced(some, "  - {name: springback", "  - {kind: withdraw, tools: [punch], duration: 1}\n  - {name: springback"), "stages[2].tools[0]", "withdrawn already");
  expect_flange_fault("{set: left, kind: fixed}", "{set: left, kind: fixed, until: spring}", "bodies[0].boundaries[0].until", "release, springback; did you mean springback?");
  expect_flange_fault("{set: left, kind: fixed}", "{set: left, kind: fixed, until: flanging}", "bodies[0].boundaries[0].until", "stages after the first");
  EXPECT_TRUE(faults_of(replaced(flange_example(), "{set: left, kind: fixed}", "{set: left, kind: fixed, until: springback}")).empty());
  // Stages without a name have their kind's, and a number from the second on: the first settle stage cannot be meant.
  const std::string twice = replaced(minimal_example(), "  - {kind: form, duration: 5e-4}  # s\n", "  - {kind: settle, limit: 1e-4}\n  - {kind: form, duration: 5e-4}\n  - {kind: settle, limit: 1e-4}\n");
  expect_fault(replaced(twice, "kind: fixed", "kind: fixed, until: settle"), "bodies[0].boundaries[0].until", "form, settle_2");
  EXPECT_TRUE(faults_of(replaced(twice, "kind: fixed", "kind: fixed, until: settle_2")).empty());
  expect_fault(replaced(minimal_example(), "kind: form", "kind: withdraw"), "stages[0]", "the scene has no tools");
  expect_fault(replaced(minimal_example(), "  - {kind: form, duration: 5e-4}  # s\n", "  []\n"), "stages", "required");
  expect_fault(replaced(minimal_example(), "kind: form, duration: 5e-4", "kind: form"), "stages[0].duration", "required where kind is form or withdraw");
}

TEST(SceneRules, Output) {
  expect_flange_fault("to: leg_far", "to: leg_near", "output.springback.to", "another probe");
  expect_flange_fault("to: leg_far", "to: leg_far, reference_from: leg_near", "output.springback.reference_to", "give both");
  expect_flange_fault("to: leg_far", "to: leg_far, reference_from: leg_near, reference_to: leg_near", "output.springback.reference_to", "another probe");
  expect_flange_fault("to: leg_far", "to: leg_far, reference_from: leg_near, reference_to: leg_fur", "output.springback.reference_to", "did you mean leg_far?");
  expect_flange_fault("to: leg_far", "to: leg_fur", "output.springback.to", "did you mean leg_far?");
  expect_flange_fault("frames: 100", "interval: 1e-15", "output.interval", "at most 100000 outputs");
}

TEST(SceneRules, BlanksThatCannotBeHeldAreRefused) {
  expect_fault(replaced(replaced(minimal_example(), "cells_along: 40", "cells_along: 1000000"), "cells_through: 2", "cells_through: 1000000"),
               "bodies[0].blank", "fewer cells");
}

TEST(SceneRules, MessagesAreHeldToTheDeclarations) {
  Scene scene;  // as an empty message
  const auto faults = check_declarations(scene);
  for (const char* field : {"name", "dimension", "bodies", "stages"}) EXPECT_TRUE(fault_at(faults, field)) << field;
  EXPECT_EQ(faults.size(), 4u) << sentences(faults);

  scene = scene_of(minimal_example());
  EXPECT_TRUE(check_declarations(scene).empty());
  scene.bodies[0].material = MaterialConfig{};
  scene.bodies[0].blank->radius = 1;
  scene.bodies[0].blank->pattern = "finest";
  scene.time_step.safety = std::numeric_limits<double>::quiet_NaN();
  scene.gravity.y() = -std::numeric_limits<double>::infinity();
  const auto more = check_declarations(scene);
  for (const char* field : {"bodies[0].material.density", "bodies[0].material.youngs_modulus", "bodies[0].blank.radius",
                            "bodies[0].blank.pattern", "time_step.safety", "gravity"}) {
    EXPECT_TRUE(fault_at(more, field)) << field;
  }
  EXPECT_EQ(more.size(), 6u) << sentences(more);
}

TEST(SceneRules, AProfileMayReturnToTheOrigin) {
  EXPECT_TRUE(faults_of(replaced(flange_example(), "{to: [-0.03, 0]}", "{to: [0, 0]}")).empty());
}

}  // namespace
}  // namespace forming_sim
