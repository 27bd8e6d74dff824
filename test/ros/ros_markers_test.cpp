// What is drawn: within its budget, constant in count, fit for rviz.
#include "forming_sim/ros/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "forming_sim/ros/colour.h"

namespace forming_sim {
namespace {

/// A section of n x m squares of two triangles, 20 mm long.
RunShape section(int n, int m) {
  RunShape shape;
  shape.scene = "test";
  shape.dimension = 2;
  const double h = 0.02 / n;
  for (int j = 0; j <= m; ++j) for (int i = 0; i <= n; ++i) shape.initial_positions.push_back(node({i * h, j * h, 0}));
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      shape.elements.push_back({a, b, c, -1});
      shape.elements.push_back({a, c, d, -1});
    }
  }
  shape.bodies = {"sheet"};
  shape.first_element = {0};
  ToolModel plane;
  plane.name = "floor";
  plane.normal = Vec3::UnitY();
  shape.tools.push_back(plane);
  return shape;
}

RunFrame at_rest(const RunShape& shape) {
  RunFrame frame;
  frame.positions = shape.initial_positions;
  frame.plastic_strain.assign(shape.elements.size(), 0.25);
  frame.tools.resize(shape.tools.size());
  return frame;
}

const visualization_msgs::Marker& find(const visualization_msgs::MarkerArray& array, const std::string& ns, int id) {
  for (const auto& m : array.markers) {
    if (m.ns == ns && m.id == id && m.action != visualization_msgs::Marker::DELETEALL) return m;
  }
  throw std::runtime_error("no marker " + ns);
}

TEST(RosDisplayMesh, DrawsEverythingWithinItsBudget) {
  const RunShape shape = section(20, 4);
  const DisplayMesh mesh(2, shape.initial_positions, shape.elements, {}, 1000);
  EXPECT_EQ(mesh.triangles().size(), shape.elements.size());
  EXPECT_EQ(mesh.drawn_nodes().size(), shape.initial_positions.size());
}

TEST(RosDisplayMesh, JoinsNodesAboveItsBudget) {
  const RunShape shape = section(200, 20);
  const DisplayMesh mesh(2, shape.initial_positions, shape.elements, {}, 1000);
  EXPECT_LE(mesh.triangles().size(), 1000u);
  EXPECT_GE(mesh.triangles().size(), 300u) << "the budget is to be used";
  for (const auto& t : mesh.triangles()) {
    EXPECT_EQ(std::set<int>(t.begin(), t.end()).size(), 3u);
  }
  // Nodes of the mesh itself, so that they move with it, to its very ends.
  double last = 0;
  for (const int n : mesh.drawn_nodes()) last = std::max(last, shape.initial_positions.at(n).x());
  EXPECT_GT(last, 0.0195);
}

TEST(RosDisplayMesh, NodeMeansTakeTheElementsAround) {
  const RunShape shape = section(1, 1);
  const DisplayMesh mesh(2, shape.initial_positions, shape.elements, {}, 10);
  const auto means = mesh.node_means({1, 3});
  EXPECT_EQ(means, (std::vector<double>{2, 1, 3, 2}));  // the diagonal is shared
}

TEST(RosMarkers, FirstMessageClearsAndCountsStayConstant) {
  const RunShape shape = section(20, 4);
  RunMarkers markers(shape, {});
  RunFrame frame = at_rest(shape);
  const auto first = markers.at(frame, ros::Time(1));
  EXPECT_EQ(first.markers.front().action, visualization_msgs::Marker::DELETEALL);
  for (Node& x : frame.positions) x *= 1.1;
  const auto second = markers.at(frame, ros::Time(2));
  EXPECT_EQ(second.markers.size() + 1, first.markers.size());
  const auto& sheet = find(second, "sheet", 0);
  EXPECT_EQ(sheet.points.size(), find(first, "sheet", 0).points.size());
  EXPECT_EQ(sheet.points.size(), sheet.colors.size());
  EXPECT_EQ(sheet.points.size(), 3 * shape.elements.size());
  EXPECT_EQ(sheet.color.a, 1);
  EXPECT_NEAR(sheet.points[1].x, 1.1e-3, 1e-12);
}

TEST(RosMarkers, ToolsAreTranslucentUntilTheyLeave) {
  const RunShape shape = section(20, 4);
  RunMarkers markers(shape, {});
  RunFrame frame = at_rest(shape);
  frame.tools[0].position = Vec3(0, -0.5, 0);
  const auto there = markers.at(frame, ros::Time(1));
  EXPECT_LT(find(there, "tools", 0).color.a, 1);
  EXPECT_EQ(find(there, "tools", 0).pose.position.y, -0.5);
  EXPECT_FALSE(find(there, "tool_edges", 0).points.empty());
  frame.tools[0].present = false;
  const auto gone = markers.at(frame, ros::Time(2));
  EXPECT_EQ(find(gone, "tools", 0).action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(find(gone, "tool_edges", 0).action, visualization_msgs::Marker::DELETE);
}

TEST(RosMarkers, BudgetCountsTools) {
  RunShape shape = section(200, 20);
  MarkerOptions options;
  options.triangle_budget = 500;
  const RunMarkers markers(shape, options);
  EXPECT_LE(markers.triangle_count(), 500u);
}

// A line of very many pieces is drawn by fewer, of its own points to its very ends, and leaves the sheet its share.
TEST(RosMarkers, ALongLineIsThinned) {
  RunShape shape = section(20, 4);
  ToolModel line;
  line.name = "line";
  line.mesh.dimension = 2;
  for (int k = 0; k <= 20000; ++k) {
    line.mesh.nodes.push_back(Vec3(1e-6 * k, 0, 0));
    Facet f;
    f.nodes = {k, k + 1, -1};
    if (k < 20000) line.mesh.surface.push_back(f);
  }
  shape.tools = {line};
  MarkerOptions options;
  options.triangle_budget = 500;
  RunMarkers markers(shape, options);
  EXPECT_LE(markers.triangle_count(), 500u);
  const auto array = markers.at(at_rest(shape), ros::Time(1));
  EXPECT_GT(find(array, "sheet", 0).points.size(), 3 * 100u);
  const auto& edges = find(array, "tool_edges", 0);
  EXPECT_EQ(edges.points.front().x, 0);
  EXPECT_EQ(edges.points.back().x, line.mesh.nodes.back().x());
  EXPECT_GT(edges.points.size(), 2 * 50u);
}

// A viewer that was busy when a run began sees its last message alone.
TEST(RosMarkers, EveryMessageTakesAwayWhatEarlierRunsLeft) {
  RunShape many = section(2, 2), one = section(2, 2);
  many.tools.resize(3, many.tools.front());
  RunMarkers before(many, {}), next(one, {}), last(one, {});
  next.follow(before);
  last.follow(next);
  for (int k = 0; k < 3; ++k) {
    const auto array = last.at(at_rest(one), ros::Time(1 + k));
    for (const char* ns : {"tools", "tool_edges"}) {
      EXPECT_EQ(find(array, ns, 0).action, visualization_msgs::Marker::ADD);
      for (int id : {1, 2}) EXPECT_EQ(find(array, ns, id).action, visualization_msgs::Marker::DELETE);
    }
  }
}

TEST(RosMarkers, LegendNamesTheRange) {
  const RunShape shape = section(2, 2);
  RunMarkers running(shape, {});
  EXPECT_EQ(find(running.at(at_rest(shape), ros::Time(1)), "legend", 3).text, "0.25");
  MarkerOptions fixed;
  fixed.colour_max = 0.5;
  RunMarkers markers(shape, fixed);
  const auto array = markers.at(at_rest(shape), ros::Time(1));
  EXPECT_EQ(find(array, "legend", 3).text, "0.5");
  const auto half = scale_colour(0.5);
  EXPECT_NEAR(find(array, "sheet", 0).colors[0].g, half.g, 1e-6);
}

/// The markers of a frame whose sheet is coloured by that field; its legend has this title and this upper end.
visualization_msgs::MarkerArray coloured(const RunShape& shape, const RunFrame& frame, const std::string& by, const std::string& title, const std::string& most) {
  MarkerOptions options;
  options.colour_by = by;
  const visualization_msgs::MarkerArray array = RunMarkers(shape, options).at(frame, ros::Time(1));
  EXPECT_EQ(find(array, "legend", 1).text, title);
  EXPECT_EQ(find(array, "legend", 3).text, most);
  return array;
}

TEST(RosMarkers, ContactCanColour) {
  const RunShape shape = section(2, 2);
  RunFrame frame = at_rest(shape);
  frame.contact_pressure.assign(frame.positions.size(), 0.0);
  frame.contact_gap = frame.contact_pressure;
  for (std::size_t n = 0; n < frame.positions.size(); ++n) frame.contact_pressure[n] = n == 4 ? 2e8 : 0;
  const auto array = coloured(shape, frame, "contact_pressure", "contact pressure, Pa", "2e+08");
  const auto most = scale_colour(1);
  const auto& sheet = find(array, "sheet", 0);
  EXPECT_TRUE(std::any_of(sheet.colors.begin(), sheet.colors.end(), [&](const auto& c) { return c.r == most.r; }));
}

TEST(RosMarkers, ThinningColoursTheSheetsAndNothingElse) {
  const RunShape shape = section(2, 2);
  RunFrame frame = at_rest(shape);
  frame.thinning.assign(frame.positions.size(), std::nan(""));
  frame.thinning[4] = 0.25;
  frame.thinning[5] = -0.1;
  const auto array = coloured(shape, frame, "thinning", "thinning", "0.25");
  const auto most = scale_colour(1), none = scale_colour(0);
  const auto& sheet = find(array, "sheet", 0);
  for (std::size_t i = 0; i < sheet.points.size(); ++i) {
    const Vec3 thinned = vec3(frame.positions[4]);
    const bool there = sheet.points[i].x == thinned.x() && sheet.points[i].y == thinned.y();
    EXPECT_EQ(sheet.colors[i].r, there ? most.r : none.r) << i;
  }
}

TEST(RosMarkers, ThePartOfTheFormingLimitColoursTheSheets) {
  const RunShape shape = section(2, 2);
  RunFrame frame = at_rest(shape);
  coloured(shape, frame, "limit_ratio", "limit_ratio", "0");
  frame.limit_ratio.assign(frame.positions.size(), std::nan(""));
  frame.limit_ratio[4] = 0.9;
  coloured(shape, frame, "limit_ratio", "limit_ratio", "0.9");
}

TEST(RosMarkers, DamageColoursTheBodiesThatHaveIt) {
  const RunShape shape = section(2, 2);
  RunFrame frame = at_rest(shape);
  coloured(shape, frame, "damage", "damage", "0");
  frame.damage.assign(shape.elements.size(), std::nan(""));
  frame.damage[0] = 0.5;
  const auto array = coloured(shape, frame, "damage", "damage", "0.5");
  const auto none = scale_colour(0);
  const auto& sheet = find(array, "sheet", 0);
  EXPECT_TRUE(std::any_of(sheet.colors.begin(), sheet.colors.end(), [&](const auto& c) { return c.r != none.r; }));
  EXPECT_TRUE(std::any_of(sheet.colors.begin(), sheet.colors.end(), [&](const auto& c) { return c.r == none.r; }));
}

TEST(RosMarkers, FramesWithoutNumbersAreKnown) {
  const RunShape shape = section(2, 2);
  RunFrame frame = at_rest(shape);
  EXPECT_TRUE(frame.is_finite());
  frame.positions[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(frame.is_finite());
  frame = at_rest(shape);
  frame.plastic_strain[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(frame.is_finite());
}

TEST(RosColour, ScaleIsOpaqueAndClamped) {
  for (const double f : {-1.0, 0.0, 0.5, 1.0, 7.0, std::nan("")}) EXPECT_EQ(scale_colour(f).a, 1);
  EXPECT_EQ(scale_colour(7).r, scale_colour(1).r);
  EXPECT_GT(scale_colour(1).r, scale_colour(0).r);
}

}  // namespace
}  // namespace forming_sim
