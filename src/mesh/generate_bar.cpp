// A round bar as an O-grid: a core square with rounded sides, and between each of
// its sides and the circle a block of layers. A half keeps the blocks of x >= 0,
// a quarter those of x, y >= 0.
#include "generate_bar.h"

#include <cmath>
#include <map>
#include <tuple>

#include "forming_sim/mesh/split.h"

namespace forming_sim {
namespace {

constexpr double kCoreSide = 0.97;       // half side of the core over (radius * core cells / radius cells)
constexpr double kCoreRoundness = 0.45; // 0: a square, 1: a circle

// The section, in units of the radius; built once and swept along z.
class Section {
 public:
  Section(const std::string& portion, int cells_radius) {
    core_ = std::max(1, std::min(cells_radius - 1, static_cast<int>(std::lround(0.55 * cells_radius))));
    layers_ = cells_radius - core_;
    side_ = kCoreSide * core_ / cells_radius;
    first_i_ = portion == "full" ? -core_ : 0;
    first_j_ = portion == "quarter" ? 0 : -core_;
    // The diagonals of split cells match where a quadrilateral's edges 0-1 and 3-2,
    // and 0-3 and 1-2, point the same way as those of its neighbours. So every cell
    // counts i towards +x, j towards +y and layers outwards, right-handed.
    for (int j = first_j_; j < core_; ++j)
      for (int i = first_i_; i < core_; ++i)
        quads_.push_back({core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)});
    for (int l = 0; l < layers_; ++l) {
      for (int j = first_j_; j < core_; ++j) {  // right and left of the core
        quads_.push_back({ring(core_, j, l), ring(core_, j, l + 1), ring(core_, j + 1, l + 1), ring(core_, j + 1, l)});
        if (first_i_ < 0)
          quads_.push_back(
              {ring(-core_, j, l), ring(-core_, j + 1, l), ring(-core_, j + 1, l + 1), ring(-core_, j, l + 1)});
      }
      for (int i = first_i_; i < core_; ++i) {  // above and below it
        quads_.push_back({ring(i, core_, l), ring(i + 1, core_, l), ring(i + 1, core_, l + 1), ring(i, core_, l + 1)});
        if (first_j_ < 0)
          quads_.push_back(
              {ring(i, -core_, l), ring(i, -core_, l + 1), ring(i + 1, -core_, l + 1), ring(i + 1, -core_, l)});
      }
    }
  }

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Quad>& quads() const { return quads_; }
  const std::vector<char>& on_side() const { return on_side_; }

 private:
  Vec3 core_point(int i, int j) const {
    const double u = double(i) / core_, v = double(j) / core_;
    const Vec3 square(u, v, 0), disc(u * std::sqrt(1 - v * v / 2), v * std::sqrt(1 - u * u / 2), 0);
    return side_ * ((1 - kCoreRoundness) * square + kCoreRoundness * disc);
  }

  // Point of the circle beside point (i, j) of the core's rim, at even angles.
  Vec3 rim_point(int i, int j) const {
    const bool beside = std::abs(i) == core_;
    const double angle = M_PI / 4 * (beside ? double(j) : double(i)) / core_;
    const double near = std::cos(angle), along = std::sin(angle);
    return beside ? Vec3(std::copysign(near, i), along, 0) : Vec3(along, std::copysign(near, j), 0);
  }

  int add(int i, int j, int layer, const Vec3& x) {
    const auto [entry, is_new] = index_.try_emplace({i, j, layer}, static_cast<int>(points_.size()));
    if (is_new) {
      points_.push_back(x);
      on_side_.push_back(layer == layers_);
    }
    return entry->second;
  }
  int core(int i, int j) { return add(i, j, 0, core_point(i, j)); }
  int ring(int i, int j, int layer) {
    const double t = double(layer) / layers_;
    return add(i, j, layer, (1 - t) * core_point(i, j) + t * rim_point(i, j));
  }

  int core_, layers_, first_i_, first_j_;
  double side_;
  std::map<std::tuple<int, int, int>, int> index_;
  std::vector<Vec3> points_;
  std::vector<Quad> quads_;
  std::vector<char> on_side_;
};

}  // namespace

Mesh generate_bar(const BlankConfig& blank, CellKind kind) {
  const Section section(blank.portion, blank.cells_radius);
  const int count = static_cast<int>(section.points().size());
  Mesh mesh;
  mesh.sets = {{"bottom", {}}, {"top", {}}, {"side", {}}};
  if (blank.portion != "full") mesh.sets["symmetry_x"];
  if (blank.portion == "quarter") mesh.sets["symmetry_y"];
  for (int k = 0; k <= blank.cells_along; ++k)
    for (int p = 0; p < count; ++p) {
      const Vec3& point = section.points()[p];
      const int node = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(blank.origin + Vec3(blank.radius * point.x(), blank.radius * point.y(),
                                               blank.length * k / blank.cells_along));
      if (k == 0) mesh.sets["bottom"].push_back(node);
      if (k == blank.cells_along) mesh.sets["top"].push_back(node);
      if (section.on_side()[p]) mesh.sets["side"].push_back(node);
      if (blank.portion != "full" && point.x() == 0) mesh.sets["symmetry_x"].push_back(node);
      if (blank.portion == "quarter" && point.y() == 0) mesh.sets["symmetry_y"].push_back(node);
    }
  std::vector<Hex> hexes;
  for (int k = 0; k < blank.cells_along; ++k)
    for (const Quad& q : section.quads()) {
      const int low = k * count, up = low + count;
      hexes.push_back({low + q[0], low + q[1], low + q[2], low + q[3], up + q[0], up + q[1], up + q[2], up + q[3]});
    }
  const Centres centres = split_hexes(mesh, hexes, kind);
  for (auto& [name, set] : mesh.sets) centres.extend_by_faces(set, hexes);
  return mesh;
}

}  // namespace forming_sim
