// Bodies of one-point cells against known solutions.
#include <gtest/gtest.h>

#include "support/cook.h"
#include "support/taylor.h"

namespace forming_sim {
namespace {

/// Elements moved by hand: explicit steps with forces and held directions of one's own.
struct Stepped {
  BodyModel body;
  NodeField X, x, v, f;
  Elements elements;
  double dt = 0;
  explicit Stepped(const Mesh& mesh, const MaterialConfig& material)
      : body(body_of(mesh, material)), X(positions_of(mesh)), x(X), v(X.size(), Node::Zero()), f(v), elements({body}, mesh.dimension, X, {}, 1) {
    int element = 0;
    elements.stable_step(x, v, dt, element);
    dt *= 0.9;
  }
};

// VERIFICATION 16: the unit cube swings in x = X + U0 cos(wt)(A s1 c2 c3, B c1 s2 c3, C c1 c2 s3); its
// error of the period falls with the square of the cell.
TEST(OnePointBodies, ASwingingCubeConvergesWithTheSquareOfTheCell) {
  MaterialConfig m;
  m.density = 1100;
  m.youngs_modulus = 17e6;
  struct Mode { double nu; Vec3 A; double period; };
  for (const Mode& mode : {Mode{0.3, {1, 1, -2}, 29.954e-3}, {0.3, {1, 1, 1}, 16.011e-3}, {0.45, {1, 1, -2}, 31.635e-3}, {0.45, {1, 1, 1}, 9.538e-3}}) {
    m.poissons_ratio = mode.nu;
    double error[2];
    for (int level = 0; level < 2; ++level) {
      const int n = level == 0 ? 4 : 8;
      BlankConfig blank;
      blank.shape = "plate";
      blank.length = blank.width = blank.thickness = 1;
      blank.cells_along = blank.cells_across = blank.cells_through = n;
      blank.pattern = "one_point";
      Stepped cube(generate_blank(blank), m);
      const auto shape = [&](const Node& X) {
        const double h = M_PI / 2;
        Vec3 s, c;
        for (int i = 0; i < 3; ++i) s[i] = std::sin(h * X[i]), c[i] = std::cos(h * X[i]);
        return Vec3(mode.A[0] * s[0] * c[1] * c[2], mode.A[1] * c[0] * s[1] * c[2], mode.A[2] * c[0] * c[1] * s[2]);
      };
      for (std::size_t i = 0; i < cube.X.size(); ++i) cube.x[i] = cube.X[i] + 1e-6 * node(shape(cube.X[i]));
      double amplitude = 0, time = 0, crossing = 0, norm = 0;
      for (const Node& X : cube.X) norm += shape(X).squaredNorm();
      for (double before = 1; crossing == 0; time += cube.dt) {  // to the first zero, a quarter of the period
        amplitude = 0;
        for (std::size_t i = 0; i < cube.X.size(); ++i) amplitude += vec3(cube.x[i] - cube.X[i]).dot(shape(cube.X[i])) / (1e-6 * norm);
        if (amplitude < 0) crossing = time - cube.dt * amplitude / (amplitude - before);
        before = amplitude;
        cube.elements.forces(cube.x, cube.v, cube.dt, cube.dt, cube.f);
        for (std::size_t i = 0; i < cube.X.size(); ++i) {
          cube.v[i] += (time == 0 ? 0.5 : 1) * cube.dt / cube.elements.nodal_mass()[i] * cube.f[i];
          for (int a = 0; a < 3; ++a) {
            const bool normal = cube.X[i][a] < 1e-9, tangent = cube.X[i][(a + 1) % 3] > 1 - 1e-9 || cube.X[i][(a + 2) % 3] > 1 - 1e-9;
            if (normal || tangent) cube.v[i][a] = 0;
          }
          cube.x[i] += cube.dt * cube.v[i];
        }
      }
      error[level] = 4 * crossing / mode.period - 1;
    }
    std::printf("  nu %.2f, period %.3f ms: error %+.4f at 4 cells, %+.4f at 8\n", mode.nu, mode.period * 1e3, error[0], error[1]);
    EXPECT_LT(std::fabs(error[1]), 0.01);
    EXPECT_LT(std::fabs(error[1]), 0.35 * std::fabs(error[0]));
  }
}

// VERIFICATION 17: Cook's membrane, elastic-plastic, plane strain; its top corner rises by 6.95 +- .1 mm. Loaded slowly,
// it comes to rest on the way up: nothing of its rise is an overshoot, and under its full load it does not creep.
TEST(OnePointBodies, CooksMembrane) {
  const CookRise rise = cook_rise(32, "one_point");
  std::printf("  top corner rises by %.3f mm, at most %.3f; %.3f when the load was full\n", rise.end, rise.highest, rise.loaded);
  EXPECT_NEAR(rise.end, kCookRise, 0.1);
  EXPECT_LT(rise.highest - rise.end, 0.005);
  EXPECT_LT(std::fabs(rise.end - rise.loaded), 0.02);
}

// VERIFICATION 18, a face that stays on its wall; a quarter of the bar at 6 cells a radius, and its section turned about the axis at 8.
TEST(OnePointBodies, TaylorBar) {
  for (int dimension : {3, 2}) {
    const OneBody run = taylor_bar(dimension, dimension == 3 ? 6 : 8, "one_point", "cell");
    auto sim = run.start(2);
    const std::atomic<bool> cancel{false};
    const Outcome outcome = sim->run(cancel);
    EXPECT_EQ(outcome.code, Code::success) << outcome.message;
    EXPECT_LT(sim->balance_error(), 0.01);
    const TaylorShape shape = taylor_shape(sim->positions(), dimension);
    std::printf("  length %.3f mm, radius %.3f mm, balance %.1e, %.1f s\n", shape.length * 1e3, shape.radius * 1e3, sim->balance_error(), sim->wall_time());
    EXPECT_NEAR(shape.length, 21.42e-3, 0.005 * 21.42e-3);
    EXPECT_NEAR(shape.radius, 7.22e-3, 0.02 * 7.22e-3);
  }
}

}  // namespace
}  // namespace forming_sim
