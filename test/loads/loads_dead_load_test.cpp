// Dead loads: what they are on the whole, how nodes share them, when they act, what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/dead_load.h"
#include "forming_sim/mesh/generate.h"

namespace forming_sim {
namespace {

LoadConfig load(const std::string& set, const std::string& kind, const Vec3& value) {
  LoadConfig config;
  config.set = set;
  config.kind = kind;
  config.times = {0, 2};
  (kind == "traction" ? config.tractions : config.forces) = {Vec3::Zero(), value};
  return config;
}

Mesh block(int dimension, const std::string& pattern) {
  BlankConfig blank;
  blank.shape = dimension == 2 ? "strip" : "plate";
  blank.origin = Vec3(1, 0, 0);
  blank.length = 3, blank.width = 2, blank.thickness = 0.5;
  blank.cells_along = 3, blank.cells_across = 2, blank.cells_through = 2;
  blank.pattern = pattern;
  return generate_blank(blank);
}

NodeField at(const ResolvedLoad& load, double time, std::size_t nodes) {
  NodeField f(nodes, Node::Zero());
  DeadLoadSet({load}).add(time, f);
  return f;
}

Vec3 sum(const NodeField& f) {
  Vec3 all = Vec3::Zero();
  for (const Node& one : f) all += vec3(one);
  return all;
}

TEST(DeadLoad, a_traction_acts_on_the_area_and_a_force_as_a_whole) {
  const Vec3 value(3, -2, 5);
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    const Mesh mesh = block(3, pattern);
    const NodeField by_traction = at(resolve(load("right", "traction", value), "b", mesh, 0, false), 2, mesh.nodes.size());
    const NodeField by_force = at(resolve(load("right", "force", value), "b", mesh, 0, false), 2, mesh.nodes.size());
    EXPECT_LT((sum(by_traction) - 2 * 0.5 * value).norm(), 1e-14) << pattern;
    EXPECT_LT((sum(by_force) - value).norm(), 1e-14) << pattern;
    Vec3 moment = Vec3::Zero();
    for (std::size_t n = 0; n < by_force.size(); ++n) {
      EXPECT_LT((vec3(by_force[n]) - vec3(by_traction[n])).norm(), 1e-14);  // the area is 1
      EXPECT_TRUE(by_force[n].isZero(0) || mesh.nodes[n].x() == 4);
      moment += (mesh.nodes[n] - Vec3(4, 1, 0.25)).cross(vec3(by_force[n]));
    }
    EXPECT_LT(moment.norm(), 1e-14) << pattern;  // about the centre of the face
  }
}

TEST(DeadLoad, is_summed_around_the_circle) {
  const Mesh mesh = block(2, "fine");
  const NodeField turned = at(resolve(load("top", "traction", Vec3(0, 7, 0)), "b", mesh, 0, true), 2, mesh.nodes.size());
  EXPECT_NEAR(sum(turned).y(), 7 * M_PI * (4 * 4 - 1), 1e-12);
  const NodeField flat = at(resolve(load("top", "traction", Vec3(0, 7, 0)), "b", mesh, 0, false), 2, mesh.nodes.size());
  EXPECT_NEAR(sum(flat).y(), 7 * 3, 1e-13);
}

TEST(DeadLoad, nodes_without_a_face_share_a_force_evenly) {
  Mesh mesh = block(3, "one_point");
  mesh.sets["two"] = {0, 7};
  const ResolvedLoad resolved = resolve(load("two", "force", Vec3(4, 0, 0)), "b", mesh, 10, false);
  EXPECT_EQ(resolved.nodes, (std::vector<int>{10, 17}));
  EXPECT_EQ(resolved.share, (std::vector<double>{0.5, 0.5}));
  const NodeField half_way = at(resolved, 1, 20);
  EXPECT_EQ(half_way[10], Node(1, 0, 0, 0));
  EXPECT_EQ(at(resolved, 5, 20)[17], Node(2, 0, 0, 0));  // level after the last knot
}

TEST(DeadLoad, faults_are_named) {
  Mesh mesh = block(3, "fine");
  mesh.sets["corner"] = {0};
  mesh.sets["none"] = {};
  EXPECT_THROW(resolve(load("absent", "force", Vec3(1, 0, 0)), "b", mesh, 0, false), Error);
  EXPECT_THROW(resolve(load("corner", "traction", Vec3(1, 0, 0)), "b", mesh, 0, false), Error);
  EXPECT_THROW(resolve(load("none", "force", Vec3(1, 0, 0)), "b", mesh, 0, false), Error);
  LoadConfig uneven = load("top", "force", Vec3(1, 0, 0));
  uneven.forces.pop_back();
  EXPECT_THROW(resolve(uneven, "b", mesh, 0, false), Error);
}

}  // namespace
}  // namespace forming_sim
