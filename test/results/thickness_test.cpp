// Distance of the top nodes from the bottom surface, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
#include "forming_sim/element/sheet_sides.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/results/thickness.h"

namespace forming_sim {
namespace {

/// A strip of length pi/2 and thickness t as two rows of nodes.
Mesh strip(int cells, double t) {
  Mesh mesh;
  mesh.dimension = 2;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i <= cells; ++i) mesh.nodes.push_back(Vec3(i * M_PI / 2 / cells, row * t, 0));
  for (int i = 0; i <= cells; ++i) {
    mesh.sets["bottom"].push_back(i);
    mesh.sets["top"].push_back(cells + 1 + i);
  }
  for (int i = 0; i < cells; ++i) mesh.surface.push_back({{i, i + 1, -1}, 0});
  mesh.surface.push_back({{cells, 2 * cells + 1, -1}, 0});  // the end: not of the bottom
  return mesh;
}

/// A model of a body of `before` nodes that is no sheet, and of the sheet.
Model model_of(const Mesh& sheet, int before = 0) {
  Model model;
  model.dimension = sheet.dimension;
  Mesh other;
  other.nodes.assign(before, Vec3(7, 7, 7));
  for (const Mesh& mesh : {other, sheet}) {
    BodyModel body;
    body.first_node = model.node_count();
    body.node_count = static_cast<int>(mesh.nodes.size());
    body.mesh = mesh;
    model.bodies.push_back(body);
  }
  return model;
}

TEST(Thickness, OfABentSheetIsItsRadialDistance) {
  const int cells = 40, offset = 3;
  const double t = 0.1;
  const Mesh mesh = strip(cells, t);
  const Thickness thickness(model_of(mesh, offset));
  ASSERT_TRUE(thickness.any());
  NodeField flat(offset + mesh.nodes.size()), bent = flat;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& x = mesh.nodes[i];
    flat[offset + i] = node(x);
    bent[offset + i] = Node((1 + x.y()) * std::sin(x.x()), (1 + x.y()) * std::cos(x.x()), 0, 0);
  }
  EXPECT_DOUBLE_EQ(smallest(thickness.at(flat), thickness.top()).value(), t);
  // The bottom's chords lie within a chord's height of the arc.
  const double chord = 1 - std::cos(M_PI / 4 / cells);
  EXPECT_GE(smallest(thickness.at(bent), thickness.top()).value(), t - 1e-12);
  EXPECT_LE(smallest(thickness.at(bent), thickness.top()).value(), t + chord);

  bent[offset + cells + 1 + 7].head<3>() *= 1.05 / 1.1;  // one dent
  const double expected = 0.05;
  EXPECT_NEAR(smallest(thickness.at(bent), thickness.top()).value(), expected, chord);
  const std::vector<double> thinning = thickness.thinning(thickness.at(bent));
  for (int i = 0; i <= cells; ++i) {  // what lies below a node of the top is as thin as the sheet there
    EXPECT_NEAR(thinning[offset + cells + 1 + i], i == 7 ? 0.5 : 0, chord / t) << i;
    EXPECT_EQ(thinning[offset + i], thinning[offset + cells + 1 + i]) << i;
  }
  for (int i = 0; i < offset; ++i) EXPECT_TRUE(std::isnan(thinning[i]));
}

// A spiral of one and a half turns, whose turns lie a hundredth of the thickness from each other: the outer one's bottom on the inner one's top.
TEST(Thickness, OfACurledSheetIsThatThroughItsMetal) {
  const int cells = 400;
  const double t = 0.1, pitch = 1.01 * t, turns = 1.5;
  const Mesh mesh = strip(cells, t);  // bottom y = 0, along x
  double length = 0;
  for (const Vec3& x : mesh.nodes) length = std::max(length, x.x());
  NodeField curled;
  for (const Vec3& x : mesh.nodes) {
    const double angle = 2 * M_PI * turns * x.x() / length, r = 1 + pitch * angle / (2 * M_PI) + x.y();
    curled.push_back(Node(r * std::sin(angle), r * std::cos(angle), 0, 0));
  }
  const Thickness thickness(model_of(mesh));
  for (double value : thickness.at(curled)) EXPECT_NEAR(value, t, 2e-3 * t);
}

TEST(Thickness, OfASheetThatIsShearedFarIsAcrossIt) {
  const double t = 0.1;
  const Mesh mesh = strip(100, t);
  NodeField sheared;
  for (const Vec3& x : mesh.nodes) sheared.push_back(Node(x.x() + 9 * x.y(), x.y(), 0, 0));
  const std::vector<double> values = Thickness(model_of(mesh)).at(sheared);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (mesh.nodes[n].x() > 0.4) continue;  // the top hangs over
    EXPECT_NEAR(values[n], t, 1e-12) << n;
  }
}

/// Against the distance of all nodes of the top, in a sheet of several layers of uneven columns.
TEST(Thickness, BelowTheTopIsThatOfTheNearestNodeThere) {
  const int cells = 9, layers = 3;
  Mesh mesh;
  mesh.dimension = 2;
  for (int row = 0; row <= layers; ++row)
    for (int i = 0; i <= cells; ++i) mesh.nodes.push_back(Vec3(i + 0.2 * std::sin(3.0 * i + row), 0.5 * row / layers, 0));
  for (int i = 0; i <= cells; ++i) {
    mesh.sets["bottom"].push_back(i);
    mesh.sets["top"].push_back(layers * (cells + 1) + i);
  }
  for (int i = 0; i < cells; ++i) mesh.surface.push_back({{i, i + 1, -1}, 0});
  NodeField x;
  for (const Vec3& X : mesh.nodes) x.push_back(Node(X.x(), X.y() * (1 + 0.1 * std::sin(X.x())), 0, 0));
  const std::vector<double> values = Thickness(model_of(mesh)).at(x);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    int nearest = mesh.sets["top"][0];
    for (int top : mesh.sets["top"])
      if ((mesh.nodes[top] - mesh.nodes[n]).norm() < (mesh.nodes[nearest] - mesh.nodes[n]).norm()) nearest = top;
    EXPECT_NEAR(values[n], x[nearest].y(), 1e-12) << n;
  }
}

// Of a sheet whose lower half has been trimmed away at one end: what is left of the bottom lies beside the nodes there, not below them.
TEST(Thickness, WhereTheBottomIsGoneThereIsNone) {
  const int cells = 40;
  const double t = 0.1;
  Mesh mesh = strip(cells, t);
  for (int i = cells; i > 0; --i) mesh.surface.push_back({{cells + 1 + i, cells + i, -1}, 0});
  mesh.sets["bottom"].resize(cells / 2 + 1);
  const Thickness thickness(model_of(mesh));
  NodeField flat;
  for (const Vec3& x : mesh.nodes) flat.push_back(node(x));
  const std::vector<double> found = thickness.at(flat);
  for (int i = 0; i <= cells / 2; ++i) EXPECT_DOUBLE_EQ(found[cells + 1 + i], t) << i;
  for (int i = cells / 2 + 3; i <= cells; ++i) EXPECT_TRUE(std::isnan(found[cells + 1 + i])) << i << ": " << found[cells + 1 + i];
  EXPECT_LT(std::count_if(found.begin(), found.end(), [&](double value) { return value > 1.2 * t; }), 2);
  EXPECT_DOUBLE_EQ(thickness.initial(thickness.top()).value(), t);
}

TEST(Thickness, NeedsBothSetsAndFacetsOfTheBottom) {
  Mesh mesh = strip(4, 0.1);
  mesh.surface.resize(0);
  EXPECT_FALSE(Thickness(model_of(mesh)).any());
  mesh = strip(4, 0.1);
  mesh.sets.erase("top");
  EXPECT_FALSE(Thickness(model_of(mesh)).any());
}

TEST(Thickness, FindsTheNearestTriangleAsASearchOfAllDoes) {
  Mesh mesh;
  const int n = 8;
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.nodes.push_back(Vec3(i, j, side ? 2 + std::sin(1.3 * i + 0.7 * j) : 0.4 * std::sin(2.1 * i * j)));
  const int layer = (n + 1) * (n + 1);
  for (int k = 0; k < layer; ++k) {
    mesh.sets["bottom"].push_back(k);
    mesh.sets["top"].push_back(layer + k);
  }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      mesh.surface.push_back({{a, a + 1, b + 1}, 0});
      mesh.surface.push_back({{a, b + 1, b}, 0});
    }
  NodeField positions;
  for (const Vec3& x : mesh.nodes) positions.push_back(node(x));
  double expected = 1e300;
  for (int top : mesh.sets["top"])
    for (const Facet& f : mesh.surface)
      expected = std::min(expected, std::sqrt(closest_on_triangle(positions[top], positions[f.nodes[0]], positions[f.nodes[1]], positions[f.nodes[2]]).squared));
  const Thickness thickness(model_of(mesh));
  EXPECT_EQ(smallest(thickness.at(positions), thickness.top()), expected);
}

using Sides = std::pair<std::string, std::string>;

TEST(SheetSides, AreThoseOfTheWall) {
  BlankConfig blank;
  blank.shape = "strip";
  blank.length = 1, blank.thickness = 3, blank.cells_along = 2, blank.cells_through = 3;
  BodyModel body;
  const auto of = [&](double x, bool about_axis) {
    blank.origin.x() = x;
    body.mesh = generate_blank(blank);
    return sides_of_sheet(body, about_axis);
  };
  EXPECT_EQ(of(5, true), Sides("left", "right")) << "a tube";
  EXPECT_EQ(of(0, false), Sides("left", "right")) << "a wall in plane strain";
  EXPECT_EQ(of(0, true), Sides("bottom", "top")) << "a solid bar";
  for (const char* end : {"bottom", "top"}) {
    of(5, true);
    body.mesh.sets.erase(end);
    EXPECT_EQ(sides_of_sheet(body, true), Sides("left", "right")) << "a tube trimmed at its " << end;
  }
  of(5, true);
  body.mesh.sets["left"] = {0, 1};  // not one of its four sides
  EXPECT_EQ(sides_of_sheet(body, false), Sides("bottom", "top"));
  blank.thickness = 1.9;
  EXPECT_EQ(of(5, true), Sides("bottom", "top"));
  body.mesh.sets["inside"] = body.mesh.sets["outside"] = {0};  // a user's own
  EXPECT_EQ(sides_of_sheet(body, true), Sides("bottom", "top"));
  body.mesh.sets.erase("top");
  EXPECT_EQ(sides_of_sheet(body, true), Sides("inside", "outside"));
  body.mesh.sets.clear();
  EXPECT_EQ(sides_of_sheet(body, true), Sides());
  blank.shape = "tube";
  blank.radius = 5, blank.thickness = 1, blank.cells_around = 8;
  EXPECT_EQ(of(0, false), Sides("inside", "outside"));
}

}  // namespace
}  // namespace forming_sim
