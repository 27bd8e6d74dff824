// What a scene means does not hang on where its files lie.
#include "forming_sim/results/meaning.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "forming_sim/results/text_file.h"
#include "results/example_run.h"

namespace forming_sim {
namespace {

Scene scene_of(const std::string& url, const std::string& base_directory) {
  Scene scene;
  scene.name = "scene";
  scene.base_directory = base_directory;
  scene.bodies.resize(2);
  scene.bodies[0].mesh.emplace().url = url;
  scene.bodies[1].formed.emplace().url = url;
  scene.tools.resize(1);
  scene.tools[0].mesh.emplace().url = url;
  return scene;
}

TEST(Meaning, HoweverAFileIsSpelled) {
  const TemporaryDirectory directory, elsewhere;
  const std::string file = directory.file("die.stl"), base = std::filesystem::path(file).parent_path().string();
  replace_file(file, "solid");
  const std::string meant = meaning_of(scene_of("die.stl", base));
  EXPECT_EQ(meant.find(base), std::string::npos) << meant;
  for (const std::string& url : {std::string("./die.stl"), file, "file://" + file}) EXPECT_EQ(meaning_of(scene_of(url, base)), meant) << url;
  replace_file(elsewhere.file("die.stl"), "solid");
  EXPECT_EQ(meaning_of(scene_of(elsewhere.file("die.stl"), "")), meant);
}

TEST(Meaning, IsAnotherWithWhatIsInAFile) {
  const TemporaryDirectory directory;
  const std::string file = directory.file("die.stl");
  replace_file(file, "solid");
  for (int part = 0; part < 3; ++part) {
    Scene scene = scene_of("", "");
    (part == 0 ? scene.bodies[0].mesh->url : part == 1 ? scene.bodies[1].formed->url : scene.tools[0].mesh->url) = file;
    replace_file(file, "solid");
    const std::string meant = meaning_of(scene);
    replace_file(file, "Solid");
    EXPECT_NE(meaning_of(scene), meant) << part;
  }
}

TEST(Meaning, OfAFileThatIsNotThereIsItsUrl) {
  EXPECT_NE(meaning_of(scene_of("nowhere/die.stl", "")).find("url: nowhere/die.stl"), std::string::npos);
}

}  // namespace
}  // namespace forming_sim
