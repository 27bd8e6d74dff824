// formed.h5: what is saved is loaded, part by part; what is damaged or of another kind is refused with a sentence.
#include <gtest/gtest.h>

#include <filesystem>

#include "forming_sim/config/fault.h"
#include "forming_sim/files/formed_file.h"
#include "forming_sim/files/hdf5_file.h"
#include "results/run_files_tools.h"
#include "support/bodies.h"

namespace forming_sim {
namespace {

FormedPart part_of(CellKind kind, const std::string& name) {
  FormedPart part;
  part.name = name;
  part.material = "density: 1\n";
  part.pressure_average = "cell";
  part.pressed_by = {"tool punch"};
  part.held_sets = {"left", "corner"};
  part.mesh = block_of(kind);
  const BodyModel body = body_of(part.mesh, aluminium(true));
  NodeField x = positions_of(body.mesh), v(x.size(), Node::Zero()), f = v;
  Elements elements({body}, body.mesh.dimension, x, {}, 1);
  shake(x, body.mesh.dimension, .03, 1);
  elements.forces(x, v, 0, 0, f);
  part.memory = elements.memory_of(body, x);
  part.memory.reference = body.mesh.nodes;
  part.memory.cells[0].damage = {.25, .5, 1};
  for (std::size_t n = 0; n < x.size(); ++n) part.mesh.nodes[n] = vec3(x[n]);
  return part;
}

void expect_same(const FormedPart& a, const FormedPart& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.pressure_average, b.pressure_average);
  EXPECT_EQ(a.axisymmetric, b.axisymmetric);
  EXPECT_EQ(a.pressed_by, b.pressed_by);
  EXPECT_EQ(a.held_sets, b.held_sets);
  EXPECT_EQ(a.memory.nodal_ratio, b.memory.nodal_ratio);
  EXPECT_EQ(a.mesh.dimension, b.mesh.dimension);
  EXPECT_EQ(a.mesh.nodes, b.mesh.nodes);
  EXPECT_EQ(a.mesh.sets, b.mesh.sets);
  ASSERT_EQ(a.mesh.surface.size(), b.mesh.surface.size());
  for (std::size_t i = 0; i < a.mesh.surface.size(); ++i) EXPECT_EQ(a.mesh.surface[i].nodes, b.mesh.surface[i].nodes);
  EXPECT_EQ(a.memory.reference, b.memory.reference);
  ASSERT_EQ(a.memory.cells.size(), b.memory.cells.size());
  for (std::size_t k = 0; k < a.memory.cells.size(); ++k) {
    EXPECT_EQ(a.mesh.cells[k].kind, b.mesh.cells[k].kind);
    EXPECT_EQ(a.mesh.cells[k].nodes, b.mesh.cells[k].nodes);
    EXPECT_EQ(a.memory.cells[k].memory, b.memory.cells[k].memory);
    EXPECT_EQ(a.memory.cells[k].hourglass, b.memory.cells[k].hourglass);
    EXPECT_EQ(a.memory.cells[k].ratio, b.memory.cells[k].ratio);
    EXPECT_EQ(a.memory.cells[k].damage, b.memory.cells[k].damage);
  }
  EXPECT_EQ(a.memory.edges.ends, b.memory.edges.ends);
  EXPECT_EQ(a.memory.edges.memory, b.memory.edges.memory);
  EXPECT_EQ(a.memory.edges.edges, b.memory.edges.edges);
  EXPECT_EQ(a.memory.edges.volume_ratio, b.memory.edges.volume_ratio);
}

std::string refusal(const std::string& path) {
  try {
    formed_names(path);
    load_formed(path, 0);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::mesh_error);
    return error.what();
  }
  return "";
}

TEST(FormedFile, HoldsThePartsOfARun) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("formed.h5");
  const std::vector<FormedPart> parts{part_of(CellKind::hex1, "sheet"), part_of(CellKind::tetrahedron, "core"), part_of(CellKind::crossed, "section")};
  save_formed(path, parts);
  EXPECT_EQ(formed_names(path), (std::vector<std::string>{"sheet", "core", "section"}));
  for (std::size_t k = 0; k < parts.size(); ++k) expect_same(load_formed(path, k), parts[k]);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  save_formed(path, {parts[1]});
  EXPECT_EQ(formed_names(path), std::vector<std::string>{"core"}) << "the new file takes the place of the old one";
}

TEST(FormedFile, RefusesWhatIsNone) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("formed.h5");
  { Hdf5File other(path, Hdf5File::Mode::create); }
  EXPECT_NE(refusal(path).find("holds no formed parts"), std::string::npos);
  replace_file(path, "not HDF5");
  EXPECT_NE(refusal(path).find("is damaged or no formed.h5"), std::string::npos);
  {
    Hdf5File later(path, Hdf5File::Mode::create);
    Hdf5Group parts = later.root().create("parts");
    parts.set("layout", std::int64_t{1000});
  }
  EXPECT_NE(refusal(path).find("was written by a version that keeps other things"), std::string::npos);
}

// Wherever a byte is changed, or the end is missing: it is told or it does not matter.
TEST(FormedFile, DamageIsToldOrDoesNotMatter) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("formed.h5");
  const FormedPart part = part_of(CellKind::triangle, "block");
  save_formed(path, {part});
  const std::string whole = read_text(path);
  int told = 0;
  const auto look = [&] {
    try {
      expect_same(load_formed(path, 0), part);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::mesh_error);
      ++told;
    }
  };
  for (std::size_t at = 0; at < whole.size(); at += 29) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    replace_file(path, damaged);
    look();
  }
  EXPECT_GT(told, static_cast<int>(whole.size() / 29) / 2);
  for (std::size_t kept : {0, 1, 100, 1000, 2000}) {
    told = 0;
    replace_file(path, whole.substr(0, kept));
    look();
    EXPECT_EQ(told, 1) << kept << " bytes";
  }
}

}  // namespace
}  // namespace forming_sim
