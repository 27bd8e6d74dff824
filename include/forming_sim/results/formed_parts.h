#pragma once
// formed.h5 of a run, at its end.
#include <string>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

/// Writes the bodies where a run has come to its end; of one that broke off there is no formed part. Throws Error(output_error).
class FormedParts : public Observer {
 public:
  FormedParts(const Scene& scene, const std::string& path) : scene_(scene), path_(path) {}
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  const Scene& scene_;
  std::string path_;
};

}  // namespace forming_sim
