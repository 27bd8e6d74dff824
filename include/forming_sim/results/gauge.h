#pragma once
// Measures of a running simulation that more than one file shows; taken once a
// step, however many ask.
#include <optional>
#include <vector>

#include "forming_sim/results/forming_limits.h"
#include "forming_sim/results/probe.h"
#include "forming_sim/results/run_record.h"
#include "forming_sim/results/thickness.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

struct Measures {
  Peak plastic_strain;                ///< greatest equivalent plastic strain, now
  Peak surface_strain;                ///< greatest principal log strain on the surface, but for faces in planes of symmetry, now; this and the next two of rubber only where there is nothing else
  std::vector<double> thickness_of_nodes, thinning_of_nodes;  ///< results/thickness.h; empty without a sheet
  std::optional<double> thickness;    ///< smallest of the sheets, m
  Peak thinning;                      ///< greatest of the sheets, now
  std::vector<Peak> damage;           ///< greatest of each body that with_damage() names, now
  FormingLimits::State limits;        ///< of the bodies that with_forming_limit() names, now
  std::vector<ProbeValue> probes;     ///< in the order of Gauge::probes()
};

class Gauge {
 public:
  /// Throws SceneError naming the probes that cannot be placed.
  Gauge(const Simulation& simulation, const std::vector<ProbeConfig>& probes);
  const std::vector<Probe>& probes() const { return probes_; }
  const Measures& at(const Simulation& simulation);
  std::optional<double> initial_thickness() const { return sheets_.initial(top_); }  ///< smallest of the sheets while they were free of stress, m

 private:
  std::vector<Probe> probes_;
  std::vector<int> asked_;  ///< elements of the probes, one probe's after the other's
  Thickness sheets_;
  FormingLimits limits_;
  std::vector<int> top_;  ///< nodes of the sheets that count
  Measures measures_;
  long step_ = -1;
};

/// The number of Simulation::pressed_cells(), and the first of them.
Peak number_of_pressed_cells(const Simulation& simulation);
/// Where -tr sigma/3 of a metal is the largest part of its bulk modulus. stress: of the elements, Pa.
Peak greatest_pressure(const Simulation& simulation, const std::vector<std::array<float, 6>>& stress);

/// The bodies whose material has damage, in their order.
std::vector<const BodyModel*> with_damage(const Model& model);

/// Angle of the springback line now, degrees; NaN where its probes are not there.
double springback_angle_deg(const SpringbackConfig& config, int dimension, const std::vector<Probe>& probes,
                            const std::vector<ProbeValue>& values);

}  // namespace forming_sim
