#include "forming_sim/results/recorder.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/config/words.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/results/sharp_bend.h"
#include "forming_sim/simulation/body_of_element.h"

namespace forming_sim {

namespace {

bool forms(const StageConfig& stage) { return stage.kind == "form"; }

/// Whether the stage is the last that forms.
bool ends_forming(const Simulation& simulation, int stage) {
  const std::vector<StageConfig>& stages = simulation.plan().stages;
  return forms(stages[stage]) && std::none_of(stages.begin() + stage + 1, stages.end(), forms);
}

}  // namespace

void Recorder::on_start(const Simulation& simulation) {
  schedule_.start(simulation.time());
  if (record_.surface_strain.element >= 0) return;  // after a resume
  look(simulation);
  const std::vector<StageConfig>& stages = simulation.plan().stages;
  if (std::none_of(stages.begin(), stages.end(), forms)) see_formed_angle(simulation);  // a part comes as it was formed
}

void Recorder::on_step(const Simulation& simulation) {
  if (schedule_.due(simulation.time())) look(simulation);
}

void Recorder::on_stage_end(const Simulation& simulation, int index) {
  look(simulation);
  const StageConfig& stage = simulation.plan().stages[index];
  const Energies& energies = simulation.energies();
  StageRecord ended{stage.title(), stage.kind, simulation.time(),
                    energies.kinetic, energies.elastic, energies.plastic};
  ended.kinetic_over_internal_peak = record_.kinetic_peak.at_end(energies.elastic + energies.plastic);
  tell_inertia(simulation, stage);
  tell_sharp_bends(simulation, index);
  tell_great_strain(simulation, index);
  tell_short_steps(simulation, index);
  record_.kinetic_peak.levels.clear();
  record_.stages.push_back(ended);
  if (!forms(stage)) return;
  const Measures& measures = gauge_.at(simulation);
  record_.surface_strain_formed = measures.surface_strain;
  record_.kinetic_over_internal_formed.reset();
  if (std::isfinite(ended.kinetic_over_internal()))
    record_.kinetic_over_internal_formed = ended.kinetic_over_internal();
  if (std::isfinite(ended.kinetic_over_internal_peak))
    record_.kinetic_over_internal_forming = std::max(record_.kinetic_over_internal_forming.value_or(0), ended.kinetic_over_internal_peak);
  see_formed_angle(simulation);
}

void Recorder::see_formed_angle(const Simulation& simulation) {
  if (!output_.springback) return;
  const double angle = springback_angle_deg(*output_.springback, simulation.model().dimension, gauge_.probes(), gauge_.at(simulation).probes);
  if (std::isfinite(angle)) record_.angle_formed_deg = angle;
}

// Of what tools or boundaries form: that a body flies is the matter of an impact.
void Recorder::tell_inertia(const Simulation& simulation, const StageConfig& stage) {
  constexpr double kWellOnItsWay = 0.2;  // of the internal energy at the end
  constexpr double kMuch = 0.1;
  const Energies& e = simulation.energies();
  const double internal = e.elastic + e.plastic, most = record_.kinetic_peak.at_end(internal, kWellOnItsWay);
  if (!forms(stage) || !(most > kMuch) || e.initial > e.work || e.plastic < e.elastic) return;
  record_.notes.push_back("in stage " + stage.title() + " the kinetic energy was up to " + three_digits(100 * most) +
                          " % of the internal one when a fifth of this was there or more: unless bodies travel as a whole, inertia takes part in forces and shapes. Slower tools or less time_step.mass_scaling show by how much");
}

void Recorder::tell_sharp_bends(const Simulation& simulation, int stage) {
  constexpr double kSharp = 15;  // degrees; a bend of 8 to 11 a cell springs back by a tenth too little or too much, of 23 by a factor (docs/elements.md)
  if (!ends_forming(simulation, stage)) return;
  const Model& model = simulation.model();
  for (const BodyModel& body : model.bodies) {
    const SharpBend bend = sharpest_bend(body, simulation.positions());
    if (bend.degrees > kSharp)
      record_.notes.push_back("body " + body.name + " is bent by up to " + three_digits(bend.degrees) + " degrees from one cell to the next, at " + place(bend.place) +
                              " when forming ends: cells that follow a bend in steps of 10 degrees and less (docs/elements.md) give its force and its springback, longer ones neither");
  }
}

void Recorder::tell_great_strain(const Simulation& simulation, int stage) {
  constexpr double kGreat = 3;
  const Peak& strain = gauge_.at(simulation).plastic_strain;
  if (!ends_forming(simulation, stage) || !(strain.value > kGreat)) return;
  record_.notes.push_back("the plastic strain is up to " + three_digits(strain.value) + ", at " + place(strain.position) +
                          ", when forming ends: nothing parts here and nothing is meshed anew, so that where a tool cuts through metal its force and the shape about it are not those of metal. In bulk that is pressed from all sides such strains are real, and ask for small cells");
}

void Recorder::tell_short_steps(const Simulation& simulation, int stage) {
  constexpr double kShort = 0.1;  // of the first
  const StepLimit smallest = simulation.smallest_step();
  if (!ends_forming(simulation, stage) || smallest.reason == "time_step.maximum" || !(smallest.dt < kShort * simulation.first_dt())) return;
  record_.notes.push_back("the time step fell from " + three_digits(simulation.first_dt()) + " s at the start to " + three_digits(smallest.dt) + " s, limited by " + smallest.reason +
                          ": cells have become so thin or narrow, and the run took as many more steps. Where they are few, time_step.raise_to gives them mass instead; larger cells where the metal flows most, or other ones, stay longer in shape");
}

// Once a body, at the first row of the history where it is so.
void Recorder::tell_damage(const Simulation& simulation) {
  const std::vector<const BodyModel*> bodies = with_damage(simulation.model());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const DamageConfig& damage = *bodies[k]->material.damage;
    const Peak& most = gauge_.at(simulation).damage[k];
    if (damage.critical == 0 || most.value < damage.critical) continue;
    tell_once("body " + bodies[k]->name + " cracks by its criterion", ": at " + three_digits(most.time) + " s its damage (" + damage.criterion + ") had come to " + three_digits(most.value) + ", critical is " + three_digits(damage.critical) +
                            ", at " + place(most.position) + ". Nothing parts here: what follows is the forming of metal that holds");
  }
}

// Likewise.
void Recorder::tell_forming_limit(const Simulation& simulation) {
  const std::vector<const BodyModel*> bodies = with_forming_limit(simulation.model());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Peak& most = gauge_.at(simulation).limits.greatest[k];
    if (most.value < 1) continue;
    tell_once("body " + bodies[k]->name + " is beyond its forming limit", ": at " + three_digits(most.time) + " s the strains of its middle had come to " + three_digits(most.value) +
              " of the curve at " + place(most.position) + ", where the sheet begins to neck. A neck narrower than a cell is not seen here");
  }
}

// Of a sheet that nothing else says it of. What tools press thin, thins everywhere between them.
void Recorder::tell_thinning(const Simulation& simulation) {
  constexpr double kMuch = 0.5;
  const Peak& most = gauge_.at(simulation).thinning;
  if (!(most.value > kMuch)) return;
  const BodyModel& body = body_of_element(simulation.model(), most.element);
  if (body.material.damage || body.material.forming_limit || body.material.law == "hyperelastic") return;
  tell_once("body " + body.name + " has thinned by more than half", ": at " + three_digits(most.time) + " s by " + three_digits(100 * most.value) + " % at " + place(most.position) +
            ". A sheet that is stretched has necked and torn before that, in a band whose strain depends on the size of the cells; what tools press thin between them, as rolls do, bears it. material.forming_limit or material.damage tell where such a sheet ends");
}

/// Unless a note begins so already.
void Recorder::tell_once(const std::string& told, const std::string& more) {
  const auto begins_so = [&](const std::string& note) { return note.compare(0, told.size(), told) == 0; };
  if (std::none_of(record_.notes.begin(), record_.notes.end(), begins_so)) record_.notes.push_back(told + more);
}

void Recorder::on_end(const Simulation& simulation, Code code, const std::string&) {
  // What a cancelled run takes with it must be what an unbroken one has.
  if (code != Code::cancelled) look(simulation);
}

void Recorder::look(const Simulation& simulation) {
  const Energies& energies = simulation.energies();
  record_.kinetic_peak.look(energies.kinetic, energies.elastic + energies.plastic);
  const Measures& now = gauge_.at(simulation);
  if (now.thickness) {
    if (!record_.thickness_initial) record_.thickness_initial = gauge_.initial_thickness();
    record_.thickness_min = std::min(record_.thickness_min.value_or(*now.thickness), *now.thickness);
  }
  tell_damage(simulation);
  tell_forming_limit(simulation);
  tell_thinning(simulation);
  record_.limit_ratio.resize(now.limits.greatest.size());
  for (std::size_t k = 0; k < now.limits.greatest.size(); ++k) record_.limit_ratio[k].rise_to(now.limits.greatest[k]);
  record_.surface_strain.rise_to(now.surface_strain);
  record_.thinning.rise_to(now.thinning);
}

}  // namespace forming_sim
