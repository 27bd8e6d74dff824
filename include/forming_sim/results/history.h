#pragma once
// history.csv: a row at every history interval, at the end of every stage and
// at the end of the run.
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/results/csv_file.h"
#include "forming_sim/results/gauge.h"
#include "forming_sim/results/schedule.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

/// Columns: time_s, step, dt_s, stage, energies *_J (*_J_per_m in plane strain),
/// balance_error, per tool force (mean since the row before), position, moment about that, axisymmetric the radial force, and of those with an axle how far they have turned,
/// max_plastic_strain, max_surface_strain, min_thickness_m, max_thinning, min_gap_over_h0,
/// max_damage_BODY of bodies that have it (material/damage.h), and per probe position, velocity and mean stress, and where boundaries hold or drive it
/// what they push with: force, and moment about its place (means since the row before).
std::vector<std::string> history_columns(const Model& model, const std::vector<Probe>& probes);

class History : public Observer {
 public:
  /// resumed: go on with the file of that name where it fits; a note in the
  /// record tells where it did not.
  History(const std::string& path, double interval, bool resumed, Gauge& gauge, RunRecord& record)
      : path_(path), schedule_(interval), resumed_(resumed), gauge_(gauge), record_(record) {}
  void on_start(const Simulation& simulation) override;
  void on_step(const Simulation& simulation) override;
  void on_stage_end(const Simulation& simulation, int index) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  void write(const Simulation& simulation);
  std::string path_;
  Schedule schedule_;
  bool resumed_;
  Gauge& gauge_;
  RunRecord& record_;
  std::unique_ptr<CsvFile> file_;
  long last_step_ = -1;
  bool quiet_ = false;
};

/// Name of the running stage; of the last one when all have ended.
std::string stage_name(const Simulation& simulation);

}  // namespace forming_sim
