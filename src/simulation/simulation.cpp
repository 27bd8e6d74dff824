#include "forming_sim/simulation/simulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>

#include "simulation/impl.h"

namespace forming_sim {

namespace {
constexpr double kOpenLedger = 0.05;  ///< balance error at the end of a stage from which on the run warns
constexpr int kCrossingChecks = 200;  ///< independent crossing checks over a run
}

void Simulation::Impl::begin_stage() {
  rests = false;
  const BoundarySet held_before = boundaries;
  std::vector<Vec3> impulses_on_held(held_before.nodes().size(), Vec3::Zero());  // of contact and ties
  if (contact) contact->add_held_impulses(impulses_on_held);
  const bool ended = change_boundaries();
  begin_loads();
  if (steps > 0 && !stages.finished()) {
    let_go(held_before, impulses_on_held, ended);
    // What is free at once begins to swing, often faster than what the last step was for: its first kick is that of its own steps. A longer one would give it energy.
    if (ended && !lets_go_slowly()) {
      find_stable_step();
      previous_dt = std::min(previous_dt, full_dt());
    }
  }
  ways = tool_ways = Ways();
  if (!stages.settling()) return;
  std::vector<double> slowest, least;
  for (const BodyModel& body : model.bodies) {
    slowest.push_back(slowness(body));
    const auto first = elements.nodal_mass().begin() + body.first_node;
    least.push_back(least_energy(std::accumulate(first, first + body.node_count, 0.0)));
  }
  settle = Settle(time, std::move(slowest), std::move(least), 2 * tools.size(), stages.stage().kinetic_fraction);
}

void Simulation::Impl::check_ledger(double residual, double error) {
  if (ledger_told || !(error > kOpenLedger)) return;
  ledger_told = true;
  std::ostringstream text;
  text.precision(3);
  text << "the energies do not add up: at the end of stage " << stages.stage().title() << ", " << time << " s, " << std::fabs(residual) << (model.per_width() ? " J/m, " : " J, ") << 100 * error
       << " % of what was put in, " << (residual > 0 ? "came from nowhere" : "were lost") << ". Forces and strains may be wrong by as much. Shorter steps (time_step.safety)"
       << (contact ? ", contact.method implicit and more contact.max_sweeps" : "") << " or a finer mesh where it deforms most close the ledger";
  warnings.push_back(text.str());
}

void Simulation::Impl::tell_unstopped() {
  const StageConfig& stage = stages.stage();
  if (stage.until_stopped.empty() || stages.stopped(stage.until_stopped)) return;
  const auto tool = std::find_if(model.tools.begin(), model.tools.end(), [&](const ToolModel& t) { return t.name == stage.until_stopped; });
  if (tool == model.tools.end() || !tool->motion) return;
  std::ostringstream text;
  text << "stage " << stage.title() << " ended after its duration: tool " << tool->name << " felt " << tools[tool - model.tools.begin()].most_against << " of the "
       << tool->motion->stop_force << (model.per_width() ? " N/m" : " N") << " that stop it";
  warnings.push_back(text.str());
}

bool Simulation::Impl::stage_over() {
  if (!stages.settling()) return stages.stopped(stages.stage().until_stopped) || stages.remaining(time) <= 1e-12 * (time + stages.stage().duration);
  const bool to_limit = stages.stage().ends == "limit";
  if (rests && !to_limit) return true;
  if (stages.remaining(time) > (to_limit ? 1e-12 * time : 0)) return false;
  if (rests) return true;
  // A stage that was to take its time and no more, before others, is no failure.
  if (to_limit && stages.index() + 1 < static_cast<int>(plan.stages.size())) warnings.push_back(why_unsettled());
  else unsettled = why_unsettled();
  return true;
}

void Simulation::Impl::check_crossings() {
  if (!contact) return;
  crossings += contact->count_crossings(x, tools_now());
  next_crossing_check = stages.progress(time) + 1.0 / kCrossingChecks;
}

void Simulation::Impl::check_passages() {
  if (!contact) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const std::string told = "body " + body.name + " lies in itself";
    if (std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) { return warning.compare(0, told.size(), told) == 0; })) continue;
    const int node = contact->passed_through_itself(static_cast<int>(b), x);
    if (node < 0) continue;
    std::ostringstream text;
    text << told << ": at the end of stage " << stages.stage().title() << ", " << time << " s, its surface passes through itself at (" << vec3(x[node]).transpose()
         << ") m, and bears nothing there. Set its self_contact to true";
    warnings.push_back(text.str());
  }
}

Simulation::Simulation(const RunPlan& plan, Model model, int threads)
    : impl_(std::make_unique<Impl>(plan, std::move(model), threads)) {}
Simulation::~Simulation() = default;

void Simulation::add(Observer& observer) { impl_->observers.push_back(&observer); }

bool Simulation::step() {
  Impl& s = *impl_;
  if (s.stages.finished()) return false;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  s.take_step();
  const bool over = s.stage_over();
  if (over || s.stages.progress(s.time) >= s.next_crossing_check) s.check_crossings();
  if (over) {
    s.elements.check_upright(s.x);
    s.check_ledger(energies().residual(), balance_error());
    s.check_passages();
    s.tell_unstopped();
  }
  const Clock::time_point stepped = Clock::now();
  s.wall += std::chrono::duration<double>(stepped - start).count();
  for (Observer* o : s.observers) o->on_step(*this);
  if (over) {
    const int ended = s.stages.index();
    for (Observer* o : s.observers) o->on_stage_end(*this, ended);
    s.stages.advance(s.time);
    s.place_tools();  // which it may take away
    s.begin_stage();
    s.tell_flight(energies());
  }
  s.observed += std::chrono::duration<double>(Clock::now() - stepped).count();
  return !s.stages.finished();
}

Outcome Simulation::run(const std::atomic<bool>& cancel) {
  Impl& s = *impl_;
  Outcome outcome;
  try {
    for (Observer* o : s.observers) o->on_start(*this);
    while (!s.stages.finished()) {
      if (cancel) {
        std::ostringstream text;
        text << "cancelled at " << s.time << " s after " << s.steps << " steps";
        outcome = {Code::cancelled, text.str()};
        break;
      }
      step();
    }
    if (outcome.code == Code::none) {
      outcome = {Code::success, "completed"};
      if (!s.unsettled.empty()) outcome = {Code::limit_reached, s.unsettled};
    }
  } catch (const Error& error) {
    std::ostringstream text;
    text << error.what() << " (at time " << s.time << " s, step " << s.steps << ")";
    outcome = {error.code(), text.str()};
  } catch (const std::exception& error) {
    outcome = {Code::internal_error, error.what()};
  }
  for (Observer* o : s.observers) {
    try {
      o->on_end(*this, outcome.code, outcome.message);
    } catch (const std::exception& error) {  // the others have what they keep to write all the same
      const auto* known = dynamic_cast<const Error*>(&error);
      if (outcome.code == Code::success || outcome.code == Code::limit_reached) outcome = {known ? known->code() : Code::internal_error, error.what()};
      else if (outcome.message.find(error.what()) == std::string::npos) outcome.message += std::string("; and ") + error.what();
    }
  }
  return outcome;
}

}  // namespace forming_sim
