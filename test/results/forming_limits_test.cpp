// Strains of the middle of sheets against closed forms: what is bent is not strained, what is stretched is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/results/forming_limits.h"

namespace forming_sim {
namespace {

constexpr double kThickness = 1e-3, kLength = 20e-3;

/// A body that is no sheet with a limit, and a sheet that is one: of a strip in dimension 2, a plate in 3.
Model sheet(int dimension, bool axisymmetric = false, const std::string& pattern = "fine") {
  Model model;
  model.dimension = dimension;
  model.axisymmetric = axisymmetric;
  for (const bool limited : {false, true}) {
    BlankConfig blank;
    blank.shape = dimension == 2 ? "strip" : "plate";
    blank.length = kLength;
    blank.width = 4e-3;
    blank.thickness = kThickness;
    blank.cells_along = 20;
    blank.cells_across = 2;
    blank.cells_through = 2;
    blank.pattern = pattern;
    BodyModel body;
    body.name = limited ? "sheet" : "other";
    body.first_node = model.node_count();
    body.first_element = model.element_count();
    body.mesh = generate_blank(blank);
    body.node_count = static_cast<int>(body.mesh.nodes.size());
    body.element_count = body.mesh.simplex_count();
    if (limited) body.material.forming_limit = FormingLimitConfig{{-0.5, 0.5}, {0.2, 0.2}};
    model.bodies.push_back(body);
  }
  return model;
}

template <class Map> NodeField moved(const Model& model, Map&& map) {
  NodeField x;
  for (const BodyModel& body : model.bodies)
    for (const Vec3& X : body.mesh.nodes) x.push_back(node(map(X)));
  return x;
}

/// Over the facets that have one: least and greatest of the larger and of the smaller strain.
struct Range {
  double least_major = 1e9, most_major = -1e9, least_minor = 1e9, most_minor = -1e9;
  int count = 0;
};
Range range(const FormingLimits::State& state) {
  Range r;
  for (const SurfaceStrain& strain : state.strain) {
    if (std::isnan(strain.major)) continue;
    ++r.count;
    r.least_major = std::min(r.least_major, strain.major);
    r.most_major = std::max(r.most_major, strain.major);
    r.least_minor = std::min(r.least_minor, strain.minor);
    r.most_minor = std::max(r.most_minor, strain.minor);
  }
  return r;
}

// About y on a cylinder whose radius at the middle is R, and stretched across: chords of the middle are as long as those of a circle.
TEST(FormingLimits, TheMiddleOfABentSheetIsStretchedByItsPullAlone) {
  for (const std::string pattern : {"fine", "coarse", "one_point"}) {
    const Model model = sheet(3, false, pattern);
    const FormingLimits limits(model);
    const double R = 5e-3, across = 0.97, angle = 1.1 / R;  // radians a metre
    const double low = bounds(model.bodies[1].mesh).min().z();
    const NodeField x = moved(model, [&](const Vec3& X) {
      const double r = R + (X.z() - low - kThickness / 2), a = angle * X.x();
      return Vec3(r * std::sin(a), across * X.y(), r * std::cos(a));
    });
    const FormingLimits::State state = limits.at(x);
    const Range r = range(state);
    const double cell = kLength / 20, chord = std::log(2 * R * std::sin(0.5 * angle * cell) / cell);
    const double near = pattern == "fine" ? 2e-3 : 1e-9;  // the middles of its faces lie on the circle, off the chords
    EXPECT_NEAR(r.least_major, chord, near) << pattern;
    EXPECT_NEAR(r.most_major, chord, near) << pattern;
    EXPECT_NEAR(r.least_minor, std::log(across), near) << pattern;
    EXPECT_NEAR(r.most_minor, std::log(across), near) << pattern;
    EXPECT_GT(std::log((R + kThickness / 2) / R), 0.09);  // what bending does to a side
    ASSERT_EQ(state.greatest.size(), 1u);
    EXPECT_NEAR(state.greatest[0].value, chord / 0.2, 5 * near);
    EXPECT_EQ(state.beyond[0], 0);
    EXPECT_GE(state.greatest[0].element, model.bodies[1].first_element);
  }
}

TEST(FormingLimits, AStripInPlaneStrain) {
  const Model model = sheet(2);
  const FormingLimits limits(model);
  const NodeField x = moved(model, [](const Vec3& X) { return Vec3(1.3 * X.x(), X.y() / 1.3, 0); });
  const FormingLimits::State state = limits.at(x);
  const Range r = range(state);
  EXPECT_EQ(r.count, 40);
  EXPECT_NEAR(r.least_major, std::log(1.3), 1e-12);
  EXPECT_NEAR(r.most_minor, 0, 1e-12);
  EXPECT_NEAR(state.greatest[0].value, std::log(1.3) / 0.2, 1e-12);
  EXPECT_EQ(state.beyond[0], 1);
  for (int n = 0; n < model.bodies[1].first_node; ++n) EXPECT_TRUE(std::isnan(state.ratio[n]));
  for (int n = model.bodies[1].first_node; n < model.node_count(); ++n) EXPECT_NEAR(state.ratio[n], std::log(1.3) / 0.2, 1e-12);
}

TEST(FormingLimits, ARingIsStretchedAroundToo) {
  const Model model = sheet(2, true);
  const FormingLimits limits(model);
  const NodeField x = moved(model, [](const Vec3& X) { return Vec3(1.2 * X.x(), X.y() / 1.44, 0); });
  const Range r = range(limits.at(x));
  EXPECT_NEAR(r.least_major, std::log(1.2), 1e-12);
  EXPECT_NEAR(r.least_minor, std::log(1.2), 1e-12);
}

// The outer half by radius has three quarters of the disc.
TEST(FormingLimits, WhatIsBeyondIsAPartOfTheArea) {
  const Model model = sheet(2, true);
  ASSERT_EQ(bounds(model.bodies[1].mesh).min().x(), 0);
  const NodeField x = moved(model, [](const Vec3& X) { return Vec3(X.x() < kLength / 2 + 1e-9 ? X.x() : kLength / 2 + 1.5 * (X.x() - kLength / 2), X.y(), 0); });
  EXPECT_NEAR(FormingLimits(model).at(x).beyond[0], 0.75, 1e-9);
}

TEST(FormingLimits, ASheetShearedAlongItsMiddleIsNotStretched) {
  const Model model = sheet(2);
  const FormingLimits limits(model);
  const Range r = range(limits.at(moved(model, [](const Vec3& X) { return Vec3(X.x() + 0.8 * X.y(), X.y(), 0); })));
  EXPECT_NEAR(r.most_major, 0, 1e-12);
  EXPECT_NEAR(r.least_minor, 0, 1e-12);
}

TEST(FormingLimits, NoneWithoutACurve) {
  Model model = sheet(3);
  model.bodies[1].material.forming_limit.reset();
  const FormingLimits limits(model);
  EXPECT_FALSE(limits.any());
  EXPECT_TRUE(limits.at(moved(model, [](const Vec3& X) { return X; })).strain.empty());
}

}  // namespace
}  // namespace forming_sim
