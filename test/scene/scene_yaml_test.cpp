#include "forming_sim/scene/yaml.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "forming_sim/config/reflect.h"
#include "scene/scene_texts.h"

namespace forming_sim {
namespace {

TEST(SceneYaml, ReadsEveryKindOfMember) {
  const Scene scene = scene_of(flange_example());
  EXPECT_EQ(scene.name, "flange_example");
  EXPECT_EQ(scene.dimension, 2);
  ASSERT_EQ(scene.bodies.size(), 1u);
  const BodyConfig& sheet = scene.bodies[0];
  ASSERT_TRUE(sheet.blank);
  EXPECT_FALSE(sheet.mesh);
  EXPECT_EQ(sheet.blank->thickness, 0.93e-3);
  EXPECT_EQ(sheet.blank->cells_along, 160);
  EXPECT_EQ(sheet.blank->origin, Vec3(-0.025, 0, 0));
  ASSERT_TRUE(sheet.material.hardening);
  EXPECT_EQ(sheet.material.hardening->saturation_stress, 429.8e6);
  ASSERT_EQ(scene.tools.size(), 3u);
  ASSERT_TRUE(scene.tools[0].profile);
  EXPECT_EQ(scene.tools[0].profile->pieces[1].radius, 0.001);
  ASSERT_TRUE(scene.tools[2].motion);
  EXPECT_EQ(scene.tools[2].motion->positions, (std::vector<Vec3>{{0, 0, 0}, {0, -0.020, 0}}));
  EXPECT_EQ(scene.tools[2].motion->times, (std::vector<double>{0, 0.006}));
  EXPECT_FALSE(scene.tools[0].motion);
  EXPECT_EQ(scene.stages[2].kinetic_fraction, StageConfig{}.kinetic_fraction);
  EXPECT_EQ(scene.time_step.safety, 0.9);
  EXPECT_EQ(scene.text, flange_example());
  const Scene strip = scene_of(minimal_example());
  EXPECT_EQ(strip.bodies[0].boundaries[0].axes, std::vector<std::string>{"x"});
}

TEST(SceneYaml, WritesWhatReadsBackToTheSameScene) {
  Scene scene = scene_of(flange_example());
  scene.name = "true: yes, {a} #1";  // a text that YAML must quote
  scene.gravity = Vec3(0, -1.0 / 3, 0);
  scene.tools[0].rotation_deg = Vec3(0, 0, 1e-17);
  scene.bodies[0].sets[0].surface_only = true;
  scene.tools[1].profile->pieces[0].to = Vec3::Zero();  // given, and zero
  const std::string text = write_scene(scene);
  const Scene again = scene_of(text);
  EXPECT_TRUE(same(scene, again)) << text;
  EXPECT_EQ(write_scene(again), text);
  EXPECT_EQ(text.find("mass_scaling"), std::string::npos);
  EXPECT_EQ(text.find("time_step"), std::string::npos) << "defaults are not written";
}

TEST(SceneYaml, TenFaultsAreToldAtOnce) {
  std::string text = flange_example();
  text = replaced(text, "dimension: 2", "dimension: 2\ndimensions: 2");                   // 1 unknown key
  text = replaced(text, "density: 2710", "density: -2710");                              // 2 out of range
  text = replaced(text, "youngs_modulus: 70.5e9", "youngs_modulus: stiff");              // 3 wrong type
  text = replaced(text, "poissons_ratio: 0.34", "poissons_ratio: .nan");                 // 4 not a number
  text = replaced(text, "curve: voce ", "strength: 1e9\n        curve: voce ");           // 5 does not apply
  text = replaced(text, "kind: fixed", "kind: glued");                                   // 6 unknown word
  text = replaced(text, "      thickness: 0.93e-3\n", "");                               // 7 missing
  text = replaced(text, "cells_through: 4", "cells_through: 4\n      cells_along: 20");   // 8 twice
  text = replaced(text, "times: [0, 0.006]", "times: [0.006, 0]");                       // 9 not increasing
  text = replaced(text, "body: sheet, point: [0.006, 0]", "body: shet, point: [0.006, 0]");  // 10 no such body
  const std::vector<Fault> faults = faults_of(text);
  const char* fields[] = {"dimensions", "bodies[0].material.density", "bodies[0].material.youngs_modulus",
                          "bodies[0].material.poissons_ratio", "bodies[0].material.hardening.strength",
                          "bodies[0].boundaries[0].kind", "bodies[0].blank.thickness", "bodies[0].blank.cells_along",
                          "tools[2].motion.times", "output.probes[0].body"};
  for (const char* field : fields) EXPECT_TRUE(fault_at(faults, field)) << field << " is not among\n" << sentences(faults);
  EXPECT_EQ(faults.size(), 10u) << sentences(faults);
}

TEST(SceneYaml, UnknownKeyNamesTheNearestAndTheAllowed) {
  const auto faults = faults_of(replaced(minimal_example(), "density: 2710", "density: 2710\n      yield_stres: 3"));
  ASSERT_EQ(faults.size(), 1u) << sentences(faults);
  EXPECT_EQ(faults[0].field, "bodies[0].material.yield_stres");
  EXPECT_NE(faults[0].remedy.find("density, youngs_modulus, poissons_ratio, law, hardening"), std::string::npos) << faults[0].remedy;
  const auto near = faults_of(replaced(minimal_example(), "density: 2710", "density: 2710\n      poison_ratio: 0.3"));
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NE(near[0].remedy.find("did you mean poissons_ratio?"), std::string::npos) << near[0].remedy;
}

TEST(SceneYaml, FaultsNameTheirLine) {
  const auto faults = faults_of(replaced(minimal_example(), "cells_along: 40", "cells_along: 40.5"));
  ASSERT_EQ(faults.size(), 1u) << sentences(faults);
  EXPECT_EQ(faults[0].sentence().substr(0, 54), "bodies[0].blank.cells_along: given '40.5' (line 9); gi") << faults[0].sentence();
}

TEST(SceneYaml, SyntaxErrorNamesItsLine) {
  expect_fault("name: a\ndimension: [2\nbodies: 3\n", "scene", "line 3");
  expect_fault("", "scene", "0 YAML documents");
  expect_fault(minimal_example() + "---\nname: b\n", "scene", "2 YAML documents");
  expect_fault("just words", "scene", "give its fields");
  expect_fault("name: a\nbodies:\n\t- name: b\n", "scene", "line 3 has a tab");
  expect_fault(replaced(minimal_example(), "\n", " # 20 \xb0\x43\n"), "scene", "not UTF-8 at line 1");
  EXPECT_TRUE(faults_of(replaced(minimal_example(), "\n", " # 20 \xc2\xb0\x43\n")).empty());
  expect_fault(std::string("name: a\nbodies: \"\0", 18), "scene", "line 2 has a NUL");
}

TEST(SceneYaml, WhatIsSaidTwiceCanBeSaidOnce) {
  const std::string text = minimal_example();
  const std::size_t from = text.find("    material:"), to = text.find("    boundaries:");
  const std::string members = text.substr(text.find('\n', from) + 1, to - text.find('\n', from) - 1);
  const auto with = [&](const std::string& material) { return "x-alloy: &alloy\n" + members + text.substr(0, from) + "    material: " + material + text.substr(to); };
  EXPECT_TRUE(same(scene_of(with("*alloy\n")), scene_of(text)));
  EXPECT_TRUE(same(scene_of(with("{<<: *alloy}\n")), scene_of(text)));
  Scene denser = scene_of(text);
  denser.bodies[0].material.density = 8000;
  EXPECT_TRUE(same(scene_of(with("{density: 8000, <<: [*alloy]}\n")), denser));
  expect_fault(with("{<<: *alloy, <<: 3}\n"), "bodies[0].material.<<", "give the alias");
  expect_fault("x-odd: &odd {densty: 1}\n" + replaced(text, "density: 2710", "density: 2710\n      <<: *odd"), "bodies[0].material.densty", "did you mean density?");
  expect_fault(replaced(text, "density: 2710", "density: 2710\n      x-free: 1"), "bodies[0].material.x-free", "the keys here are");
}

TEST(SceneYaml, WrongTypes) {
  expect_fault(replaced(minimal_example(), "length: 0.02 ", "length: .inf "), "bodies[0].blank.length", "finite");
  expect_fault(replaced(minimal_example(), "length: 0.02 ", "length: 20mm "), "bodies[0].blank.length", "'20mm'");
  expect_fault(replaced(minimal_example(), "length: 0.02 ", "length: [1] "), "bodies[0].blank.length", "a list of 1");
  expect_fault(replaced(minimal_example(), "name: strip\n", "name:\n"), "bodies[0].name", "given nothing");
  expect_fault(replaced(minimal_example(), "axes: [x]", "axes: x"), "bodies[0].boundaries[0].axes", "give a list");
  expect_fault(replaced(minimal_example(), "normal: [0, 1]", "normal: [0, 1, 0, 0]"), "bodies[0].boundaries[2].normal", "[x, y, z]");
  expect_fault(replaced(minimal_example(), "normal: [0, 1]", "normal: [0, 0]"), "bodies[0].boundaries[2].normal", "a list of 2 zeros");
  expect_fault(replaced(minimal_example(), "normal: [0, 1]", "normal: [0, up]"), "bodies[0].boundaries[2].normal[1]", "'up'");
  expect_fault(replaced(minimal_example(), "times: [0, 1e-4]", "times: [0, soon]"), "bodies[0].boundaries[1].times[1]", "'soon'");
  expect_fault(replaced(minimal_example(), "hardening: {curve: linear, yield_stress: 150e6, modulus: 500e6}", "hardening: voce"),
               "bodies[0].material.hardening", "curve, yield_stress");
  expect_fault(replaced(minimal_example(), "dimension: 2 ", "gravity: 9.81\ndimension: 2 "), "gravity", "in m/s2");
  expect_fault("name: a\ndimension: 2\nbodies: strip\nstages: [{kind: form, duration: 1}]\n", "bodies", "give a list");
}

TEST(SceneYaml, MissingGroupIsOneFault) {
  const std::string text = minimal_example();
  const std::size_t from = text.find("    material:"), to = text.find("    boundaries:");
  expect_fault(text.substr(0, from) + text.substr(to), "bodies[0].material", "what the body is made of");
}

TEST(SceneYaml, FieldsThatDoNotApplyAreFaultsEvenWithTheirDefault) {
  expect_fault(replaced(minimal_example(), "shape: strip", "shape: strip\n      portion: full"), "bodies[0].blank.portion", "only where shape is bar");
  expect_fault(replaced(minimal_example(), "shape: strip", "shape: strip\n      width: 0.01"), "bodies[0].blank.width", "leave it out");
}

TEST(SceneYaml, LongListsOfFaultsAreShortened) {
  std::string times = "0";
  for (int i = 0; i < 100; ++i) times += ", no";
  const auto faults = faults_of(replaced(minimal_example(), "times: [0, 1e-4]", "times: [" + times + "]"));
  EXPECT_EQ(faults.size(), 6u) << sentences(faults);  // five entries, and velocities that are not as many
  EXPECT_NE(sentences(faults).find("95 more faults"), std::string::npos) << sentences(faults);
}

TEST(SceneYaml, FilesReferToTheirOwnDirectory) {
  namespace fs = std::filesystem;
  const fs::path directory = fs::temp_directory_path() / ("scene_yaml_test_" + std::to_string(getpid()));
  fs::create_directories(directory);
  std::ofstream(directory / "strip.yaml") << minimal_example();
  EXPECT_EQ(read_scene_file((directory / "strip.yaml").string()).base_directory, directory.string());
  std::ofstream(directory / "bad.yaml") << "name: x\n";
  EXPECT_THROW(read_scene_file((directory / "bad.yaml").string()), SceneError);
  for (const std::string& missing : {(directory / "none.yaml").string(), directory.string()}) {
    try {
      read_scene_file(missing);
      ADD_FAILURE() << missing;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::output_error);
      EXPECT_NE(std::string(error.what()).find(missing), std::string::npos);
    }
  }
  fs::remove_all(directory);
}

}  // namespace
}  // namespace forming_sim
