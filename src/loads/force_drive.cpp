#include "forming_sim/loads/force_drive.h"

#include <string>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"

namespace forming_sim {

namespace {

[[noreturn]] void refuse(const std::string& field, const std::string& given, const std::string& remedy) {
  throw Error(Code::invalid_scene, "motion." + field + ": given " + given + "; " + remedy);
}

}  // namespace

Vec3 guide_of(const MotionConfig& config) {
  Vec3 largest = Vec3::Zero();
  for (const Vec3& force : config.forces)
    if (force.norm() > largest.norm()) largest = force;
  if (largest.isZero(0)) largest = config.initial_velocity;
  return largest.isZero(0) ? largest : Vec3(largest.stableNormalized());
}
bool goes_along(const Vec3& given, const Vec3& guide) { return (given - given.dot(guide) * guide).norm() <= 1e-12 * given.norm(); }

ForceDrive::ForceDrive(const MotionConfig& config) : guide_(guide_of(config)), mass_(config.mass), damping_(config.damping) {
  if (guide_.isZero(0)) refuse("forces", "no force other than 0, and no initial_velocity", "give one entry for each time; a tool without either needs no motion");
  if (!goes_along(config.initial_velocity, guide_)) refuse("initial_velocity", given_text(config.initial_velocity), "a tool is guided along the line of its forces, and starts along it");
  speed_ = momentum_ = config.initial_velocity.dot(guide_);
  std::vector<double> along;
  for (std::size_t k = 0; k < config.forces.size(); ++k) {
    along.push_back(config.forces[k].dot(guide_));
    if (!goes_along(config.forces[k], guide_))
      refuse("forces[" + std::to_string(k) + "]", given_text(config.forces[k]), "a tool is guided along one line, and its forces go along that");
  }
  try {
    force_ = ScalarProfile(config.times, along, config.profile);
  } catch (const Error& error) {
    throw Error(error.code(), std::string("motion.") + error.what());
  }
}

double ForceDrive::free_speed(double t, double kick) const {
  const double a = braking(kick);
  return ((1 - a) * momentum_ + kick * force(t) / mass_) / (1 + a);
}

double ForceDrive::inverse_mass(double kick) const { return 1 / (mass_ * (1 + braking(kick))); }

void ForceDrive::take(double t, double kick, double dt, double push, double answer) {
  const double free = free_speed(t, kick);
  speed_ = free + push;
  way_ += dt * speed_;
  momentum_ = free + inverse_mass(kick) * answer;
  if (answer != 0) pressed_at_ = way_;
}

double ForceDrive::fallen(double t) const {
  const double F = force(t), along = F < 0 ? pressed_at_ - way_ : way_ - pressed_at_;
  return F != 0 && along > 0 ? along : 0;
}

}  // namespace forming_sim
