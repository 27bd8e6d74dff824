#include "simulation/damage.h"

#include <algorithm>
#include <limits>

namespace forming_sim {

namespace {

constexpr double kGrowth = 0.01;  ///< of p in a stretch, about
constexpr double kLongest = 64;   ///< steps
constexpr double kOnset = 0.1;    ///< strain of a cell, as high as a wave goes in a step, at most in a stretch

DamageStress stress_of(const Sym& s) {
  Mat3 sigma;
  sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return damage_stress(sigma);
}

double mean_weight(DamageCriterion criterion, const DamageStress& a, const DamageStress& b) {
  const double flow = std::max(a.sigma_e, b.sigma_e);
  return 0.5 * (damage_per_strain(criterion, a, flow) + damage_per_strain(criterion, b, flow));
}

}  // namespace

template <class Work> void Damage::over_elements(Work&& work) const {
  for (const Range& body : bodies_)
    for (int e = body.first; e < body.end; ++e) work(e, body.criterion);
}

Damage::Damage(const Model& model, const Elements& elements, const NodeField& x) {
  for (const BodyModel& body : model.bodies)
    if (body.material.damage) bodies_.push_back({body.first_element, body.first_element + body.element_count, damage_criterion(body.material.damage->criterion)});
  if (!any()) return;
  damage_.assign(static_cast<std::size_t>(model.element_count()), std::numeric_limits<double>::quiet_NaN());
  stress_.resize(damage_.size());
  strain_ = elements.plastic_strain();
  const std::vector<Sym> stress = elements.observe(x).stress;
  over_elements([&](int e, DamageCriterion) {
    damage_[e] = 0;
    stress_[e] = stress_of(stress[e]);
  });
  for (const BodyModel& body : model.bodies) {
    if (!body.material.damage || !body.formed) continue;
    int e = body.first_element;
    for (std::size_t k = 0; k < body.mesh.cells.size(); ++k) {
      const int simplices = shape_of(body.mesh.cells[k].kind).simplices, points = body.formed->cells[k].points;
      for (int cell = 0; cell < body.mesh.cells[k].count(); ++cell)
        for (int s = 0; s < simplices; ++s) damage_[e++] = body.formed->cells[k].damage[static_cast<std::size_t>(cell) * points + s % points];
    }
  }
}

void Damage::look(long steps, double fastest, const std::vector<double>& strain, const std::vector<Sym>& stress) {
  double most = 0;
  over_elements([&](int e, DamageCriterion criterion) {
    const DamageStress now = stress_of(stress[e]);
    const double growth = strain[e] - strain_[e];
    if (growth > 0) damage_[e] += growth * mean_weight(criterion, stress_[e], now);
    stress_[e] = now;
    strain_[e] = strain[e];
    most = std::max(most, growth);
  });
  if (most > kGrowth) stretch_ /= 2;
  else if (most < 0.25 * kGrowth) stretch_ *= 2;
  stretch_ = std::clamp(stretch_, 1L, static_cast<long>(std::clamp(kOnset / fastest, 1.0, kLongest)));
  next_ = steps + stretch_;
}

std::vector<double> Damage::at(const std::vector<double>& strain, const std::vector<Sym>& stress) const {
  std::vector<double> now = damage_;
  over_elements([&](int e, DamageCriterion criterion) {
    const double growth = strain[e] - strain_[e];
    if (growth > 0) now[e] += growth * mean_weight(criterion, stress_[e], stress_of(stress[e]));
  });
  return now;
}

}  // namespace forming_sim
