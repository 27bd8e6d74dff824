#pragma once
// The damage of all elements (material/damage.h), summed on the way: where p has grown on a stretch of steps, D grows by that times the mean of w at both ends,
// which are divided by the larger sigma_e of both: at one of them the element may have unloaded. Stretches are so long that p grows by about a hundredth
// on them, and of 64 steps at most, of fewer where something moves so fast that a cell could be strained by a tenth in them: a look costs about two passes over the elements.
#include <vector>

#include "forming_sim/element/elements.h"
#include "forming_sim/material/damage.h"
#include "forming_sim/simulation/model.h"

namespace forming_sim {

class Damage {
 public:
  /// Of the bodies whose material asks for it; those of formed parts go on from theirs. Elements as they are at the start.
  Damage(const Model& model, const Elements& elements, const NodeField& x);
  bool any() const { return !bodies_.empty(); }
  bool due(long steps) const { return any() && steps >= next_; }
  /// At the end of a stretch: plastic strains and Cauchy stresses (Pa) of all elements then; fastest: speed of a node over that of waves.
  void look(long steps, double fastest, const std::vector<double>& strain, const std::vector<Sym>& stress);
  /// Per element, with what has grown since the last look; NaN of bodies that do not ask for it. Empty where none does.
  std::vector<double> at(const std::vector<double>& strain, const std::vector<Sym>& stress) const;

  template <class Archive> void exchange(Archive& a) {
    for (std::vector<double>* values : {&damage_, &strain_}) a.numbers(values->data(), values->size());
    for (DamageStress& s : stress_)
      for (double* value : {&s.sigma_1, &s.sigma_m, &s.sigma_e}) a.number(*value);
    a.number(next_);
    a.number(stretch_);
  }

 private:
  struct Range {
    int first, end;  // elements
    DamageCriterion criterion;
  };
  template <class Work> void over_elements(Work&& work) const;  // work(element, criterion)
  std::vector<Range> bodies_;
  std::vector<double> damage_, strain_;  ///< [element] D and p at the last look; empty where no body asks
  std::vector<DamageStress> stress_;     ///< likewise
  long next_ = 1, stretch_ = 1;          ///< the step of the next look; steps between them
};

}  // namespace forming_sim
