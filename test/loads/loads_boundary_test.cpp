// Boundary sets: merging on a node, conflicts, reaction work against the change
// of kinetic energy.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/boundary.h"

namespace forming_sim {
namespace {

ResolvedBoundary fixed(std::vector<std::string> axes, std::vector<int> nodes) {
  BoundaryConfig config;
  config.set = "held";
  config.kind = "fixed";
  config.axes = std::move(axes);
  return {config, "sheet", std::move(nodes)};
}

ResolvedBoundary symmetric(const Vec3& normal, std::vector<int> nodes) {
  BoundaryConfig config;
  config.set = "mirror";
  config.kind = "symmetric";
  config.normal = normal;
  return {config, "sheet", std::move(nodes)};
}

ResolvedBoundary driven(const Vec3& from, const Vec3& to, std::vector<std::string> axes,
                        std::vector<int> nodes) {
  BoundaryConfig config;
  config.set = "driven";
  config.kind = "velocity";
  config.axes = std::move(axes);
  config.times = {0, 2};
  config.velocities = {from, to};
  return {config, "sheet", std::move(nodes)};
}

std::string refusal(const std::vector<ResolvedBoundary>& boundaries, int dimension = 3) {
  try {
    BoundarySet set(boundaries, dimension);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::invalid_scene);
    return error.what();
  }
  return "";
}

TEST(BoundarySet, fixes_axes_and_leaves_the_others) {
  BoundarySet set({fixed({"y"}, {3, 1}), fixed({}, {5})}, 3);
  EXPECT_EQ(set.nodes(), (std::vector<int>{1, 3, 5}));
  EXPECT_EQ(set.projector(0) * Vec3(1, 2, 3), Vec3(1, 0, 3));
  EXPECT_EQ(set.projector(2) * Vec3(1, 2, 3), Vec3(0, 0, 0));
}

TEST(BoundarySet, all_axes_in_plane_strain_are_x_and_y) {
  BoundarySet set({fixed({}, {0})}, 2);
  EXPECT_EQ(set.projector(0), Mat3(Vec3(0, 0, 1).asDiagonal()));
}

TEST(BoundarySet, merges_skew_planes_of_symmetry) {
  const Vec3 first(1, 2, 2), second(1, 0, 1);
  BoundarySet set({symmetric(first, {4}), symmetric(second, {4})}, 3);
  const Mat3 p = set.projector(0);
  EXPECT_LT((p * p - p).norm(), 1e-14);
  EXPECT_LT((p - p.transpose()).norm(), 1e-15);
  EXPECT_LT((p * first).norm(), 1e-14);
  EXPECT_LT((p * second).norm(), 1e-14);
  EXPECT_NEAR(p.trace(), 1, 1e-14);
  const Vec3 line = first.cross(second);
  EXPECT_LT((p * line - line).norm(), 1e-14);
  // A third independent plane leaves nothing; one said twice changes nothing.
  EXPECT_EQ(
      BoundarySet({symmetric(first, {4}), symmetric(second, {4}), symmetric(line, {4})}, 3).projector(0),
      Mat3(Mat3::Zero()));
  EXPECT_EQ(BoundarySet({symmetric(first, {4}), symmetric(-3 * first, {4})}, 3).projector(0),
            BoundarySet({symmetric(first, {4})}, 3).projector(0));
}

TEST(BoundarySet, prescribes_velocity_along_its_axes_only) {
  BoundarySet set({driven({2, 7, 0}, {4, 7, 0}, {"x"}, {0, 2})}, 3);
  NodeField v(3, Node(1, 1, 1, 0));
  set.apply_velocity(1, 0, v, v);
  EXPECT_EQ(v[0], Node(3, 1, 1, 0));
  EXPECT_EQ(v[1], Node(1, 1, 1, 0));
  EXPECT_EQ(set.prescribed(1, 5, 0, Vec3::Zero()), Vec3(4, 0, 0));
}

// A step over a knot that is as steep as a jump goes as far as the table says, and turns as far.
TEST(BoundarySet, goes_as_far_as_its_table) {
  ResolvedBoundary jump = driven({8, 0, 0}, {8, 0, 0}, {"x", "y"}, {0});
  jump.config.times = {0, 1, 1 + 1e-6, 2};
  jump.config.velocities = {Vec3(8, 0, 0), Vec3(8, 0, 0), Vec3(0, 3, 0), Vec3(0, 3, 0)};
  ResolvedBoundary turn = jump;
  turn.config.velocities.clear();
  turn.places = {Vec3(1, 0, 0)};
  turn.config.spins_deg_s = {Vec3(0, 0, 50), Vec3(0, 0, 50), Vec3::Zero(), Vec3::Zero()};
  BoundarySet moved({jump}, 2), turned({turn}, 2);
  Vec3 way = Vec3::Zero(), x(1, 0, 0);
  for (int k = 0; k < 7; ++k) {
    way += 0.3 * moved.prescribed(0, 0.3 * k, 0.3, Vec3::Zero());
    x += 0.3 * turned.prescribed(0, 0.3 * k, 0.3, x);
  }
  EXPECT_LT((way - Vec3(8 + 4e-6, 3 * 1.1 - 1.5e-6, 0)).norm(), 1e-12);
  EXPECT_NEAR(std::atan2(x.y(), x.x()) * 180 / M_PI, 50 + 25e-6, 1e-9);
  EXPECT_NEAR(x.norm(), 1, 1e-12);
}

// A gripper: whatever the steps, a node is where the trajectory says, and its velocity between them is that of the pose. Displacements count from the first.
TEST(BoundarySet, a_trajectory_is_followed_to_its_places) {
  ResolvedBoundary grip = driven({0, 0, 0}, {0, 0, 0}, {"x", "y", "z"}, {0});
  BoundaryConfig& config = grip.config;
  config.kind = "trajectory";
  config.velocities.clear();
  config.times = {0, 1, 2, 3};
  config.positions = {Vec3(5, 0, 0), Vec3(6, 1, 0), Vec3(6, 1, 3), Vec3(9, 1, 3)};
  config.rotations_deg = {Vec3::Zero(), Vec3(0, 0, 90), Vec3(30, 0, 120), Vec3(30, 40, 200)};
  config.centre = Vec3(1, 2, 3);
  const Vec3 place(2, 2, 2.5);
  grip.places = {place};
  MotionConfig same;
  same.kind = "trajectory";
  same.times = config.times;
  same.positions = config.positions;
  same.rotations_deg = config.rotations_deg;
  for (const char* profile : {"linear", "smooth", "spline"}) {
    config.profile = same.profile = profile;
    const BoundarySet set({grip}, 3);
    const RigidMotion motion(same, 3);
    const auto told = [&](double t) { return Vec3(config.centre + motion.at(t).translation - config.positions[0] + motion.at(t).rotation * (place - config.centre)); };
    Vec3 x = place;
    double t = 0;
    for (const double dt : {0.3, 0.9, 0.25, 0.8, 0.5, 1.0}) {
      const Pose now = motion.at(t);
      EXPECT_LT((set.prescribed(0, t, 0, x) - now.velocity - now.spin.cross(now.rotation * (place - config.centre))).norm(), 1e-12) << profile << " " << t;
      x += dt * set.prescribed(0, t, dt, x);
      t += dt;
      EXPECT_LT((x - told(t)).norm(), 1e-13) << profile << " " << t;
    }
    EXPECT_EQ(set.prescribed(0, t, 0.1, x), Vec3::Zero().eval()) << "at rest after its last knot";
  }
}

TEST(BoundarySet, a_part_of_the_nodes_at_a_time_is_all_of_them) {
  BoundarySet set({driven({2, 7, 0}, {4, 7, 0}, {"x"}, {0, 2, 3, 7}), symmetric(Vec3(1, 1, 0), {4, 8})}, 3);
  const NodeField at_random{{1, 2, 3, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}, {1, 4, 7, 0}, {2, 5, 8, 0}, {3, 6, 9, 0}, {9, 7, 5, 0}, {8, 6, 4, 0}, {7, 5, 3, 0}};
  NodeField whole = at_random, parts = at_random;
  set.apply_velocity(1, 0, whole, whole);
  for (long first : {0, 3, 6}) set.apply_velocity(set.prescription(1, 0), parts, first, first + 3, parts);
  EXPECT_EQ(parts, whole);
  for (long n : {0, 2, 3, 4, 7, 8}) EXPECT_NE(parts[n], at_random[n]) << n;
  for (long n : {1, 5, 6}) EXPECT_EQ(parts[n], at_random[n]) << n;
}

TEST(BoundarySet, a_drive_and_a_skew_plane_hold_both) {
  // Driven along x with speed u and kept on the plane with normal (1,1,0)/sqrt2:
  // the node must slide with v = u (1,-1,0) and stay free along z.
  const Vec3 normal(1, 1, 0);
  for (bool plane_first : {true, false}) {
    std::vector<ResolvedBoundary> boundaries{driven({3, 0, 0}, {3, 0, 0}, {"x"}, {0}),
                                             symmetric(normal, {0})};
    if (plane_first) std::swap(boundaries[0], boundaries[1]);
    BoundarySet set(boundaries, 3);
    NodeField v{Node(9, 9, 9, 0)};
    set.apply_velocity(0.5, 0, v, v);
    EXPECT_LT((v[0] - Node(3, -3, 9, 0)).norm(), 1e-13);
  }
}

TEST(BoundarySet, conflicts_name_node_body_and_sets) {
  const std::string message = refusal({fixed({"x"}, {8}), driven({1, 0, 0}, {1, 0, 0}, {"x"}, {7, 8})});
  for (const char* part : {"node 8", "\"sheet\"", "\"held\"", "\"driven\""})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  // Equal at the knots but not between: linear against smooth.
  ResolvedBoundary smooth = driven({0, 0, 0}, {1, 0, 0}, {"x"}, {8});
  smooth.config.profile = "smooth";
  EXPECT_NE(refusal({driven({0, 0, 0}, {1, 0, 0}, {"x"}, {8}), smooth}), "");
  // Three driven axes against a plane that is not along their velocity.
  EXPECT_NE(refusal({driven({1, 0, 0}, {1, 0, 0}, {}, {8}), symmetric({1, 1, 0}, {8})}), "");
}

TEST(BoundarySet, equal_prescriptions_agree) {
  EXPECT_EQ(refusal({driven({1, 0, 0}, {2, 0, 0}, {}, {8}), driven({1, 5, 0}, {2, 5, 0}, {"x"}, {8})}), "");
  EXPECT_EQ(refusal({fixed({}, {8}), symmetric({1, 1, 1}, {8}), driven({0, 0, 0}, {0, 0, 0}, {}, {8})}), "");
  EXPECT_EQ(refusal({driven({1, -1, 0}, {2, -2, 0}, {}, {8}), symmetric({1, 1, 0}, {8})}), "");
}

TEST(BoundarySet, refuses_what_means_nothing) {
  EXPECT_NE(refusal({fixed({"w"}, {0})}).find("axis \"w\""), std::string::npos);
  EXPECT_NE(refusal({fixed({"z"}, {0})}, 2).find("dimension 2"), std::string::npos);
  EXPECT_NE(refusal({symmetric({0, 0, 0}, {0})}).find("normal"), std::string::npos);
  EXPECT_NE(refusal({symmetric({1, 0, 1}, {0})}, 2).find("x-y plane"), std::string::npos);
  ResolvedBoundary other = fixed({}, {0});
  other.config.kind = "glued";
  EXPECT_NE(refusal({other}).find("glued"), std::string::npos);
  ResolvedBoundary backwards = driven({1, 0, 0}, {1, 0, 0}, {}, {0});
  backwards.config.times = {1, 0};
  EXPECT_NE(refusal({backwards}).find("\"driven\""), std::string::npos);
}

TEST(BoundarySet, resolves_sets_in_joined_numbering) {
  Mesh mesh;
  mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.sets["left"] = {0, 2};
  mesh.sets["none"] = {};
  BoundaryConfig config;
  config.kind = "fixed";
  config.set = "left";
  EXPECT_EQ(resolve(config, "sheet", mesh, 10).nodes, (std::vector<int>{10, 12}));
  EXPECT_EQ(resolve(config, "sheet", mesh, 10).places, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 1, 0)}));
  for (const char* name : {"right", "none"}) {
    config.set = name;
    EXPECT_THROW(resolve(config, "sheet", mesh, 10), Error);
  }
}

/// Of all nodes that are held or driven, J.
double work_of(const BoundarySet& set, const NodeField& f, const std::vector<double>& mass, const NodeField& before, const NodeField& after, double dt) {
  double sum = 0;
  for (std::size_t k = 0; k < set.nodes().size(); ++k) {
    const int i = set.nodes()[k];
    sum += 0.5 * set.reaction_impulse(static_cast<int>(k), f[i], mass[i], before[i], after[i], dt).dot(before[i] + after[i]);
  }
  return sum;
}

TEST(BoundarySet, work_closes_the_balance_of_kinetic_energy) {
  // Nodes under arbitrary forces, one driven on a skew plane, one held, one free.
  BoundarySet set(
      {driven({3, 0, 1}, {-5, 0, 2}, {"x", "z"}, {0}), symmetric({1, 2, 0.5}, {1}), fixed({}, {2})}, 3);
  const std::vector<double> mass{0.5, 2, 3, 1};
  const double dt = 1e-2;
  const auto kinetic = [&](const NodeField& v) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += 0.5 * mass[i] * v[i].squaredNorm();
    return sum;
  };
  NodeField v{Node(1, 2, 3, 0), Node(-1, 0, 2, 0), Node(4, 0, 0, 0), Node(0, 1, 0, 0)};
  double applied = 0, prescribed = 0;
  const double start = kinetic(v);
  for (int step = 0; step < 100; ++step) {
    NodeField f(4);
    for (int i = 0; i < 4; ++i)
      f[i] = 20 * Node(std::sin(step + i), std::cos(2 * step - i), std::sin(3. * i), 0);
    const NodeField before = v;
    for (int i = 0; i < 4; ++i) v[i] += dt / mass[i] * f[i];
    set.apply_velocity(step * dt, dt, v, v);
    for (int i = 0; i < 4; ++i) applied += 0.5 * dt * f[i].dot(before[i] + v[i]);
    prescribed += work_of(set, f, mass, before, v, dt);
  }
  EXPECT_GT(std::abs(prescribed), 1);
  EXPECT_NEAR(kinetic(v) - start, applied + prescribed, 1e-12 * (std::abs(applied) + std::abs(prescribed)));
}

TEST(BoundarySet, a_plane_of_symmetry_does_no_work) {
  BoundarySet set({symmetric({1, 2, -1}, {0})}, 3);
  const std::vector<double> mass{2};
  NodeField v{Node(1, 0, 1, 0)};  // on the plane
  const NodeField f{Node(5, -3, 8, 0)}, before = v;
  v[0] += 0.1 / mass[0] * f[0];
  set.apply_velocity(0, 0, v, v);
  EXPECT_NEAR(work_of(set, f, mass, before, v, 0.1), 0, 1e-14);
  EXPECT_GT(set.reaction_impulse(0, f[0], 2, before[0], v[0], 0.1).norm(), 0.1);
}

// ---- sets that turn

ResolvedBoundary turning(const Vec3& spin_deg_s, const Vec3& centre, std::vector<std::string> axes, const std::vector<Vec3>& places) {
  BoundaryConfig config;
  config.set = "turned";
  config.kind = "velocity";
  config.axes = std::move(axes);
  config.times = {0};
  config.spins_deg_s = {spin_deg_s};
  config.centre = centre;
  ResolvedBoundary boundary{config, "bar", {}, places};
  for (std::size_t i = 0; i < places.size(); ++i) boundary.nodes.push_back(static_cast<int>(i));
  return boundary;
}

TEST(BoundarySet, a_turning_set_keeps_its_shape_and_goes_with_its_centre) {
  // A thousand turns about a skew axis while the centre moves on, 50 steps a turn: no node comes nearer or goes away.
  const Vec3 axis = Vec3(1, 2, 2) / 3, centre(0.3, -1, 2), along(3, 0, -1);
  const std::vector<Vec3> places{{1, 0, 0}, {0.3, -1, 2.5}, {-2, 0.1, 4}};
  ResolvedBoundary boundary = turning(360 * axis, centre, {}, places);
  boundary.config.velocities = {along};
  BoundarySet set({boundary}, 3);
  NodeField x, v(3, Node(9, 9, 9, 0));
  for (const Vec3& place : places) x.push_back(node(place));
  const double dt = 0.02;
  for (int step = 0; step < 50010; ++step) {
    set.apply_velocity(step * dt, dt, x, v);
    for (int i = 0; i < 3; ++i) x[i] += dt * v[i];
  }
  // 1000.2 turns: a fifth of one is left. Rodrigues' formula.
  const double a = 2 * M_PI / 5, time = 50010 * dt;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = places[i] - centre;
    const Vec3 turned = std::cos(a) * r + std::sin(a) * axis.cross(r) + (1 - std::cos(a)) * axis.dot(r) * axis;
    EXPECT_LT((vec3(x[i]) - centre - time * along - turned).norm(), 1e-9);
  }
}

TEST(BoundarySet, a_turning_set_leaves_other_axes_free) {
  BoundarySet set({turning({0, 0, 180}, {0, 0, 0}, {"x", "y"}, {{2, 0, 1}})}, 3);
  NodeField v{Node(5, 5, 5, 0)};
  const NodeField x{Node(2, 0, 1, 0)};
  set.apply_velocity(0, 0, x, v);  // dt = 0: w x r
  EXPECT_LT((v[0] - Node(0, 2 * M_PI, 5, 0)).norm(), 1e-12);
}

// A trajectory rests at its knots; what it asks for between them is looked at.
TEST(BoundarySet, a_trajectory_agrees_with_what_it_leaves_alone) {
  ResolvedBoundary turns = turning(Vec3::Zero(), Vec3::Zero(), {}, {{0, 2, 3}}), goes = driven({0, 0, 0}, {0, 0, 0}, {}, {0});
  for (ResolvedBoundary* each : {&turns, &goes}) {
    each->config.kind = "trajectory";
    each->config.velocities.clear();
    each->config.spins_deg_s.clear();
  }
  turns.config.times = {0, 2};
  turns.config.rotations_deg = {Vec3::Zero(), Vec3(0, 0, 90)};
  goes.config.positions = {Vec3::Zero(), Vec3(0.8, -0.6, 0)};
  for (const char* profile : {"", "linear", "smooth", "spline"}) {
    turns.config.profile = goes.config.profile = profile;
    EXPECT_NE(refusal({turns, fixed({"x"}, {0})}).find("where the set turns"), std::string::npos) << profile;
    EXPECT_EQ(refusal({turns, fixed({"z"}, {0})}), "") << profile;
    EXPECT_NE(refusal({goes, fixed({"x"}, {0})}), "") << profile;
    EXPECT_EQ(refusal({goes, symmetric(Vec3(0.6, 0.8, 0), {0})}), "") << profile;
  }
}

TEST(BoundarySet, a_turn_agrees_with_what_it_leaves_alone) {
  const Vec3 z(0, 0, 90), origin = Vec3::Zero();
  const std::vector<Vec3> on_axis{{0, 0, 3}}, off_axis{{0, 2, 3}};
  // Along its axis a turn asks for nothing, and of a node on the axis for nothing either.
  EXPECT_EQ(refusal({turning(z, origin, {}, off_axis), fixed({"z"}, {0})}), "");
  EXPECT_EQ(refusal({turning(z, origin, {}, on_axis), fixed({}, {0})}), "");
  EXPECT_EQ(refusal({turning(z, origin, {}, off_axis), turning(z, origin, {"x"}, off_axis)}), "");
  // At the start this node does not move along y. Later it would.
  for (bool turn_first : {true, false}) {
    std::vector<ResolvedBoundary> both{turning(z, origin, {}, off_axis), fixed({"y"}, {0})};
    if (!turn_first) std::swap(both[0], both[1]);
    const std::string message = refusal(both);
    EXPECT_NE(message.find("where the set turns"), std::string::npos) << message;
    EXPECT_NE(message.find(turn_first ? "\"turned\"" : "\"held\""), std::string::npos) << message;
  }
  EXPECT_NE(refusal({turning(z, origin, {}, off_axis), turning(z, {0, 1, 0}, {}, off_axis)}), "");
  // The first node of a group agrees, the second does not.
  EXPECT_NE(refusal({turning(z, origin, {}, {{0, 0, 3}, {1, 0, 3}}), fixed({}, {0, 1})}), "");
}

}  // namespace
}  // namespace forming_sim
