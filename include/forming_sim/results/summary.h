#pragma once
// summary.json: what came of a run. Written at its end, whatever the end was.
//
//   status {code, name, message}, version, scene, dimension, axisymmetric, resumed_at_s, warnings
//   nodes, cells, elements, steps, sim_time_s, wall_time_s, output_time_s, ns_per_element_step
//                   elements: the triangles or tetrahedra of result.h5; speed: of a one-point cell as one element
//   time_step_s {first, min, limited_by}
//   energy_J {kinetic, elastic, plastic, contact, friction, damping, work, initial,
//             balance_error, kinetic_over_internal, kinetic_over_internal_formed,
//             kinetic_over_internal_forming}
//                   formed: at the end of forming, where the tools may rest already; forming: the
//                   largest of the form stages' peaks, which judges mass scaling and tool speed
//   options {bulk_viscosity, damping, settling, mass_scaling,
//            time_step {limit, estimates, products, share_of_longer_steps},
//            raised_step {to_s, added_mass_kg, fraction, bodies [{name, added_mass_kg}],
//                         most {node, added_mass_kg, position}}}   null without time_step.raise_to
//   contact {crossings, halvings, min_gap_over_h0, h0_m, sweeps_per_step, share_at_max_sweeps, explicit_stable_dt_s}
//                   per_step, share: of the steps with sweeps; null without any
//   plastic_strain {max, where}                      at the end (it never decreases)
//   damage [{body, criterion, unit, max, where, critical}]
//                   of bodies whose material has it, at the end (it never decreases); critical: null where it is not given
//   forming_limit [{body, max, where, at_end {max, where}, beyond}]
//                   of bodies whose material has one, parts of it; max: over all rows of the history; beyond: the part of the sheet that is above 1 at the end
//   surface_strain {max, where, at_end_of_forming {max, where}, at_end {max, where}}
//                   max: over all rows of the history; forming ends with the last form stage
//   thickness_m {initial, min}                       smallest at the start, smallest over the history
//   thinning {max, where, at_end {max, where}}       1 - thickness over that of the start; max: over the history
//   bodies [{name, mass, centre, momentum, angular_momentum, bounding_box {min, max}}]
//   tools [{name, peak_force, peak_radial_force, unit, peak_moment, moment_unit, position, orientation_xyzw, turned_deg, present, stopped_s}]
//                   peak_radial_force: of an axisymmetric run, else null: outward, summed around the circle;
//                   stopped_s: when it stopped under its stop_force, else null
//   springback {angle_deg_formed, angle_deg_released, change_deg, probe {from, to, reference_from, reference_to}, kinetic_over_internal}
//   stages [{name, kind, end_time_s, kinetic_J, internal_J, elastic_J, plastic_J, kinetic_over_internal,
//            kinetic_over_internal_peak}]
//                   peak: of the rows of the history at which the internal energy was at least 1 %
//                   of what it was at the end of the stage
//
// SI units; in plane strain energies, masses and forces are per metre of width
// ("per_metre_of_width": true). where: {element, body, position, time_s}.
// A number that is not defined is null. A scene that was refused has status,
// version, scene, dimension, axisymmetric and faults [{field, given, remedy}].
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "forming_sim/results/gauge.h"
#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

/// Everything but resumed_at_s. gauge: measures the simulation as it stands.
nlohmann::ordered_json summarize(const Simulation& simulation, const Scene& scene, const RunRecord& record,
                                 Gauge& gauge, Code code, const std::string& message);

/// For a run that did not come to its start.
nlohmann::ordered_json summarize_refusal(const Scene& scene, const std::vector<Fault>& faults, Code code,
                                         const std::string& message);

/// DIRECTORY/summary.json, replaced as a whole. Throws Error(output_error).
void write_summary(const std::string& directory, const nlohmann::ordered_json& summary);

/// What stands there, as text. Throws Error(output_error) where it is none.
std::string read_summary_text(const std::string& directory);

/// Writes the summary when the run ends.
class SummaryFile : public Observer {
 public:
  SummaryFile(const Scene& scene, const std::string& directory, Gauge& gauge, const RunRecord& record)
      : scene_(scene), directory_(directory), gauge_(gauge), record_(record) {}
  void on_start(const Simulation& simulation) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  const Scene& scene_;
  std::string directory_;
  Gauge& gauge_;
  const RunRecord& record_;
  double start_time_ = 0;
};

}  // namespace forming_sim
