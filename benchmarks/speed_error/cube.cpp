// The swinging cube: standing elastic waves of a unit cube whose faces at 0 move
// only along themselves, those at 1 only along their normals,
//   u = U0 cos(w t) (A s1 c2 c3, B c1 s2 c3, C c1 c2 s3),  s, c = sin, cos of pi X_i / 2.
// Its periods are exact in the linear limit: the error of elements, masses and steps
// alone, without plasticity or contact. It falls fourfold with half the cell size.
#include <cmath>

#include "speed_error/families.h"
#include "speed_error/problems.h"
#include "stepped_body.h"
#include "support/free_mesh.h"

namespace forming_sim::bench {
namespace {

struct Swing {
  const char* name;
  double nu;
  Vec3 shape;     ///< A, B, C
  double period;  ///< s
};

Node displacement(const Swing& swing, const Node& X) {
  const Vec3 a = 0.5 * M_PI * vec3(X);
  Node u = Node::Zero();
  for (int i = 0; i < 3; ++i) u[i] = swing.shape[i] * std::sin(a[i]) * std::cos(a[(i + 1) % 3]) * std::cos(a[(i + 2) % 3]);
  return u;
}

void swung(Report& report, const Swing& swing, const Family& family, int cells, double safety, const std::string& also = "") {
  BlankConfig blank;
  blank.shape = "plate";
  blank.pattern = family.pattern;
  blank.length = blank.width = blank.thickness = 1;
  blank.cells_along = blank.cells_across = blank.cells_through = cells;
  const Mesh mesh = is_free(family) ? free_box(Vec3::Ones(), 1.0 / cells) : generate_blank(blank);
  MaterialConfig material;
  material.density = 1100;
  material.youngs_modulus = 17e6;
  material.poissons_ratio = swing.nu;
  const Clock clock;
  SteppedBody body(mesh, material, family.average);
  NodeField shape;
  for (const Node& X : body.X) shape.push_back(displacement(swing, X));
  for (std::size_t n = 0; n < shape.size(); ++n) {
    body.x[n] += 1e-5 * shape[n];
    for (int i = 0; i < 3; ++i)
      for (int face = 0; face < 3; ++face)
        if (body.X[n][face] < 1e-9 ? face == i : body.X[n][face] > 1 - 1e-9 && face != i) body.free[n][i] = 0;
  }
  // The period: between the first and the third time that the swing's share passes zero.
  const double dt = safety * body.stable_step();
  std::vector<double> zeros;
  double before = 1;
  long steps = 0;
  while (zeros.size() < 3) {
    body.step(dt);
    ++steps;
    double now = 0;
    for (std::size_t n = 0; n < shape.size(); ++n) now += body.mass()[n] * shape[n].dot(body.x[n] - body.X[n]);
    if (steps > 1 && (now > 0) != (before > 0)) zeros.push_back(dt * (static_cast<double>(steps) - now / (now - before)));
    before = now;
  }
  report.add({family.name + also, std::to_string(cells) + " a side", size_of(mesh, steps, clock.seconds()), {1e3 * (zeros[2] - zeros[0])}});
}

}  // namespace

void cube_problem(Report& report) {
  const Swing swings[] = {{"cube shearing", .3, {1, 1, -2}, 29.954}, {"cube breathing", .3, {1, 1, 1}, 16.011}, {"cube shearing nu .45", .45, {1, 1, -2}, 31.635}};
  for (const Swing& swing : swings) {
    report.begin(swing.name, "Swinging cube, linear elastic", {{"period, ms", swing.period, 0.01}});
    for (const Family& family : kFamilies)
      if (family.dimension == 3)
        for (int cells : {2, 4, 8, 16}) {
          if (cells > 8 && family.pattern == std::string("fine")) continue;  // a second and more
          swung(report, swing, family, cells, 0.9);
        }
    for (int cells : {2, 4, 8}) swung(report, swing, kFamilies[4], cells, 0.3, ", step safety 0.3");
  }
}

}  // namespace forming_sim::bench
