#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "forming_sim/results/csv_file.h"
#include "forming_sim/results/text_file.h"

namespace forming_sim::bench {
namespace {

double error_of(double found, double expected) { return expected == 0 ? found : found / expected - 1; }

/// "1.23 M" of element-steps a second; "" where a program does not say its steps.
std::string rate(const Finished& run) {
  if (run.size.steps == 0 || run.size.elements == 0 || run.size.wall_time <= 0) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", 1e-6 * static_cast<double>(run.size.elements) * static_cast<double>(run.size.steps) / run.size.wall_time);
  return text;
}

}  // namespace

void Report::begin(const std::string& name, const std::string& title, const std::vector<Sought>& sought, const std::string& finer) {
  tell_orders();
  name_ = name;
  sought_ = sought;
  finer_ = finer;
  std::string file = report_ + "_" + name;
  std::replace_if(file.begin(), file.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
  figures_.emplace_back(file, title, "wall time, s", "largest relative error");
  figures_.back().logarithmic();
  finer_figures_.emplace_back(file + "_finer", title, finer, "largest relative error");
  finer_figures_.back().logarithmic();
  std::printf("\n%s: %s\n\n| choice | mesh | cells | unknowns | steps | wall, s | 10^6 element-steps/s |", name.c_str(), title.c_str());
  for (const Sought& s : sought) std::printf(" %s: %.5g |", s.quantity.c_str(), s.expected);
  std::printf("\n|---|---|---|---|---|---|---|");
  for (std::size_t i = 0; i < sought.size(); ++i) std::printf("---|");
  std::printf("\n");
}

void Report::add(const Finished& run) {
  const std::string name = name_ + ": " + run.choice + ", " + run.mesh;
  const double cost = static_cast<double>(run.size.elements) * static_cast<double>(run.size.steps);
  std::printf("| %s | %s | %ld | %ld | %ld | %.3g | %s |", run.choice.c_str(), run.mesh.c_str(), run.size.cells, run.size.unknowns, run.size.steps, run.size.wall_time, rate(run).c_str());
  double largest = 0;
  std::vector<double> errors;
  for (std::size_t i = 0; i < sought_.size(); ++i) {
    if (std::isnan(run.found[i])) {
      errors.push_back(kNothing);
      std::printf(" not reached |");
      continue;
    }
    const double error = error_of(run.found[i], sought_[i].expected);
    largest = std::max(largest, std::abs(error));
    errors.push_back(error);
    std::printf(" %+.3g %% |", 100 * error);
    rows_.push_back({name, sought_[i].quantity, run.found[i], sought_[i].expected, error, run.size.wall_time, std::abs(error) <= sought_[i].goal, ""});
    csv_ += '"' + name_ + "\",\"" + run.choice + "\",\"" + run.mesh + "\"," + std::to_string(run.size.cells) + ',' + std::to_string(run.size.unknowns) + ',' +
            std::to_string(run.size.steps) + ',' + csv_number(run.size.wall_time) + ',' + csv_number(cost / run.size.wall_time) + ",\"" + sought_[i].quantity + "\"," +
            csv_number(run.found[i]) + ',' + csv_number(sought_[i].expected) + ',' + csv_number(error) + ",\n";
  }
  std::printf("\n");
  if (!run.note.empty()) std::printf("    %s\n", run.note.c_str());
  std::fflush(stdout);
  rows_.back().note = run.note;
  for (const auto& [quantity, value] : {std::pair<const char*, long>{"cells", run.size.cells}, {"unknowns", run.size.unknowns}, {"steps", run.size.steps}})
    rows_.push_back(just(name, quantity, static_cast<double>(value), run.size.wall_time));
  if (cost > 0) rows_.push_back(just(name, "element-steps/s", cost / run.size.wall_time, run.size.wall_time));
  if (largest > 0 && run.size.wall_time > 0) figures_.back().add(run.choice, run.size.wall_time, largest);
  if (run.fineness == 0) return;
  if (largest > 0) finer_figures_.back().add(run.choice, run.fineness, largest);
  auto of_choice = std::find_if(series_.begin(), series_.end(), [&](const auto& series) { return series.first == run.choice; });
  if (of_choice == series_.end()) of_choice = series_.insert(series_.end(), {run.choice, {}});
  of_choice->second.push_back({run.fineness, run.mesh, errors});
}

// Between two runs of a series error ~ fineness^-order.
void Report::tell_orders() {
  const bool any = std::any_of(sought_.begin(), sought_.end(), [](const Sought& s) { return !std::isnan(s.order); });
  for (const auto& [choice, points] : series_) {
    if (points.size() < 2 || !any) continue;
    std::printf("\nOrder in %s, %s:", finer_.c_str(), choice.c_str());
    for (std::size_t i = 0; i < sought_.size(); ++i) {
      if (std::isnan(sought_[i].order)) continue;
      std::printf("%s %s", i == 0 ? "" : ";", sought_[i].quantity.c_str());
      for (std::size_t k = 1; k < points.size(); ++k) {
        const Point &coarse = points[k - 1], &fine = points[k];
        const double order = std::log(std::abs(coarse.errors[i] / fine.errors[i])) / std::log(fine.fineness / coarse.fineness);
        std::printf(" %.2f", order);
        Row row = just(name_ + ": " + choice + ", " + coarse.mesh + " to " + fine.mesh, "order of " + sought_[i].quantity, order, 0);
        if (sought_[i].order > 0) {
          row.expected = sought_[i].order;
          row.error = order / row.expected - 1;
          row.holds = order >= row.expected;
        }
        rows_.push_back(row);
      }
    }
    std::printf("\n");
  }
  series_.clear();
}

void Report::no_answer(const std::string& choice, const std::string& why, double wall_time, bool holds) {
  std::printf("| %s | %s |\n", choice.c_str(), why.c_str());
  std::fflush(stdout);
  for (const Sought& s : sought_) {
    Row row = just(name_ + ": " + choice, s.quantity, kNothing, wall_time);
    row.expected = s.expected;
    row.holds = holds;
    row.note = why;
    rows_.push_back(row);
    std::string quoted = why;
    for (std::size_t at = quoted.find('"'); at != std::string::npos; at = quoted.find('"', at + 2)) quoted.insert(at, "\"");
    csv_ += '"' + name_ + "\",\"" + choice + "\",,,,," + csv_number(wall_time) + ",,\"" + s.quantity + "\",," + csv_number(s.expected) + ",,\"" + quoted + "\"\n";
  }
}

std::vector<Row> Report::finish() {
  tell_orders();
  if (!request_.directory.empty()) {
    replace_file(in_directory(request_.directory, report_ + ".csv"),
                 "problem,choice,mesh,cells,unknowns,steps,wall_time_s,element_steps_per_s,quantity,found,expected,error,note\n" + csv_);
    for (const auto* figures : {&figures_, &finer_figures_})
      for (const Figure& figure : *figures) figure.write(request_.directory);
  }
  return rows_;
}

}  // namespace forming_sim::bench
