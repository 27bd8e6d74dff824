#pragma once
// Problems whose answer is known, each run with several choices of elements, mesh, time step,
// layer of contact: a speed is told with its error, an error with its time.
//
// A problem is a function that gives its runs to a Report, one file each. The report prints a
// table, line by line as the runs end, and keeps the rows of the command's JSON, the lines of
// DIR/<report>.csv and the plots of a problem: error against wall time and, where its runs say
// how fine they are, against that, with the orders of convergence under the table.
#include <string>
#include <vector>

#include "figure.h"
#include "rows.h"
#include "support/run_size.h"

namespace forming_sim::bench {

/// What one run gave.
struct Finished {
  std::string choice;           ///< curve of the plot: elements, time step, program
  std::string mesh;             ///< point of the curve: "8 cells"
  RunSize size;
  std::vector<double> found;    ///< in the order of the problem's quantities; not a number where it was not reached
  std::string note = "";
  double fineness = 0;          ///< cells (or steps, ...) across what matters: orders are told in it; 0: the run is of no series
};

/// What a problem asks for and what is right.
struct Sought {
  std::string quantity;   ///< with its unit
  double expected;        ///< 0: what is found is the error itself
  double goal;            ///< relative error that is good enough: the row holds
  double order = 0;       ///< of convergence that is asked for between two runs of a series, or more; 0: it is told only; not a number: no mesh makes the error smaller
};

class Report {
 public:
  /// name: of its CSV file and, with _ for -, before those of its plots.
  Report(const Request& request, std::string name) : request_(request), report_(std::move(name)) {}

  /// The runs that follow are of this problem. Its plots show the largest error of a run. finer: what their fineness counts.
  void begin(const std::string& name, const std::string& title, const std::vector<Sought>& sought, const std::string& finer = "cells");
  void add(const Finished& run);
  /// A choice that gave no answer, and why. holds: false where it was tried and failed.
  void no_answer(const std::string& choice, const std::string& why, double wall_time, bool holds);

  /// Writes the plots and the CSV, where the request names a directory; all rows.
  std::vector<Row> finish();
  const Request& request() const { return request_; }

 private:
  /// How fine a run was, what it was called, and its errors.
  struct Point {
    double fineness;
    std::string mesh;
    std::vector<double> errors;
  };
  void tell_orders();

  const Request& request_;
  std::string report_, name_, finer_;
  std::vector<Sought> sought_;
  std::vector<std::pair<std::string, std::vector<Point>>> series_;  ///< of the problem, by choice
  std::vector<Row> rows_;
  std::vector<Figure> figures_;   ///< against wall time
  std::vector<Figure> finer_figures_;
  std::string csv_;
};

}  // namespace forming_sim::bench
