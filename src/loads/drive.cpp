#include "forming_sim/loads/drive.h"

#include <cmath>
#include <string>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"
#include "forming_sim/loads/rotation.h"

namespace forming_sim {

namespace {

[[noreturn]] void refuse(const std::string& field, const std::string& given, const std::string& remedy) {
  throw Error(Code::invalid_scene, "motion." + field + ": given " + given + "; " + remedy);
}

ScalarProfile profile_of(const MotionConfig& config, const std::vector<double>& values) try {
  return ScalarProfile(config.times, values, config.profile);
} catch (const Error& error) {
  throw Error(error.code(), std::string("motion.") + error.what());
}

/// The forces along their line; checks that they and the initial velocity have one.
ScalarProfile forces_along_guide(const MotionConfig& config) {
  const Vec3 guide = guide_of(config);
  if (guide.isZero(0)) refuse("forces", "no force other than 0, no guide and no initial_velocity", "give one entry for each time; a tool without any needs no motion");
  if (!goes_along(config.initial_velocity, guide)) refuse("initial_velocity", given_text(config.initial_velocity), "a tool starts along its guide");
  std::vector<double> along;
  for (std::size_t k = 0; k < config.forces.size(); ++k) {
    along.push_back(config.forces[k].dot(guide));
    if (!goes_along(config.forces[k], guide))
      refuse("forces[" + std::to_string(k) + "]", given_text(config.forces[k]), "a tool is guided along one line, and its forces go along that");
  }
  return profile_of(config, along);
}

}  // namespace

Vec3 guide_of(const MotionConfig& config) {
  Vec3 largest = config.guide;
  if (largest.isZero(0))
    for (const Vec3& force : config.forces)
      if (force.norm() > largest.norm()) largest = force;
  if (largest.isZero(0)) largest = config.initial_velocity;
  return largest.isZero(0) ? largest : Vec3(largest.stableNormalized());
}
bool goes_along(const Vec3& given, const Vec3& guide) { return (given - given.dot(guide) * guide).norm() <= 1e-12 * given.norm(); }

double Drive::free_speed(double t, double kick) const { return stands() ? 0 : unstopped_speed(t, kick); }

double Drive::unstopped_speed(double t, double kick) const {
  return free_inverse_mass(kick) * (kept(kick) * mass_ * momentum_ + kick * (force(t) + (damping_ + settling_) * mass_ * spring_.end_speed(t - began_)));
}

double Drive::free_inverse_mass(double kick) const { return 1 / (mass_ * (kept(kick) + 2 * braking(kick))); }

double Drive::stable_step() const { return spring_.stiffness > 0 ? 2 / std::sqrt(spring_.stiffness / mass_) : std::numeric_limits<double>::infinity(); }

void Drive::take_step(double t, double kick, double dt, double push, double answer) {
  const double unstopped = unstopped_speed(t, kick);  // where it is before the step
  speed_ = free_speed(t, kick) + push;
  gone_ += dt * speed_;
  momentum_ = unstopped + free_inverse_mass(kick) * answer;
  if (!stands()) against_ = gone_ >= ahead_ ? 1 : gone_ <= -behind_ ? -1 : 0;
  if (!(momentum_ * against_ >= 0)) against_ = 0;  // it leaves the stop
  if (stands()) momentum_ = 0;
}

ForceDrive::ForceDrive(const MotionConfig& config)
    : Drive(forces_along_guide(config), config.mass, config.damping, config.initial_velocity.dot(guide_of(config))), guide_(guide_of(config)) {
  if (config.stiffness > 0) tie_to({config.stiffness, RigidMotion(config, 3), guide_});
  const auto way = [](double stop) { return stop > 0 ? stop : std::numeric_limits<double>::infinity(); };
  put_stops(way(config.stop_ahead), way(config.stop_behind));
}

Pose ForceDrive::placed(Pose told, double way, double speed) const {
  told.translation += (way - told.translation.dot(guide_)) * guide_;
  told.velocity += (speed - told.velocity.dot(guide_)) * guide_;
  return told;
}

void ForceDrive::take(double t, double kick, double dt, double push, double answer) {
  take_step(t, kick, dt, push, answer);
  if (answer != 0) pressed_at_ = gone();
}

double ForceDrive::fallen(double t) const {
  if (springs_back() || stands()) return 0;  // what holds it does so wherever the bodies are
  const double F = force(t), along = F < 0 ? pressed_at_ - gone() : gone() - pressed_at_;
  return F != 0 && along > 0 ? along : 0;
}

AxleDrive::AxleDrive(const MotionConfig& config)
    : Drive(config.torques.empty() ? ScalarProfile() : profile_of(config, config.torques), config.inertia, config.spin_damping, kRadiansPerDegree * config.initial_spin_deg_s), axle_(config.axle.stableNormalized()) {}

}  // namespace forming_sim
