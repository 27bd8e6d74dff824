#include "forming_sim/results/progress_line.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/gauge.h"
#include "forming_sim/results/summary.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

std::string progress_text(const std::string& stage, double fraction, double seconds_left) {
  constexpr int width = 30;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(fraction * width);
  char text[160];
  std::snprintf(text, sizeof text, "%-12.40s [%s%s] %3d %%", stage.c_str(), std::string(filled, '#').c_str(),
                std::string(width - filled, '.').c_str(), static_cast<int>(fraction * 100));
  std::string line = text;
  if (seconds_left >= 0 && seconds_left < 1e6) {
    const long seconds = static_cast<long>(seconds_left + 0.5);
    std::snprintf(text, sizeof text, "  ETA %ld:%02ld", seconds / 60, seconds % 60);
    line += text;
  }
  return line;
}

void ProgressLine::on_start(const Simulation& simulation) {
  start_ = last_ = Clock::now();
  first_progress_ = simulation.progress();
}

void ProgressLine::on_step(const Simulation& simulation) {
  if (!is_terminal_ || simulation.steps() % 16 != 0) return;
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  print(simulation);
}

void ProgressLine::print(const Simulation& simulation) {
  const auto& stages = simulation.plan().stages;
  const std::size_t stage = std::min(static_cast<std::size_t>(simulation.stage()), stages.size() - 1);
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = simulation.progress() - first_progress_;
  const double left = done > 1e-6 ? elapsed * (1 - simulation.progress()) / done : -1;
  std::fprintf(stderr, "\r%s\x1b[K", progress_text(stages[stage].name, simulation.progress(), left).c_str());
  std::fflush(stderr);
}

void ProgressLine::on_stage_end(const Simulation& simulation, int index) {
  const std::string& name = simulation.plan().stages[static_cast<std::size_t>(index)].name;
  std::fprintf(stderr, "%sstage %s ended at %.6g s after %ld steps%s\n", is_terminal_ ? "\r" : "", name.c_str(), simulation.time(),
               simulation.steps(), is_terminal_ ? "\x1b[K" : "");
}

void ProgressLine::on_end(const Simulation&, Code, const std::string&) {
  if (is_terminal_) std::fprintf(stderr, "\r\x1b[K");
}

void EndTable::on_end(const Simulation& simulation, Code, const std::string&) {
  std::vector<std::string> warnings = simulation.warnings();
  std::optional<double> kinetic;  // over internal energy
  struct FormingLimitRow {
    std::string body;
    double most, beyond;
  };
  std::vector<FormingLimitRow> limits;
  try {
    const auto summary = nlohmann::json::parse(read_summary_text(directory_));
    warnings = summary.at("warnings").get<std::vector<std::string>>();
    if (const auto& most = summary.at("energy_J").at("kinetic_over_internal_forming"); most.is_number()) kinetic = most.get<double>();
    for (const auto& limit : summary.at("forming_limit"))
      if (const auto &most = limit.at("at_end").at("max"), &beyond = limit.at("beyond"); most.is_number() && beyond.is_number()) limits.push_back({limit.at("body"), most, beyond});
  } catch (const Error&) {}  // the disk is full, say: that is told already
  const std::vector<double> strain = simulation.plastic_strain();
  const ContactStatus contact = simulation.contact_status();
  const bool per_width = simulation.model().per_width();
  std::printf("elements             %d\nsteps                %ld\n", simulation.model().element_count(), simulation.steps());
  std::printf("simulated time       %.6g s\nsolver time          %.3g s\noutput time          %.3g s\n", simulation.time(), simulation.wall_time(), simulation.observed_time());
  std::printf("plastic strain, max  %.4g\n", strain.empty() ? 0.0 : *std::max_element(strain.begin(), strain.end()));
  const std::vector<double> damage = simulation.damage();
  for (const BodyModel* body : with_damage(simulation.model()))
    std::printf("damage of %-10s %.4g (%s)\n", body->name.c_str(), *std::max_element(damage.begin() + body->first_element, damage.begin() + body->first_element + body->element_count), body->material.damage->criterion.c_str());
  for (const FormingLimitRow& limit : limits) std::printf("forming limit of %-4s %.4g of it at most, beyond it %.3g %% of the sheet\n", limit.body.c_str(), limit.most, 100 * limit.beyond);
  if (kinetic) std::printf("kinetic / internal   %.3g at most while forming, once 1 %% of the internal energy is there\n", *kinetic);
  std::printf("balance error        %.3g\n", simulation.balance_error());
  std::printf("crossings            %ld\nsmallest gap / layer %.3g\n", contact.crossings, contact.min_gap_over_layer);
  if (contact.explicit_stable_dt > 0) std::printf("stable contact step  %.3g s\n", contact.explicit_stable_dt);
  for (std::size_t i = 0; i < simulation.tools().size(); ++i) {
    const ToolStatus& tool = simulation.tools()[i];
    const Vec3& force = tool.peak_force;
    std::printf("peak force on %-12s [%.4g, %.4g, %.4g] %s", simulation.model().tools[i].name.c_str(), force.x(), force.y(), force.z(), per_width ? "N/m" : "N");
    if (simulation.model().axisymmetric) std::printf(", radially %.4g N", tool.peak_radial_force);
    std::printf("\n");
  }
  for (const std::string& warning : warnings) std::printf("note: %s\n", warning.c_str());
  std::fflush(stdout);
}

}  // namespace forming_sim
