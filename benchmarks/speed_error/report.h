#pragma once
// forming_bench speed-error: problems whose answer is known, each run with every choice
// of elements, mesh and time step; a speed is told with its error, an error with its time.
//
// A problem is a function that gives its runs to a Report, one file each. The report
// prints a table, line by line as the runs end, and keeps the rows of DIR/speed-error.json,
// the lines of DIR/speed-error.csv and one plot a problem, error against wall time.
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
};

/// What a problem asks for and what is right.
struct Sought {
  std::string quantity;   ///< with its unit
  double expected;        ///< 0: what is found is the error itself
  double goal;            ///< relative error that is good enough: the row holds
};

class Report {
 public:
  explicit Report(const Request& request) : request_(request) {}

  /// The runs that follow are of this problem. Its plot shows the largest error of a run.
  void begin(const std::string& name, const std::string& title, const std::vector<Sought>& sought);
  void add(const Finished& run);
  /// A choice that gave no answer, and why. holds: false where it was tried and failed.
  void no_answer(const std::string& choice, const std::string& why, double wall_time, bool holds);

  /// Writes the plots and the CSV, where the request names a directory; all rows.
  std::vector<Row> finish();
  const Request& request() const { return request_; }

 private:
  const Request& request_;
  std::string name_;
  std::vector<Sought> sought_;
  std::vector<Row> rows_;
  std::vector<Figure> figures_;
  std::string csv_;
};

// The problems. One line each here and in speed_error.cpp.
void bending_problem(Report&);   ///< a sheet bent evenly and let go: hardening and perfectly plastic
void cook_problem(Report&);      ///< Cook's membrane, elastic-plastic
void taylor_problem(Report&);    ///< the Taylor bar of copper, 3D and axisymmetric
void cube_problem(Report&);      ///< the swinging cube: linear, exact
void sphere_problem(Report&);    ///< a thick sphere yields from inside
void torsion_problem(Report&);   ///< a round bar yields in torsion and is let go
void impact_problem(Report&);    ///< a bar in uniaxial strain hits a plane, and another bar
void flange_problem(Report&);    ///< scenes/flange.yaml against its own finest mesh
void flange_time_problem(Report&);  ///< the same: mass scaling, tool speed, time step
void slivers_problem(Report&);   ///< a few thin cells in a pulled sheet: the limits of the step, mass for the few
void layers_problem(Report&);    ///< one to ten layers of plasticity in a bent sheet

}  // namespace forming_sim::bench
