#include "rules.h"

#include <cmath>

#include "forming_sim/config/formula_field.h"
#include "forming_sim/material/constants.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/simulation/release.h"

namespace forming_sim {

std::vector<std::string> predefined_sets(const BlankConfig& blank) {
  if (blank.shape == "strip") return {"left", "right", "bottom", "top"};
  if (blank.shape == "plate") return {"left", "right", "front", "back", "bottom", "top"};
  std::vector<std::string> sets = blank.shape == "tube" ? std::vector<std::string>{"start", "end", "inside", "outside"} : std::vector<std::string>{"bottom", "top", "side"};
  if (blank.portion != "full") sets.push_back("symmetry_x");
  if (blank.portion == "quarter") sets.push_back("symmetry_y");
  return sets;
}

std::optional<std::vector<std::string>> known_sets(const BodyConfig& body) {
  std::vector<std::string> sets;
  if (body.blank) sets = predefined_sets(*body.blank);
  else if (!body.mesh || body.mesh->points.empty()) return std::nullopt;
  for (const SetConfig& set : body.sets) sets.push_back(set.name);
  return sets;
}

void add_missing_set(const std::string& set, const std::string& body, const std::vector<std::string>& sets, const std::string& path, FaultList& faults) {
  faults.add(path, given_text(set), sets.empty() ? "body " + body + " has no sets; declare one under its sets"
                                                 : "body " + body + " has the sets " + one_of(sets, ", ") + did_you_mean(set, sets));
}

void check_times(const std::vector<double>& times, const std::string& path, FaultList& faults) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    faults.add(path, number_text(times[i]) + " after " + number_text(times[i - 1]), "give strictly increasing times");
    return;
  }
}

namespace {

void check_source(const BodyConfig& body, const std::string& path, int dimension, FaultList& faults) {
  std::vector<std::string> given;
  if (body.blank) given.push_back("blank");
  if (body.mesh) given.push_back("mesh");
  if (body.formed) given.push_back("formed");
  if (given.size() != 1) faults.add(path, given.empty() ? "none of blank, mesh and formed" : one_of(given, " and "), "give exactly one of blank, mesh and formed");
  if (body.mesh) check_mesh(*body.mesh, path + ".mesh", dimension, false, faults);
  if (body.formed) check_formed(*body.formed, path + ".formed", faults);
  if (!body.blank) return;
  const BlankConfig& blank = *body.blank;
  const bool flat = blank.shape == "strip";
  const bool known = flat || blank.shape == "plate" || blank.shape == "bar" || blank.shape == "tube";
  if (known && dimension == 2 && !flat) faults.add(path + ".blank.shape", given_text(blank.shape), "give strip, the blank of dimension 2, or set dimension to 3");
  if (known && dimension == 3 && flat) faults.add(path + ".blank.shape", given_text(blank.shape), "give plate, bar or tube, the blanks of dimension 3, or set dimension to 2");
  if (blank.shape == "tube") {
    if (blank.radius > 0 && blank.thickness >= blank.radius) faults.add(path + ".blank.thickness", given_text(blank.thickness), "give less than the radius, " + number_text(blank.radius) + " m: it is the wall's");
    const int parts = 4 / quarters_of(blank.portion);
    if (blank.cells_around % parts != 0) faults.add(path + ".blank.cells_around", std::to_string(blank.cells_around), "give a multiple of " + std::to_string(parts) + " with portion " + blank.portion + ": so many go around the whole circle");
  }
  constexpr double most = 2e7;  // about 10 GB of state
  if (known && simplices_of(blank) > most) {
    faults.add(path + ".blank", number_text(simplices_of(blank)) + " elements", "give fewer cells: at most " + number_text(most) + " elements to a body");
  }
}

void check_hardening(const HardeningConfig& hardening, const std::string& path, FaultList& faults) {
  if (hardening.curve == "voce" && hardening.saturation_stress < hardening.yield_stress) {
    faults.add(path + ".saturation_stress", given_text(hardening.saturation_stress),
               "give at least the yield_stress, " + number_text(hardening.yield_stress) + " Pa: the material may not soften");
  }
  if (hardening.curve != "table") return;
  const auto& strains = hardening.plastic_strains;
  const auto& stresses = hardening.stresses;
  if (!strains.empty() && strains.front() != 0) faults.add(path + ".plastic_strains", "a first strain of " + number_text(strains.front()), "let the table start at plastic strain 0, with the yield stress");
  for (std::size_t i = 1; i < strains.size(); ++i) {
    if (strains[i] > strains[i - 1]) continue;
    faults.add(path + ".plastic_strains", number_text(strains[i]) + " after " + number_text(strains[i - 1]), "give strictly increasing plastic strains");
    break;
  }
  for (std::size_t i = 1; i < stresses.size(); ++i) {
    if (stresses[i] >= stresses[i - 1]) continue;
    faults.add(path + ".stresses", number_text(stresses[i]) + " after " + number_text(stresses[i - 1]), "give stresses that do not decrease: the material may not soften");
    break;
  }
  if (strains.size() != stresses.size() && !strains.empty() && !stresses.empty()) {
    faults.add(path + ".stresses", std::to_string(stresses.size()) + " stresses", "give one for each of the " + std::to_string(strains.size()) + " plastic_strains");
  }
}

void check_forming_limit(const FormingLimitConfig& curve, const std::string& path, FaultList& faults) {
  const std::vector<double>&minor = curve.minor_strains, &major = curve.major_strains;
  for (std::size_t i = 1; i < minor.size(); ++i) {
    if (minor[i] > minor[i - 1]) continue;
    faults.add(path + ".minor_strains", number_text(minor[i]) + " after " + number_text(minor[i - 1]), "give strictly increasing minor strains");
    break;
  }
  if (minor.size() != major.size() && !minor.empty() && !major.empty())
    faults.add(path + ".major_strains", std::to_string(major.size()) + " strains", "give one for each of the " + std::to_string(minor.size()) + " minor_strains");
}

void check_one_point(const BodyConfig& body, const std::string& path, FaultList& faults) {
  const std::string* pattern = body.blank ? &body.blank->pattern : body.mesh ? &body.mesh->pattern : nullptr;
  if (!pattern || *pattern != "one_point") return;
  if (body.pressure_average == "node")
    faults.add(path + ".pressure_average", given_text(body.pressure_average), "give cell: a one-point cell has a pressure of its own, none in nodes");
}

void check_anisotropy(const MaterialConfig& material, const std::string& path, int dimension, FaultList& faults) {
  const std::string here = path + ".anisotropy";
  if (!material.yields()) faults.add(here, "anisotropy without hardening", "give hardening, or layers that have one: it is the yield stress that depends on the direction");
  const AnisotropyConfig& config = *material.anisotropy;
  if (!config.rolling_direction.allFinite() || !config.sheet_normal.allFinite()) return;
  for (const DirectionFault& fault : find_direction_faults(config, dimension)) faults.add(here + "." + fault.field, fault.given, fault.right);
}

void check_rate(const MaterialConfig& material, const std::string& path, FaultList& faults) {
  const std::string here = path + ".rate_dependence";
  if (!material.yields()) faults.add(here, "rate_dependence without hardening", "give hardening, or layers that have one: it is the yield stress that depends on the rate");
  const RateDependenceConfig& rate = *material.rate_dependence;
  if (rate.law == "cowper_symonds" && rate.exponent > 0 && rate.exponent < 1) faults.add(here + ".exponent", given_text(rate.exponent), "give P of 1 + (r/D)^(1/P), at least 1");
  if (rate.law == "power" && rate.exponent > 1) faults.add(here + ".exponent", given_text(rate.exponent), "give m of (r/r0)^m, at most 1");
}

void check_material(const BodyConfig& body, const std::string& path, int dimension, FaultList& faults) {
  const MaterialConfig& material = body.material;
  const std::string here = path + ".material";
  if (material.hardening) check_hardening(*material.hardening, here + ".hardening", faults);
  if (material.law == "classical" && body.pressure_average == "node") {
    faults.add(path + ".pressure_average", given_text(body.pressure_average), "give cell or element: the classical law keeps a pressure in every element, none in nodes");
  }
  if (material.anisotropy) check_anisotropy(material, here, dimension, faults);
  if (material.anisotropy && body.blank && body.blank->shape == "tube") faults.add(here + ".anisotropy", "r values of a tube", "leave them out: they have one sheet_normal, and that of a wall turns around");
  if (material.rate_dependence) check_rate(material, here, faults);
  if (material.damage && !material.yields()) faults.add(here + ".damage", "damage without hardening", "give hardening, or layers that have one: damage grows with plastic flow");
  if (material.forming_limit) check_forming_limit(*material.forming_limit, here + ".forming_limit", faults);
  if (material.layers.empty()) return;
  if (material.hardening) faults.add(here, "both hardening and layers", "give one of them: each layer has a hardening of its own");
  if (material.layers.size() > kMaxLayers) {
    faults.add(here + ".layers", std::to_string(material.layers.size()) + " layers", "give at most " + std::to_string(kMaxLayers));
  }
  double sum = 0;
  for (std::size_t k = 0; k < material.layers.size(); ++k) {
    const LayerConfig& layer = material.layers[k];
    sum += layer.weight;
    if (layer.hardening) check_hardening(*layer.hardening, join_path(here + ".layers", k) + ".hardening", faults);
  }
  if (std::abs(sum - 1) > 1e-3) faults.add(here + ".layers", "weights with the sum " + number_text(sum), "let the weights sum to 1: they are the shares of the shear modulus");
}

void check_formulas(const std::vector<std::string>& formulas, const std::string& here, int dimension, FaultList& faults) {
  if (!formulas.empty() && static_cast<int>(formulas.size()) != dimension && (dimension == 2 || dimension == 3))
    faults.add(here, std::to_string(formulas.size()) + " formulas", "give " + std::to_string(dimension) + ", one for each coordinate; \"0\" where nothing moves");
  faults.each(formulas, [&](std::size_t i) {
    try {
      const FormulaField alone({formulas[i]});
    } catch (const Error& error) {
      faults.add(join_path(here, i), given_text(formulas[i]), error.what());
    }
  });
}

}  // namespace

void check_bodies(const Scene& scene, FaultList& faults) {
  const std::vector<StageConfig> stages = named(scene.stages);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyConfig& body = scene.bodies[i];
    const std::string path = body_path(i);
    check_source(body, path, scene.dimension, faults);
    check_material(body, path, scene.dimension, faults);
    check_one_point(body, path, faults);
    check_formulas(body.initial_velocity_field, path + ".initial_velocity_field", scene.dimension, faults);
    check_formulas(body.imperfection, path + ".imperfection", scene.dimension, faults);
    if (body.formed && !body.imperfection.empty())
      faults.add(path + ".imperfection", std::to_string(body.imperfection.size()) + " formulas, for a formed part", "leave it out: it is what a blank has before it is formed");
    const auto sets = known_sets(body);
    const auto check_set = [&](const std::string& set, const std::string& here) {
      if (!sets || set.empty() || std::find(sets->begin(), sets->end(), set) != sets->end()) return;
      add_missing_set(set, body.name, *sets, here + ".set", faults);
    };
    const auto check_acting = [&](const auto& load, const std::string& here) {  // what acts on a set over time
      check_set(load.set, here);
      check_stage_name(load.since, stages, 0, here + ".since", faults);
      check_times(load.times, here + ".times", faults);
    };
    for (std::size_t k = 0; k < body.boundaries.size(); ++k) {
      const BoundaryConfig& boundary = body.boundaries[k];
      const std::string here = join_path(path + ".boundaries", k);
      check_set(boundary.set, here);
      const bool begins = check_stage_name(boundary.since, stages, 0, here + ".since", faults), ends = check_stage_name(boundary.until, stages, 1, here + ".until", faults);
      if (begins && ends && !boundary.since.empty() && !boundary.until.empty() && first_stage(boundary.since, stages) >= release_stage(boundary.until, stages))
        faults.add(here + ".until", given_text(boundary.until), "name a stage after that of since, " + boundary.since + ": the boundary lets go when it begins");
      if (!boundary.is_driven()) continue;
      check_times(boundary.times, here + ".times", faults);
      check_as_many(boundary.velocities, boundary.times, here + ".velocities", faults);
      check_as_many(boundary.spins_deg_s, boundary.times, here + ".spins_deg_s", faults);
      check_as_many(boundary.positions, boundary.times, here + ".positions", faults);
      check_as_many(boundary.rotations_deg, boundary.times, here + ".rotations_deg", faults);
      if (boundary.kind == "trajectory") {
        if (boundary.positions.empty() && boundary.rotations_deg.empty()) faults.add(here, "a trajectory without positions and rotations_deg", "give at least one of them, an entry for each time");
        if (boundary.times.size() == 1) faults.add(here + ".times", "one time", "give at least two: a trajectory goes from one to the next");
        continue;
      }
      if (boundary.profile == "spline") faults.add(here + ".profile", given_text(boundary.profile), "give smooth or linear: a spline is for trajectories");
      if (boundary.velocities.empty() && boundary.spins_deg_s.empty())
        faults.add(here, "a velocity without velocities and spins_deg_s", "give at least one of them, an entry for each time");
    }
    for (std::size_t k = 0; k < body.pressures.size(); ++k) {
      const std::string here = join_path(path + ".pressures", k);
      check_acting(body.pressures[k], here);
      check_as_many(body.pressures[k].values, body.pressures[k].times, here + ".values", faults);
    }
    for (std::size_t k = 0; k < body.loads.size(); ++k) {
      const std::string here = join_path(path + ".loads", k);
      check_acting(body.loads[k], here);
      check_as_many(body.loads[k].tractions, body.loads[k].times, here + ".tractions", faults);
      check_as_many(body.loads[k].forces, body.loads[k].times, here + ".forces", faults);
    }
  }
}

}  // namespace forming_sim
