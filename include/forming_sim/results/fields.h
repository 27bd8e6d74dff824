#pragma once
// result.h5, result.xdmf and surface.xdmf of a run: a frame at the start, at every output
// interval, at the end of every stage, and where the run ended.
#include <chrono>
#include <optional>
#include <string>

#include "forming_sim/results/gauge.h"
#include "forming_sim/results/result_file.h"
#include "forming_sim/results/run_record.h"
#include "forming_sim/results/schedule.h"
#include "forming_sim/results/xdmf.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

class Fields : public Observer {
 public:
  /// resumed: go on with the file that is there; a note in the record tells where there is none, or one that ends too early.
  /// meaning: of the scene (results/meaning.h).
  Fields(const Scene& scene, const std::string& meaning, const std::string& directory, double interval, bool resumed, Gauge& gauge, RunRecord& record)
      : scene_(scene), meaning_(meaning), directory_(directory), schedule_(interval), resumed_(resumed), gauge_(gauge), record_(record) {}
  void on_start(const Simulation& simulation) override;
  void on_step(const Simulation& simulation) override;
  void on_stage_end(const Simulation& simulation, int index) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  using Clock = std::chrono::steady_clock;
  void write(const Simulation& simulation, bool interrupted = false);
  void open_xdmf();
  void write_xdmf();
  const Scene& scene_;
  std::string meaning_;
  std::string directory_;
  Schedule schedule_;
  bool resumed_;
  Gauge& gauge_;
  RunRecord& record_;
  std::optional<ResultFile> file_;
  long last_step_ = -1;
  std::optional<Xdmf> xdmf_, surface_xdmf_;
  std::size_t frames_in_xdmf_ = 0;  ///< of the file
  Clock::time_point xdmf_due_;
};

}  // namespace forming_sim
