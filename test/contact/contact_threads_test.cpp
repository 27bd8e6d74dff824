// Contact by several threads: the same bits as by one.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"

using contact_test::World;
using namespace forming_sim;

TEST(ContactThreads, ChangeNoBit) {
  const auto plates = [](Team* team, long& listed) {
    World world;
    world.team = team;
    world.dimension = 3;
    world.config.layer = 1e-4;
    world.config.friction = .2;
    world.modulus = 1e9;
    world.add_box(Vec3(0, 0, 0), 80, 80, 1, .01, 2700, 1e5);
    world.add_box(Vec3(.0031, .0027, .0102), 76, 77, 1, .0103, 2700, 1e5);
    Contact contact = world.make();
    world.take_shifts(contact);
    for (size_t i = 0; i < world.x.size(); ++i) world.v[i] = Node(.3 * std::sin(7. * static_cast<double>(i)), .1, world.x[i].z() > .0101 ? -2 : 1, 0);
    long active = 0;
    for (int i = 0; i < 40; ++i) {
      world.step(contact, 1e-5, false);
      active = std::max(active, world.last.active);
    }
    listed = contact.listed_pairs();
    EXPECT_GT(active, 3000);
    return world;
  };
  Team two(2), three(3);
  long listed = 0;
  const World one = plates(nullptr, listed);
  EXPECT_GT(listed, 10000);
  for (Team* team : {&two, &three}) {
    const World other = plates(team, listed);
    for (size_t i = 0; i < one.x.size(); ++i) {
      ASSERT_EQ(one.x[i], other.x[i]) << "node " << i << ", " << team->size() << " threads";
      ASSERT_EQ(one.v[i], other.v[i]) << "node " << i << ", " << team->size() << " threads";
    }
    EXPECT_EQ(one.last.friction_work, other.last.friction_work);
    EXPECT_EQ(one.last.dissipated, other.last.dissipated);
  }
}
