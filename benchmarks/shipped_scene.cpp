#include "shipped_scene.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "figure.h"
#include "forming_sim/results/run_scene.h"
#include "forming_sim/scene/validate.h"
#include "scratch.h"
#include "table.h"

namespace forming_sim::bench {
Scene read_shipped(const std::string& name) { return read_valid_scene(share_file("scenes/" + name + ".yaml")); }

ShippedRun::ShippedRun(const std::string& name, const Request& request, Observer* watcher) : ShippedRun(read_shipped(name), name, request, watcher) {}

ShippedRun::ShippedRun(const Scene& scene, const std::string& name, const Request& request, Observer* watcher)
    : name_(name), pictures_(request.directory), scratch_(std::make_unique<Scratch>()) {
  directory_ = pictures_.empty() ? scratch_->path() : pictures_ + "/" + name_;
  std::vector<Observer*> watchers;
  if (watcher) watchers.push_back(watcher);
  const std::atomic<bool> cancel{false};
  const Clock clock;
  const Outcome outcome = run_scene(scene, directory_, 1, "", cancel, watchers);
  wall_time = clock.seconds();
  if (outcome.code != Code::success) throw std::runtime_error("scenes/" + name_ + ".yaml: " + outcome.message);
  std::ifstream(directory_ + "/summary.json") >> summary;
}

ShippedRun::~ShippedRun() = default;

void ShippedRun::draw(const std::string& field, double time, const std::string& picture) const {
  if (pictures_.empty()) return;
  std::ostringstream text;
  text.precision(17);
  text << time;
  run_script("plot_section.py", {directory_ + "/result.h5", "--field", field, "--time", text.str(), "--output", pictures_ + "/" + picture});
}

}  // namespace forming_sim::bench
