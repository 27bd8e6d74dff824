// forming_bench material LAW.yaml HISTORY.csv: any law of a scene through any deformation.
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "figure.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/material/material_point.h"
#include "forming_sim/results/csv_file.h"
#include "forming_sim/results/text_file.h"
#include "law_file.h"
#include "material.h"
#include "table.h"

namespace forming_sim::bench {
namespace {

constexpr double kLargestStep = 1e-3;  // of strain in a step of the law
constexpr double kMostSteps = 1e7;     // between two rows
constexpr int kStepsInTime = 200;      // least number between two rows, of laws that go by the time

/// What the columns of a history prescribe: components of F, or logarithmic strains.
struct Columns {
  int of[3][3];  ///< column, -1: none
  int time = -1;
  bool strains = false;
  std::array<bool, 3> free{};  ///< diagonal components without a column
};

Columns columns_of(const Table& table) {
  Columns c;
  for (auto& row : c.of) std::fill(row, row + 3, -1);
  std::string gradient, strain;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const std::string& name = table.columns[k];
    const auto axis = [&](std::size_t i) { return name[i] >= '1' && name[i] <= '3' ? name[i] - '1' : -1; };
    const bool component = name.size() == 3 && axis(1) >= 0 && axis(2) >= 0;
    if (name == "time") {
      c.time = static_cast<int>(k);
    } else if (component && (name[0] == 'F' || (name[0] == 'e' && axis(1) == axis(2)))) {
      c.of[axis(1)][axis(2)] = static_cast<int>(k);
      (name[0] == 'F' ? gradient : strain) = name;
    } else {
      throw std::runtime_error(table.path + ": column " + name + " is not known; right are F11, F12, ... F33 (deformation gradient) or e11, e22, e33 (true strain), and time");
    }
  }
  if (gradient.empty() && strain.empty())
    throw std::runtime_error(table.path + ": no column prescribes a deformation; right are F11, F12, ... F33 or e11, e22, e33");
  if (!gradient.empty() && !strain.empty())
    throw std::runtime_error(table.path + ": given " + gradient + " and " + strain + "; right are components of F or true strains, not both");
  c.strains = !strain.empty();
  for (int i = 0; i < 3; ++i) c.free[i] = c.of[i][i] < 0;
  return c;
}

std::string name_of(const Columns& c, int i, int j) { return std::string(c.strains ? "e" : "F") + std::to_string(i + 1) + std::to_string(j + 1); }

/// What the rows prescribe, one after the other; steps between them along straight lines of
/// the components (of the strains, where those are given).
class Driver {
 public:
  Driver(const Table& table, const MaterialConfig& material) : table_(table), columns_(columns_of(table)), point_(material), by_time_(material.rate_dependence.has_value()) {
    if (columns_.strains) given_.setZero();
    if (by_time_ && columns_.time < 0) throw std::runtime_error(table.path + ": no column time; the yield stress of this law depends on the rate: give the time of every row, s");
    check_rows();
  }

  /// To a row of the table; see(prescribed components, stress) of every step, of long ways some 200.
  template <class See> void to(std::size_t row, See&& see) {
    Mat3 to = given_;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (columns_.of[i][j] >= 0) to(i, j) = table_.rows[row][columns_.of[i][j]];
    const double way = distance(to);
    if (!(way < kMostSteps * kLargestStep))
      throw std::runtime_error(table_.place(row) + ": the strain since the row before is " + csv_number(way) + "; right are rows closer than " + csv_number(kMostSteps * kLargestStep));
    const int n = std::max(by_time_ ? kStepsInTime : 1, static_cast<int>(std::ceil(way / kLargestStep - 1e-9)));
    if (by_time_) {
      const double time = table_.rows[row][columns_.time];
      if (row == 0 && time < 0) throw std::runtime_error(table_.place(0, columns_.time) + ": given " + csv_number(time) + "; right is 0 or more: the first row is reached from time 0");
      point_.set_step((time - (row > 0 ? table_.rows[row - 1][columns_.time] : 0)) / n);
    }
    const Mat3 from = given_;
    const int every = 1 + n / 200;
    for (int k = 1; k <= n; ++k) {
      const Mat3 given = from + (to - from) * (double(k) / n);
      step(row, given);
      if (k == n || k % every == 0) see(given, answer_.stress);
    }
    given_ = to;
    steps_ += n;
  }

  const Columns& columns() const { return columns_; }
  const MaterialPoint& point() const { return point_; }
  const MaterialPoint::Answer& answer() const { return answer_; }
  double work() const { return work_; }  ///< J per m3 of initial volume, by the trapezoidal rule
  long steps() const { return steps_; }

 private:
  void check_rows() const {
    const auto& of = columns_.of;
    const bool whole = !columns_.strains && of[0][0] >= 0 && of[1][1] >= 0 && of[2][2] >= 0;
    for (std::size_t r = 0; r < table_.rows.size(); ++r) {
      const auto& row = table_.rows[r];
      if (columns_.time >= 0 && r > 0 && row[columns_.time] < table_.rows[r - 1][columns_.time])
        throw std::runtime_error(table_.place(r, columns_.time) + ": given " + csv_number(row[columns_.time]) + " after " +
                                 csv_number(table_.rows[r - 1][columns_.time]) + "; right is a time that does not fall");
      if (!whole) continue;
      Mat3 F = Mat3::Identity();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (of[i][j] >= 0) F(i, j) = row[of[i][j]];
      if (!(F.determinant() > 0))
        throw std::runtime_error(table_.place(r) + ": the determinant of F is " + csv_number(F.determinant()) + "; right is above 0");
    }
  }

  Mat3 gradient(const Mat3& given) const {
    Mat3 F = columns_.strains ? Mat3(given.diagonal().array().exp().matrix().asDiagonal()) : given;
    for (int i = 0; i < 3; ++i)
      if (columns_.free[i]) F(i, i) = point_.deformation()(i, i);
    return F;
  }

  /// Largest component of the change of F over the old or the new F.
  double distance(const Mat3& to) const {
    if (columns_.strains) return (to - given_).cwiseAbs().maxCoeff();
    const Mat3 F = gradient(to), change = F - point_.deformation();
    const double old = (change * point_.deformation().inverse()).cwiseAbs().maxCoeff();
    return F.determinant() > 0 ? std::max(old, (change * F.inverse()).cwiseAbs().maxCoeff()) : old;
  }

  void step(std::size_t row, const Mat3& given) {
    const Mat3 F = gradient(given), before = point_.deformation(), P = first_piola();
    if (!(F.determinant() > 0) || !std::isfinite(F.determinant()))
      throw std::runtime_error(table_.place(row) + ": on the straight way from the row before the determinant of F becomes " + csv_number(F.determinant()) +
                               "; right is above 0 all the way: give rows between");
    try {
      answer_ = point_.step_with_free(F, columns_.free);
    } catch (const Error& error) {
      throw std::runtime_error(table_.place(row) + ": " + error.what());
    }
    work_ += 0.5 * (P + first_piola()).cwiseProduct(point_.deformation() - before).sum();
  }

  Mat3 first_piola() const {
    const Mat3& F = point_.deformation();
    return F.determinant() * answer_.stress * F.inverse().transpose();
  }

  const Table& table_;
  Columns columns_;
  MaterialPoint point_;
  const bool by_time_;
  MaterialPoint::Answer answer_{Mat3::Zero(), 0};
  Mat3 given_ = Mat3::Identity();
  double work_ = 0;
  long steps_ = 0;
};

/// The prescribed component that changes most: what the plot is drawn over.
std::pair<int, int> leading(const Table& table, const Columns& c) {
  std::pair<int, int> best{-1, -1};
  double widest = -1;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (c.of[i][j] < 0) continue;
      double low = i == j && !c.strains, high = low;
      for (const auto& row : table.rows) {
        low = std::min(low, row[c.of[i][j]]);
        high = std::max(high, row[c.of[i][j]]);
      }
      if (high - low > widest) widest = high - low, best = {i, j};
    }
  return best;
}

}  // namespace

std::vector<Row> drive_history(const Request& request, const std::string& law, const std::string& history) {
  const MaterialConfig material = read_law(law);
  const Table table = read_table(history);
  const Clock clock;
  Driver driver(table, material);
  const Columns& c = driver.columns();
  constexpr std::array<std::array<int, 2>, 6> components{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  const auto number = [](const std::array<int, 2>& ij) { return std::to_string(ij[0] + 1) + std::to_string(ij[1] + 1); };

  std::vector<std::string> names;
  if (c.time >= 0) names.push_back("time");
  for (int m = 0; m < 9; ++m) names.push_back("F" + std::to_string(m / 3 + 1) + std::to_string(m % 3 + 1));
  for (const auto& ij : components) names.push_back("stress_" + number(ij) + "_Pa");
  for (const char* name : {"mises_Pa", "plastic_strain", "J", "stored_energy_J_m3", "dissipation_J_m3", "work_J_m3"}) names.push_back(name);
  std::optional<CsvFile> file;
  if (!request.directory.empty()) {
    make_output_directory(request.directory);
    file.emplace(in_directory(request.directory, "material.csv"), names);
  }

  const auto [i, j] = leading(table, c);
  struct Plotted {
    double over;
    Mat3 stress;
  };
  std::vector<Plotted> way;
  Mat3 largest = Mat3::Zero();
  double most_work = 0, most_mises = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    driver.to(r, [&, i = i, j = j](const Mat3& given, const Mat3& stress) { way.push_back({given(i, j), stress}); });
    const Mat3 &F = driver.point().deformation(), &s = driver.answer().stress;
    const Mat3 S = s - s.trace() / 3 * Mat3::Identity();
    const double mises = std::sqrt(1.5) * S.norm();
    largest = largest.cwiseMax(s.cwiseAbs());
    most_mises = std::max(most_mises, mises);
    most_work = std::max({most_work, std::fabs(driver.work()), driver.answer().energy + driver.point().dissipated()});
    if (!file) continue;
    std::vector<std::string> values;
    if (c.time >= 0) values.push_back(csv_number(table.rows[r][c.time]));
    for (int m = 0; m < 9; ++m) values.push_back(csv_number(F(m / 3, m % 3)));
    for (const auto& ij : components) values.push_back(csv_number(s(ij[0], ij[1])));
    for (double value : {mises, driver.point().plastic_strain(), F.determinant(), driver.answer().energy, driver.point().dissipated(), driver.work()})
      values.push_back(csv_number(value));
    file->append(values);
  }

  const bool stretch = i == j && !c.strains;
  const std::string over = c.strains ? "true strain " + name_of(c, i, j) : stretch ? name_of(c, i, j) + " - 1" : name_of(c, i, j);
  Figure figure("material_stress", law + " through " + history, over, "Cauchy stress, MPa");
  std::vector<Row> rows;
  const double time = clock.seconds();
  const std::string name = "history";
  rows.push_back(just(name, "rows", static_cast<double>(table.rows.size()), time));
  rows.push_back(just(name, "steps of the law", static_cast<double>(driver.steps()), time));
  rows.back().note = "straight lines between rows, from rest at F = 1, in steps of at most 1e-3 strain; diagonal components without a column are free of stress";
  for (const auto& ij : components) {
    const double most = largest(ij[0], ij[1]);
    if (most < 1e-3 * largest.maxCoeff()) continue;  // only those that matter
    for (const Plotted& point : way) figure.add("stress " + number(ij), point.over - stretch, point.stress(ij[0], ij[1]) / 1e6);
    rows.push_back(just(name, "stress " + number(ij) + " at the end, Pa", driver.answer().stress(ij[0], ij[1]), time));
  }
  figure.write(request.directory);
  rows.push_back(just(name, "largest von Mises stress, Pa", most_mises, time));
  rows.push_back(just(name, "plastic strain at the end", driver.point().plastic_strain(), time));
  rows.push_back(just(name, "J at the end", driver.point().deformation().determinant(), time));
  rows.push_back(just(name, "stored energy at the end, J/m3", driver.answer().energy, time));
  rows.push_back(just(name, "dissipation, J/m3", driver.point().dissipated(), time));
  const double left = driver.work() - driver.answer().energy - driver.point().dissipated();
  rows.push_back(just(name, "work not stored or dissipated, part", most_work > 0 ? left / most_work : 0, time));
  return rows;
}

}  // namespace forming_sim::bench
