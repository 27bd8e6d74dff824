// A scene survives the way through a message, whatever it holds.
#include "forming_sim/ros/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "forming_sim/config/reflect.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {
namespace {

/// Gives every declared field, down to the last group, a value that is not its default.
template <class T> void fill(T& value, int& seed) {
  if constexpr (is_config<T>) {
    for_each_field(value, [&](const char*, auto& member, const Field&) { fill(member, seed); });
  } else if constexpr (is_optional<T>) {
    fill(value.emplace(), seed);
  } else if constexpr (is_vector<T>) {
    value.resize(2);
    for (auto& entry : value) fill(entry, seed);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    value = Vec3(seed + 1, seed + 2, -0.1 * (seed + 3));
    seed += 3;
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = "/text" + std::to_string(++seed);
  } else if constexpr (std::is_same_v<T, bool>) {
    value = true;
  } else {
    value = static_cast<T>(1000 + ++seed);
  }
}

Scene round_trip(const Scene& scene) {
  std::vector<Fault> faults;
  const Scene back = scene_from(scene_message(scene), faults);
  for (const Fault& fault : faults) ADD_FAILURE() << fault.sentence();
  return back;
}

TEST(RosConvert, EveryDeclaredFieldComesBack) {
  Scene scene;
  int seed = 0;
  fill(scene, seed);
  EXPECT_GT(seed, 200) << "the scene must really be full";
  EXPECT_TRUE(same(scene, round_trip(scene)));
}

TEST(RosConvert, AnEmptyMessageIsTheDefaultScene) {
  std::vector<Fault> faults;
  EXPECT_TRUE(same(Scene{}, scene_from(SceneSpec{}, faults)));
  EXPECT_TRUE(faults.empty());
}

TEST(RosConvert, ShippedScenesComeBackAsTheSameYaml) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FORMING_SIM_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    Scene scene = read_scene_file(entry.path().string());
    make_urls_absolute(scene);
    const Scene back = round_trip(scene);
    EXPECT_TRUE(same(scene, back)) << entry.path();
    EXPECT_EQ(write_scene(scene), write_scene(back)) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(RosConvert, NotANumberIsKeptForTheValidation) {
  SceneSpec message;
  message.bodies.resize(1);
  message.bodies[0].material.density = std::nan("");
  message.gravity.y = std::nan("");
  std::vector<Fault> faults;
  const Scene scene = scene_from(message, faults);
  EXPECT_TRUE(std::isnan(scene.bodies.at(0).material.density));
  EXPECT_TRUE(std::isnan(scene.gravity.y()));
}

TEST(RosConvert, AGroupWithNothingInItIsRefused) {
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].material.hardening.emplace();
  try {
    scene_message(scene);
    FAIL() << "an empty hardening must not turn into an elastic material";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.faults().at(0).field, "bodies[0].material.hardening");
  }
}

MeshSpec one_triangle() {
  MeshSpec mesh;
  mesh.unit_scale = 1;
  mesh.shape.vertices.resize(3);
  mesh.shape.vertices[1].x = 1;
  mesh.shape.vertices[2].y = 2;
  mesh.shape.triangles.resize(1);
  mesh.shape.triangles[0].vertex_indices = {{0, 1, 2}};
  return mesh;
}

TEST(RosConvert, ShapeMeshBecomesAnInlineMesh) {
  SceneSpec message;
  message.tools.resize(1);
  message.tools[0].mesh = one_triangle();
  std::vector<Fault> faults;
  const Scene scene = scene_from(message, faults);
  EXPECT_TRUE(faults.empty());
  const MeshConfig& mesh = scene.tools.at(0).mesh.value();
  EXPECT_EQ(mesh.cell_type, "triangle");
  EXPECT_EQ(mesh.cells, (std::vector<int>{0, 1, 2}));
  ASSERT_EQ(mesh.points.size(), 3u);
  EXPECT_EQ(mesh.points[2], Vec3(0, 2, 0));
}

TEST(RosConvert, AMeshGivenTwiceIsAFault) {
  SceneSpec message;
  message.tools.resize(1);
  message.tools[0].mesh = one_triangle();
  message.tools[0].mesh.url = "file:///tmp/die.stl";
  std::vector<Fault> faults;
  scene_from(message, faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "tools[0].mesh.shape");
}

TEST(RosConvert, RelativeUrlsAreFaultsInAMessageAndAbsoluteFromTheClient) {
  Scene scene;
  scene.base_directory = "/data/scenes";
  scene.tools.resize(1);
  scene.tools[0].mesh.emplace().url = "../meshes/die.stl";
  std::vector<Fault> faults;
  scene_from(scene_message(scene), faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "tools[0].mesh.url");

  make_urls_absolute(scene);
  EXPECT_EQ(scene.tools[0].mesh->url, "file:///data/meshes/die.stl");
  scene.tools[0].mesh->url = "package://forming_sim/meshes/die.stl";
  make_urls_absolute(scene);
  EXPECT_EQ(scene.tools[0].mesh->url, "package://forming_sim/meshes/die.stl");
}

TEST(RosConvert, FaultsKeepAllTheirParts) {
  const auto messages = fault_messages({{Code::mesh_error, "bodies[0].mesh", "3 cells", "give more"}});
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].code, static_cast<int>(Code::mesh_error));
  EXPECT_EQ(messages[0].field + messages[0].given + messages[0].remedy, "bodies[0].mesh3 cellsgive more");
}

}  // namespace
}  // namespace forming_sim
