#pragma once
// Plane-strain uniform bending and springback of a 6111-T4 strip: one column of
// cells between two sections that stay plane, the far one turned by k L and then
// turned back until it carries no moment.
#include <cmath>
#include <memory>

#include "support/bodies.h"
#include "support/free_mesh.h"
#include "support/runs.h"

namespace forming_sim {

constexpr double kSheetThickness = 0.93e-3;  // m

/// The column in damped slow motion. In the plane of bending x is along the strip
/// and t through its thickness (y in 2D, z in 3D, where y is held).
class Column {
 public:
  Column(int dimension, int cells, double aspect, const MaterialConfig& material, const std::string& pattern = "fine",
         const std::string& average = "cell")
      : t_(dimension == 2 ? 1 : 2) {
    const std::vector<BodyModel> bodies{body_of(pattern == "free" ? free_sheet(dimension, cells) : column_of_cells(dimension, cells, aspect, pattern), material, average)};
    mesh_ = bodies[0].mesh;
    x_ = positions_of(mesh_);
    for (Node& n : x_) n[t_] -= 0.5 * kSheetThickness;
    elements_ = std::make_unique<Elements>(bodies, dimension, x_, ElementOptions(), 1);
    v_.assign(x_.size(), Node::Zero());
    f_ = v_;
    s_.assign(x_.size(), 0.0);
    w_ = s_;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      end_.push_back(x_[i][0] < 1e-9 * length_ ? left : x_[i][0] > length_ * (1 - 1e-9) ? right : inside);
      s_[i] = x_[i][t_];
      if (end_[i] == right) end_mass_ += elements_->nodal_mass()[i];
    }
    d_ = length_;
    int element = 0;
    elements_->stable_step(x_, v_, dt_, element);
    dt_ *= 0.5;
    const double c = std::sqrt(material.youngs_modulus / material.density);
    damping_ = 2 * M_PI * c / (2 * std::max(kSheetThickness, length_));
  }

  /// Turns the far section at a steady rate to `angle`; the moment there, N (per metre of width in 3D too).
  double turn(double angle, int steps) {
    const double from = angle_;
    for (int n = 1; n <= steps; ++n) step(from + (angle - from) * n / steps);
    return moment_;
  }
  /// Turns back until the moment vanishes; the angle left.
  double release(int steps) {
    const double rate = angle_ / steps;
    double angle = angle_, moment = moment_;
    while (moment_ > 0 && angle_ > -1) {
      angle = angle_;
      moment = moment_;
      step(angle_ - rate);
    }
    return angle_ + (angle - angle_) * moment_ / (moment_ - moment);
  }
  double length() const { return length_; }
  long steps() const { return steps_; }
  const Mesh& mesh() const { return mesh_; }
  double thickness_now() const {
    double low = 1, high = -1;
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (end_[i] == left) low = std::min(low, x_[i][t_]), high = std::max(high, x_[i][t_]);
    return high - low;
  }

 private:
  enum End { left, inside, right };

  Mesh column_of_cells(int dimension, int cells, double aspect, const std::string& pattern) {
    BlankConfig blank;
    blank.shape = dimension == 2 ? "strip" : "plate";
    blank.pattern = pattern;
    blank.cells_through = cells;
    blank.thickness = kSheetThickness;
    blank.length = length_ = aspect * kSheetThickness / cells;
    blank.width = kSheetThickness / cells;
    blank.cells_along = blank.cells_across = 1;
    return generate_blank(blank);
  }
  /// Free simplices do not come in columns: a piece of sheet as long as it is thick, and in 3D two cells wide.
  Mesh free_sheet(int dimension, int cells) {
    length_ = kSheetThickness;
    const double edge = kSheetThickness / cells;
    return dimension == 2 ? free_rectangle(length_, kSheetThickness, edge) : free_box(Vec3(length_, 2 * edge, kSheetThickness), edge);
  }

  void step(double angle) {
    ++steps_;
    angle_ = angle;
    const Vec3 n = Vec3::UnitX() * std::cos(angle) + Vec3::Unit(t_) * std::sin(angle);    // normal of the far section
    const Vec3 e = -Vec3::UnitX() * std::sin(angle) + Vec3::Unit(t_) * std::cos(angle);   // along it
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (end_[i] == right) {
        const double y = t_ == 2 ? x_[i][1] : 0;
        x_[i] = node(d_ * n + s_[i] * e);
        if (t_ == 2) x_[i][1] = y;
      }
    elements_->forces(x_, v_, dt_, dt_, f_);
    double pull = 0;
    moment_ = 0;
    const double keep = (1 - 0.5 * damping_ * dt_) / (1 + 0.5 * damping_ * dt_), kick = dt_ / (1 + 0.5 * damping_ * dt_);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double m = elements_->nodal_mass()[i];
      const Vec3 f = vec3(f_[i]);
      if (end_[i] == right) {
        pull += f.dot(n);
        moment_ += f.dot(n) * s_[i];
        w_[i] = keep * w_[i] + kick * f.dot(e) / m;
        s_[i] += dt_ * w_[i];
        continue;
      }
      for (int a : {0, t_}) {
        if (a == 0 && end_[i] == left) continue;
        v_[i][a] = keep * v_[i][a] + kick * f[a] / m;
        x_[i][a] += dt_ * v_[i][a];
      }
    }
    moment_ /= t_ == 2 ? x_width() : 1;
    d_speed_ = keep * d_speed_ + kick * pull / end_mass_;
    d_ += dt_ * d_speed_;
  }
  double x_width() const {
    double low = 1, high = -1;
    for (const Node& n : x_) low = std::min(low, n[1]), high = std::max(high, n[1]);
    return high - low;
  }

  int t_;
  long steps_ = 0;
  Mesh mesh_;
  double length_ = 0, dt_ = 0, damping_ = 0, d_ = 0, d_speed_ = 0, angle_ = 0, moment_ = 0, end_mass_ = 0;
  std::unique_ptr<Elements> elements_;
  NodeField x_, v_, f_;
  std::vector<double> s_, w_;
  std::vector<End> end_;
};

struct Bend {
  double moment, thickness, after;  ///< N, m, k_after / k
  long steps;
  Mesh mesh;
};
/// The slow motion takes 5 steps_per_cell steps for each cell to bend, and fewer to let go.
inline Bend bend(int dimension, double kt, int cells, double aspect, const MaterialConfig& material,
          const std::string& pattern = "fine", const std::string& average = "cell", int steps_per_cell = 4000) {
  Column column(dimension, cells, aspect, material, pattern, average);
  const double angle = kt / kSheetThickness * column.length();
  const int steps = steps_per_cell * cells;
  Bend b;
  column.turn(angle, 4 * steps);
  b.moment = column.turn(angle, steps);
  b.thickness = column.thickness_now();
  b.after = column.release(10 * steps) / angle;
  b.steps = column.steps();
  b.mesh = column.mesh();
  return b;
}

/// Exact for a Hencky law; M (N) of admissible finite-strain laws differs by 1e-3. Thickness in mm.
struct ExactBend {
  double kt, moment, thickness, after;
};
constexpr ExactBend kVoceBends[] = {{.1, 62.423, .92885, .89077}, {.2, 73.414, .92571, .93483}, {.4, 85.60, .91723, .96044}};
constexpr ExactBend kPerfectBends[] = {{.1, 47.791, .92884, .91638}, {.4, 46.849, .91943, .97855}};

}  // namespace forming_sim
