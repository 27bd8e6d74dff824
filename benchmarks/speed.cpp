// forming_bench speed: what every stage of a step costs an element, beside what this machine could do in that time.
#include <cstdio>
#include <stdexcept>

#include "figure.h"
#include "forming_sim/results/csv_file.h"
#include "forming_sim/results/text_file.h"
#include "rows.h"
#include "speed/machine.h"
#include "speed/operations.h"
#include "speed/stepped_block.h"

namespace forming_sim::bench {
namespace {

constexpr long kInCache = 9000;  // elements whose arrays stay in the caches of one core, and which are work for two

struct Line {
  const SpeedFamily* family;
  const SpeedMotion* motion;
  int layers, threads;
  const char* curve;
  long elements = 0;
  StepTimes times{};
  double bytes = 0, operations = 0;  ///< of a step and element
};

/// The machine by threads, 1 and 2.
struct Machine {
  std::string kernels;
  double bandwidth[3] = {}, peak[3] = {};
};

class SpeedReport {
 public:
  explicit SpeedReport(const Request& request) : request_(request), sizes_({1000, 10000, 100000, 1000000}) {
    for (const std::string& word : request.arguments) {
      if (word == "large") sizes_.push_back(4000000);
      else if (word == "short") sizes_ = {1000}, short_ = true;
      else throw std::runtime_error("given " + word + "; right is nothing, large (as far as 4000000 elements) or short (1000 elements, for a first look)");
    }
  }

  std::vector<Row> run() {
    find_machine();
    std::printf("\nns an element and step\n\n");
    head();
    const long elements = short_ ? sizes_[0] : kInCache;
    for (const SpeedFamily& family : kSpeedFamilies)
      for (const SpeedMotion* motion : kSpeedMotions)
        for (int threads : {1, 2}) add(family, *motion, elements, threads, 1);
    for (const SpeedFamily& family : kSpeedFamilies)
      if (is_one_point(family.kind)) add(family, kBending, elements, 1, 1);
    std::printf("\nseveral layers of plasticity\n\n");
    head();
    for (const SpeedFamily& family : kSpeedFamilies)
      for (const char* curve : {"voce", "perfect"})
        for (int layers : {1, 2, 3, 5, 10})
          if (layers > 1 || !voce(curve)) add(family, kForming, elements, 1, layers, curve);
    std::printf("\nother curves of hardening\n\n");
    head();
    for (const SpeedFamily& family : kSpeedFamilies)
      if (family.kind == CellKind::crossed || family.kind == CellKind::hex24 || family.kind == CellKind::hex1)
        for (const char* curve : {"linear", "swift", "table"}) add(family, kForming, elements, 1, 1, curve);
    std::printf("\nas the work grows\n\n");
    head();
    for (const SpeedFamily& family : kSpeedFamilies) {
      for (int threads : {1, 2})
        for (long size : sizes_) add(family, kForming, size, threads, 1);
    }
    return finish();
  }

 private:
  void find_machine() {
    machine_.kernels = SteppedBlock(kSpeedFamilies[0], kElastic, 1, 1).kernels();
    for (int threads : {1, 2}) {
      const Clock clock;
      machine_.bandwidth[threads] = triad_bandwidth(threads);
      machine_.peak[threads] = arithmetic_peak(machine_.kernels, threads);
      const std::string name = "this machine, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
      rows_.push_back(just(name, "memory, triad, GB/s", 1e-9 * machine_.bandwidth[threads], clock.seconds()));
      rows_.push_back(just(name, "arithmetic, " + machine_.kernels + ", Gop/s", 1e-9 * machine_.peak[threads], clock.seconds()));
      std::printf("%s: memory %.3g GB/s, arithmetic %.3g Gop/s in %s\n", name.c_str(), 1e-9 * machine_.bandwidth[threads], 1e-9 * machine_.peak[threads],
                  machine_.kernels.c_str());
    }
    std::fflush(stdout);
  }

  static void head() {
    std::printf("| elements | motion | layers | number | threads | cells | pressure of nodes | nodes | time step | whole | 1 thread over 2 | a further layer over the first | bytes "
                "| of bandwidth | operations | of peak |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  }

  void add(const SpeedFamily& family, const SpeedMotion& motion, long elements, int threads, int layers, const char* curve = "voce") {
    const Clock clock;
    SteppedBlock block(family, motion, elements, threads, layers, curve);
    Line line{&family, &motion, layers, threads, curve};
    line.elements = block.elements();
    line.times = block.measure(elements > 300000 ? 3 : 10);
    line.bytes = block.step_bytes() / static_cast<double>(line.elements);
    line.operations = layers == 1 && motion.bending == 0 && voce(line) ? operations_of_step(family, motion) : kNothing;
    lines_.push_back(line);
    print_and_keep(line, clock.seconds());
  }

  static bool voce(const char* curve) { return curve == std::string("voce"); }
  static bool voce(const Line& line) { return voce(line.curve); }

  /// Whole step of the same elements with so many layers on so many threads, s; kNothing: it was not asked for.
  double time_with(const Line& line, int layers, int threads) const {
    for (const Line& other : lines_)
      if (other.family == line.family && other.motion == line.motion && other.curve == std::string(line.curve) && other.layers == layers && other.elements == line.elements && other.threads == threads)
        return whole(other.times);
    return kNothing;
  }
  /// What each layer beyond the first adds to a whole step, over a step with one.
  double further_layer(const Line& line) const {
    if (line.layers == 1) return kNothing;
    return (whole(line.times) / time_with(line, 1, line.threads) - 1) / (line.layers - 1);
  }

  void print_and_keep(const Line& line, double wall_time) {
    const double per_element = 1e9 / static_cast<double>(line.elements), time = whole(line.times) / static_cast<double>(line.elements);
    const std::string motion = line.motion->name + (voce(line) ? std::string() : std::string(", ") + line.curve);
    const std::string name = std::string(line.family->name) + ", " + motion + ", " + std::to_string(line.layers) + (line.layers == 1 ? " layer" : " layers") +
                             ", " + std::to_string(line.elements) + " elements, " + std::to_string(line.threads) + (line.threads == 1 ? " thread" : " threads");
    const std::pair<const char*, double> values[] = {{"cells, ns", per_element * line.times.cells},
                                                     {"pressure of nodes, ns", per_element * line.times.pressure},
                                                     {"nodes, ns", per_element * line.times.nodes},
                                                     {"time step, ns", per_element * line.times.bound},
                                                     {"whole, ns", 1e9 * time},
                                                     {"1 thread over this", time_with(line, line.layers, 1) / whole(line.times)},
                                                     {"a further layer over the first", further_layer(line)},
                                                     {"bytes", line.bytes},
                                                     {"of the bandwidth", line.bytes / time / machine_.bandwidth[line.threads]},
                                                     {"operations", line.operations},
                                                     {"of the arithmetic peak", line.operations / time / machine_.peak[line.threads]}};
    std::printf("| %s | %s | %d | %ld | %d |", line.family->name, motion.c_str(), line.layers, line.elements, line.threads);
    csv_ += csv_text(line.family->name) + ',' + csv_text(motion) + ',' + std::to_string(line.layers) + ',' + std::to_string(line.elements) + ',' + std::to_string(line.threads);
    for (const auto& [quantity, value] : values) {
      if (std::isfinite(value)) std::printf(" %.3g |", value);
      else std::printf(" |");
      csv_ += ',' + csv_number(value);
      if (std::isfinite(value)) rows_.push_back(just(name, quantity, value, wall_time));
    }
    std::printf("\n");
    csv_ += '\n';
    std::fflush(stdout);
  }

  std::vector<Row> finish() {
    if (request_.directory.empty()) return rows_;
    replace_file(in_directory(request_.directory, "speed.csv"),
                 "elements,motion,layers,number,threads,cells_ns,pressure_ns,nodes_ns,time_step_ns,whole_ns,one_thread_over_this,further_layer_over_first,bytes,of_bandwidth,operations,of_peak\n" + csv_);
    Figure growth("speed_growth", "one step of growing blocks", "elements", "ns an element and step, 1 thread");
    growth.logarithmic();
    for (const Line& line : lines_)
      if (line.motion == &kForming && voce(line) && line.layers == 1 && line.threads == 1)
        growth.add(line.family->name, static_cast<double>(line.elements), 1e9 * whole(line.times) / static_cast<double>(line.elements));
    growth.write(request_.directory);
    return rows_;
  }

  const Request& request_;
  std::vector<long> sizes_;
  bool short_ = false;
  Machine machine_;
  std::vector<Line> lines_;
  std::vector<Row> rows_;
  std::string csv_;
};

}  // namespace

std::vector<Row> speed(const Request& request) { return SpeedReport(request).run(); }

}  // namespace forming_sim::bench
