// A thick sphere under inner pressure, perfectly plastic: where is the front of the
// plastic zone at which pressure? A quarter of the section, the upper half of the sphere.
#include <gtest/gtest.h>

#include "support/sphere.h"

namespace forming_sim {
namespace {

using namespace sphere;

/// Largest error of the pressure at which the front passes .4, .6, .8 and 1 m (the
/// elements within a cell of there), relative.
double front_error(int cells, const std::string& pattern) {
  const double last = exact_pressure(kOuter), duration = kDuration;
  OneBody run = section(cells, pattern);
  press(run, "left", last);
  const Mesh& mesh = run.model.bodies[0].mesh;
  auto sim = run.start(2);
  std::vector<double> at(sim->elements().size(), 0.0);  // pressure at first yield
  while (sim->step()) {
    if (sim->steps() % 20 != 0) continue;
    const std::vector<double> strain = sim->plastic_strain();
    for (std::size_t e = 0; e < at.size(); ++e)
      if (at[e] == 0 && strain[e] > 0) at[e] = last * sim->time() / duration;
  }
  EXPECT_LT(sim->balance_error(), 0.01);
  double worst = 0;
  const double cell = std::pow(kOuter / kInner, 1.0 / cells);
  for (double c : {0.4, 0.6, 0.8, 1.0}) {
    double found = 0, exact = 0;
    for (std::size_t e = 0; e < at.size(); ++e) {
      const auto& n = sim->elements()[e];
      const Vec3 middle = (mesh.nodes[n[0]] + mesh.nodes[n[1]] + mesh.nodes[n[2]]) / 3;
      if (middle.norm() < c / cell || middle.norm() > c * cell) continue;
      found += at[e] > 0 ? at[e] : last;
      exact += exact_pressure(middle.norm());
    }
    std::cout << "  front at " << c << " m: pressure off by " << 100 * (found / exact - 1) << " %\n";
    worst = std::max(worst, std::abs(found / exact - 1));
  }
  return worst;
}

TEST(ThickSphere, ThePlasticFrontMovesAtTheRightPressure) {
  const double coarse = front_error(10, "fine"), fine = front_error(20, "fine");
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, coarse);
}

TEST(ThickSphere, OnePointQuadrilaterals) {
  const double coarse = front_error(10, "one_point"), fine = front_error(20, "one_point");
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, coarse);
}

TEST(ThickSphere, TwoTrianglesACell) { EXPECT_LT(front_error(16, "coarse"), 0.02); }

}  // namespace
}  // namespace forming_sim
