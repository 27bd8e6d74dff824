// The sharpest bend of a sheet: what a surface turns by from one cell to the next, on the outside.
#include <gtest/gtest.h>

#include "forming_sim/results/sharp_bend.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// A sheet of cells 1 mm long is bent so that each of its middle cells turns by so many degrees: nodes at the angle of their column.
NodeField bent(const BodyModel& body, double degrees, double length) {
  const int up = body.mesh.dimension - 1;  // the axis of the thickness
  NodeField x;
  constexpr double mm = 1e-3;
  const double radius = mm / (degrees * M_PI / 180), half = 5 * mm;
  for (const Vec3& X : body.mesh.nodes) {
    const double s = X.x() - length / 2, on = std::clamp(s, -half, half), angle = on / radius, r = radius + X[up];
    Vec3 place = X;
    place.x() = r * std::sin(angle) + (s - on) * std::cos(angle);
    place[up] = r * std::cos(angle) - radius - (s - on) * std::sin(angle);
    x.push_back(node(place));
  }
  return x;
}

}  // namespace

TEST(SharpBend, IsWhatASheetTurnsByFromCellToCell) {
  const double length = 40e-3;
  for (int dimension : {2, 3})
    for (const char* pattern : {"coarse", "one_point"}) {
      BlankConfig blank = strip_of(length, .5e-3, 40, 2);
      blank.pattern = pattern;
      if (dimension == 3) blank.shape = "plate", blank.width = 4e-3, blank.cells_across = 4;
      const BodyModel body = body_of(generate_blank(blank), aluminium());
      for (double degrees : {3., 12., 25.}) {
        const SharpBend bend = sharpest_bend(body, bent(body, degrees, length));
        EXPECT_NEAR(bend.degrees, degrees, 1e-6) << dimension << pattern;
        EXPECT_LT(std::abs(bend.place.x()), 5e-3);
      }
      NodeField level;
      for (const Vec3& X : body.mesh.nodes) level.push_back(node(X));
      EXPECT_NEAR(sharpest_bend(body, level).degrees, 0, 1e-9) << "its own edges are no bends";
    }
}

// The end of a rolled sheet bulges by tens of degrees from cell to cell.
TEST(SharpBend, TheShapeOfAnEdgeIsNone) {
  for (int dimension : {2, 3}) {
    BlankConfig blank = strip_of(40e-3, 4e-3, 40, 8);
    blank.pattern = "coarse";
    if (dimension == 3) blank.shape = "plate", blank.width = 30e-3, blank.cells_across = 30;
    const BodyModel body = body_of(generate_blank(blank), aluminium());
    NodeField x;
    for (const Vec3& X : body.mesh.nodes) {
      const double z = X[dimension - 1] / 4e-3 - 0.5;
      Vec3 place = X;
      if (X.x() > 39.9e-3) place.x() += 2e-3 * (1 - 4 * z * z);
      x.push_back(node(place));
    }
    EXPECT_NEAR(sharpest_bend(body, x).degrees, 0, 1e-9);
  }
}

TEST(SharpBend, OfWhatIsNoSheetIsNotAsked) {
  const BodyModel block = body_of(generate_blank(strip_of(4e-3, 4e-3, 8, 8)), aluminium());
  NodeField x;
  for (const Vec3& X : block.mesh.nodes) x.push_back(node(X.x(), X.y() * (1 + 100 * X.x()), 0));
  EXPECT_EQ(sharpest_bend(block, x).degrees, 0);
}

}  // namespace forming_sim
