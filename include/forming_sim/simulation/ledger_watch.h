#pragma once
// Steps that get shorter where the ledger tells that they are too long.
//
// A step below the stable one keeps the energy of small swings. Of large ones it need not: where forces are not linear, swings of which
// three steps make a turn, omega dt = sqrt(3), or four, sqrt(2), take energy from nowhere (Schlick, Mandziuk, Skeel and
// Srinivas, J. Comput. Phys. 140, 1998). A step taken from the cells is too short for that, as a rule; one that is taken from the mesh as
// a whole is not, since its fastest swing has omega dt = 1.8. A block that swings freely by strains
// of .4 % for a million steps gains a tenth of its energy so.
#include <algorithm>

namespace forming_sim {

class LedgerWatch {
 public:
  bool due(long step) const { return step >= next_; }
  /// residual: of the ledger; put_in: the largest work + initial so far, and no less than what rounding could feign, J. Whether steps get shorter.
  bool look(long step, double residual, double put_in) {
    next_ = step + kSteps;
    const bool leaked = residual - last_ > std::max(kLeak * put_in, kSlip * (put_in - put_in_)), leaks = leaked && leaked_before_;
    last_ = residual;
    put_in_ = put_in;
    leaked_before_ = leaked;
    goal_ = leaks ? std::max(kLeast, kShorter * goal_) : std::min(1.0, kLonger * goal_);
    shortened_ += leaks;
    return leaks;
  }
  /// Of the step that the mesh bears.
  double factor() const { return factor_; }
  /// Once a step. Steps get shorter little by little: a swing near the limit of the step gains what its energy by the longer ones differs from that by the shorter, and
  /// more where they fall at once.
  void follow() { factor_ = std::max(goal_, kFall * factor_); }
  /// Looks that made the steps shorter.
  long shortened() const { return shortened_; }

  template <class Archive> void exchange(Archive& a) {
    for (long* value : {&shortened_, &next_}) a.number(*value);
    a.raw(leaked_before_);
    for (double* value : {&last_, &put_in_, &goal_, &factor_}) a.number(*value);
  }

 private:
  static constexpr long kSteps = 250;    ///< between two looks, each of which costs about as much as two or three steps
  static constexpr double kLeak = 3e-4;  ///< of what was put in, between two looks and again to the next: what strikes leaks once
  static constexpr double kSlip = 1e-2;  ///< of what was put in since the last look: plastic flow that begins in fast steps leaves as much
  static constexpr double kShorter = 0.8, kLonger = 1.01, kLeast = 0.4, kFall = 0.99;

  long shortened_ = 0, next_ = kSteps;
  bool leaked_before_ = false;
  double last_ = 0, put_in_ = 0, goal_ = 1, factor_ = 1;
};

}  // namespace forming_sim
