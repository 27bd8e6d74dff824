#pragma once
// What a command of forming_bench finds: rows, printed as a table and kept as
// DIR/<command>.json.
#include <chrono>
#include <limits>
#include <string>
#include <vector>

namespace forming_sim::bench {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Row {
  std::string name;       ///< "case" in the file
  std::string quantity;   ///< with its unit
  double found = kNothing;
  double expected = kNothing;   ///< not a number: nothing to compare with
  double error = kNothing;      ///< found / expected - 1; where 0 is expected, found
  double wall_time = 0;         ///< s
  bool holds = true;
  std::string note;             ///< why a claim does not hold, or what to know
};

/// A value that should come within `bound` (relative) of `expected`.
Row near(const std::string& name, const std::string& quantity, double found, double expected, double bound, double wall_time);
/// A cost that should be at most `goal`.
Row at_most(const std::string& name, const std::string& quantity, double found, double goal, double wall_time);
/// A value that is reported only.
Row just(const std::string& name, const std::string& quantity, double found, double wall_time);

void print(const std::vector<Row>& rows);
/// Throws std::runtime_error where the file cannot be written.
void write(const std::string& directory, const std::string& command, const std::vector<Row>& rows);

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Least time of one call, s: calls for 50 ms at a time, seven times.
template <class Work> double least_time(Work&& work) {
  work();
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < 7; ++turn) {
    const Clock clock;
    long calls = 0;
    do {
      work();
      ++calls;
    } while (clock.seconds() < 0.05);
    least = std::min(least, clock.seconds() / static_cast<double>(calls));
  }
  return least;
}

/// What a user asks of a command.
struct Request {
  std::string directory;             ///< of --output, "": none
  std::vector<std::string> arguments;  ///< the words after the command's name
};

std::vector<Row> costs(const Request&);    ///< ns per element and step of each stage
std::vector<Row> speed(const Request&);    ///< every stage of a step beside what the machine could do; prints its own table
std::vector<Row> speed_error(const Request&);  ///< error against wall time, of every choice; prints its own tables
std::vector<Row> stability(const Request&);    ///< hard cases: bounded energy, no false inversion, the right error
std::vector<Row> material(const Request&);   ///< a law at a point: a measured loop, or any history
std::vector<Row> calibrate(const Request&);  ///< layers from a measured curve
std::vector<Row> contact(const Request&);  ///< blocks that meet, at all speeds, layers and meshes: what crosses
std::vector<Row> paper(const Request&);    ///< the paper, figure by figure

}  // namespace forming_sim::bench
