// Where files named in scenes are looked for.
#include "forming_sim/mesh/url.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

// Sets a variable of the environment for the time of a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = getenv(name)) old_ = old, was_set_ = true;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (was_set_) setenv(name_, old_.c_str(), 1);
    else unsetenv(name_);
  }

 private:
  const char* name_;
  std::string old_;
  bool was_set_ = false;
};

const char kManifest[] = "<package format=\"2\">\n  <name> press_cell </name>\n</package>\n";

TEST(MeshUrl, PlainPathsAreRelativeToTheScene) {
  const TempDir dir;
  const std::string file = dir.write("meshes/die.stl", "x");
  EXPECT_EQ(resolve_url("meshes/die.stl", dir.str()), file);
  EXPECT_EQ(resolve_url("../meshes/die.stl", dir.str() + "/meshes"), file);
  EXPECT_EQ(resolve_url(file, "/nowhere"), file);
}

TEST(MeshUrl, TildeIsTheHomeDirectory) {
  const TempDir dir;
  const std::string file = dir.write("meshes/die.stl", "x");
  const Variable home("HOME", dir.str());
  EXPECT_EQ(resolve_url("~/meshes/die.stl", "/nowhere"), file);
  EXPECT_EQ(local_path("~/runs", Code::output_error), dir.str() + "/runs");
  for (const char* path : {"~runs", "a/~/b", "~", "/a", "", "runs"}) EXPECT_EQ(local_path(path, Code::output_error), path);
}

TEST(MeshUrl, APathNeedNotExist) {
  EXPECT_EQ(local_path("file:///none/of%20these", Code::output_error), "/none/of these");
  for (const std::string& wrong : {std::string("http://a/b"), std::string("package://no_such_package/runs"), std::string("a\0b", 3)}) {
    try {
      ADD_FAILURE() << local_path(wrong, Code::resume_error);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::resume_error) << error.what();
    }
  }
}

TEST(MeshUrl, FileUrlsAreAbsolute) {
  const TempDir dir;
  const std::string file = dir.write("two words.stl", "x");
  EXPECT_EQ(resolve_url("file://" + dir.str() + "/two%20words.stl", ""), file);
  EXPECT_TRUE(has(error_of([] { resolve_url("file://die.stl", ""); }), "absolute path"));
}

TEST(MeshUrl, PackagesAreFoundByTheNameInTheirManifest) {
  const TempDir dir;
  dir.write("src/cell-repository/package.xml", kManifest);
  const std::string file = dir.write("src/cell-repository/meshes/die.stl", "x");
  const Variable cmake("CMAKE_PREFIX_PATH", "");
  for (const char* root : {"", "/src", "/src/cell-repository"}) {
    const Variable ros("ROS_PACKAGE_PATH", "/nowhere:" + dir.str() + root);
    EXPECT_EQ(resolve_url("package://press_cell/meshes/die.stl", ""), file) << root;
  }
}

TEST(MeshUrl, PackagesWithCatkinIgnoreAreNotThere) {
  const TempDir dir;
  dir.write("old/package.xml", kManifest);
  dir.write("old/die.stl", "x");
  dir.write("old/CATKIN_IGNORE", "");
  dir.write("press_cell/package.xml", kManifest);
  dir.write("press_cell/CATKIN_IGNORE", "");
  dir.write("recent/package.xml", kManifest);
  const std::string file = dir.write("recent/die.stl", "x");
  const Variable ros("ROS_PACKAGE_PATH", dir.str()), cmake("CMAKE_PREFIX_PATH", "");
  EXPECT_EQ(resolve_url("package://press_cell/die.stl", ""), file);
}

TEST(MeshUrl, InstalledPackagesAreFoundUnderShare) {
  const TempDir dir;
  dir.write("install/share/press_cell/package.xml", kManifest);
  const std::string file = dir.write("install/share/press_cell/die.stl", "x");
  const Variable ros("ROS_PACKAGE_PATH", ""), cmake("CMAKE_PREFIX_PATH", "/nowhere:" + dir.str() + "/install");
  EXPECT_EQ(resolve_url("package://press_cell/die.stl", ""), file);
}

TEST(MeshUrl, WhatIsNotFoundNamesWhatWasTried) {
  const TempDir dir;
  EXPECT_TRUE(has(error_of([&] { resolve_url("die.stl", dir.str()); }), dir.str() + "/die.stl"));
  EXPECT_TRUE(has(error_of([&] { resolve_url(".", dir.str()); }), "is a folder"));
  EXPECT_TRUE(has(error_of([&] { resolve_url("", dir.str()); }), "the path is empty"));
  EXPECT_TRUE(has(error_of([&] { resolve_url("http://a/b.stl", ""); }), "scheme http://"));
  EXPECT_TRUE(has(error_of([&] { resolve_url("package://press_cell", ""); }), "package://NAME/PATH"));
  {
    const Variable ros("ROS_PACKAGE_PATH", dir.str()), cmake("CMAKE_PREFIX_PATH", "/prefix");
    const std::string text = error_of([] { resolve_url("package://press_cell/die.stl", ""); });
    EXPECT_TRUE(has(text, "the package press_cell was not found (tried " + dir.str() + ", /prefix/share/press_cell)")) << text;
  }
  const Variable ros("ROS_PACKAGE_PATH", ""), cmake("CMAKE_PREFIX_PATH", "");
  EXPECT_TRUE(has(error_of([] { resolve_url("package://press_cell/die.stl", ""); }), "source the setup.bash"));
}

}  // namespace
}  // namespace forming_sim
