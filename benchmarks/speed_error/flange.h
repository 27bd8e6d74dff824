#pragma once
// scenes/flange.yaml with something changed, and what a forming engineer reads from it.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/scene/scene.h"
#include "speed_error/problems.h"

namespace forming_sim::bench {

constexpr int kForceParts = 20;  ///< of the punch's stage, over each of which its force is a mean

struct Flanged {
  RunSize size;
  std::vector<double> force;   ///< on the punch, N/m, means over equal parts of its way
  double strain = 0;           ///< largest log strain of the surface, formed
  double springback = 0;       ///< degrees
  double kinetic_over_internal = 0;  ///< energies, the largest while it is formed
  double ledger = 0;           ///< error of the energy balance over the work
  long crossings = 0;
  std::string failure;         ///< "": none
};

/// The shipped scene with so many cells through the thickness, as long as high.
Scene flange_scene(int through);
/// Runs it on one thread.
Flanged flange(const Scene& scene);
/// What is asked for, the reference being right.
std::vector<Sought> flange_sought(const Flanged& reference);
void add_flange(Report& report, const std::string& choice, const std::string& mesh, const Flanged& run, const Flanged& reference);

}  // namespace forming_sim::bench
