#include "forming_sim/results/plan_text.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "forming_sim/config/words.h"
#include "forming_sim/results/gauge.h"

namespace forming_sim {
namespace {

const char* name_of(PressureMode mode) {
  return mode == PressureMode::cell ? "cell" : mode == PressureMode::element ? "element" : "node";
}

std::string law_of(const MaterialConfig& m, int layers) {
  if (m.law == "hyperelastic") return "hyperelastic";
  std::string text = m.law;
  if (!m.layers.empty()) text += ", " + std::to_string(layers) + (layers == 1 ? " layer" : " layers");
  else if (m.hardening) text += ", plastic (" + m.hardening->curve + ")";
  else text += ", elastic";
  if (m.anisotropy) text += ", Hill's yield with r0 " + number_text(m.anisotropy->r0);
  if (m.rate_dependence) text += ", raised by its rate (" + m.rate_dependence->law + ")";
  return text;
}

std::string kind_of(const SurfacePair& pair) {
  if (pair.tied) return "tied";
  if (!(pair.friction > 0)) return "no friction";
  const std::string limit = pair.friction_limit > 0 ? " up to " + number_text(pair.friction_limit) + " Pa" : "";
  return (pair.friction == std::numeric_limits<double>::max() ? "sticking" : "friction " + number_text(pair.friction)) + limit;
}

/// One line of the plan: a word that starts it once, then text.
class Lines {
 public:
  explicit Lines(std::ostream& out) : out_(out) {}
  void start(const std::string& word) { word_ = word; }
  void add(const std::string& text) {
    out_ << word_ << std::string(std::max<int>(1, 13 - static_cast<int>(word_.size())), ' ') << text << "\n";
    word_.clear();
  }

 private:
  std::ostream& out_;
  std::string word_;
};

}  // namespace

std::string plan_text(const Simulation& simulation) {
  const Model& model = simulation.model();
  const RunPlan& plan = simulation.plan();
  const TimeStepConfig& step = plan.time_step;
  std::ostringstream out;
  Lines lines(out);
  std::vector<std::string> absent;
  const auto if_any = [&](bool there, const std::string& text, const std::string& name) {
    if (there) lines.add(text);
    else absent.push_back(name);
  };

  lines.start("cells");
  bool nodal = false;
  for (const GroupPlan& g : simulation.groups()) {
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(), [&](const BodyModel& b) { return b.name == g.body; });
    const double count = static_cast<double>(g.elements);
    nodal = nodal || g.pressure == PressureMode::node;
    lines.add(g.body + ": " + std::to_string(g.cells) + " " + shape_of(g.kind).name + ", " + std::to_string(g.elements) + " elements; pressure per " +
              name_of(g.pressure) + (g.edge_points > 0 ? ", the rest at " + std::to_string(g.edge_points) + " edges" : "") + "; " + law_of(body->material, g.layers));
    lines.add("  bytes an element: " + number_text(std::round(g.memory_bytes / count)) + " state, " + number_text(std::round(g.force_bytes / count)) +
              " forces, " + number_text(std::round(g.index_bytes / count)) + " numbers of nodes");
  }
  const double nodes = static_cast<double>(model.node_count());
  lines.start("nodes");
  lines.add(number_text(nodes) + ": positions, velocities, forces, masses");

  lines.start("damage");
  const std::vector<const BodyModel*> damaged = with_damage(model);
  for (const BodyModel* body : damaged) lines.add(body->name + ": " + body->material.damage->criterion + ", summed at every 64th step or oftener");
  if_any(!damaged.empty(), "  40 bytes for each element of all bodies", "damage");

  lines.start("loads");
  std::size_t held = 0, pressed = 0, dead = 0;
  bool moving = false;
  for (const BodyLoads& loads : plan.bodies) {
    held += loads.boundaries.size();
    pressed += loads.pressures.size();
    dead += loads.loads.size();
    moving = moving || loads.moves_at_first();
  }
  if_any(held > 0, std::to_string(held) + " boundaries", "held or driven nodes");
  if (held > 0 || simulation.reactions_kept() > 0) if_any(simulation.reactions_kept() > 0, "reactions of " + std::to_string(simulation.reactions_kept()) + (held > 0 ? " held nodes" : " nodes on the axis") + ", for probes", "reactions of held nodes");
  if_any(pressed > 0, std::to_string(pressed) + " pressures on surfaces", "pressure on surfaces");
  if_any(dead > 0, std::to_string(dead) + " tractions and forces", "tractions and forces");
  if_any(!plan.gravity.isZero(), "gravity", "gravity");
  if_any(moving, "initial motion", "initial motion");
  if_any(step.damping > 0, "damping " + number_text(step.damping) + " 1/s", "damping");
  if_any(step.linear_viscosity > 0 || step.quadratic_viscosity > 0, "bulk viscosity", "bulk viscosity");
  if_any(step.mass_scaling != 1, "masses times " + number_text(step.mass_scaling), "mass scaling");

  lines.start("step");
  const BodyModel* classical = model.without_tangent();
  lines.add("by " + std::string(step.limit == "element" && step.raise_to > 0 ? "node" : step.limit) +
            (classical ? "; not by global: the law of body " + classical->name + " is classical"
             : step.limit == "element" && moving ? "; global would take fewer steps, with an impact's ledger some times less exact" : ""));
  if_any(step.raise_to > 0, "mass added for " + number_text(step.raise_to) + " s: " + number_text(100 * simulation.added_mass().fraction) + " %", "mass added for the step");

  lines.start("contact");
  const std::vector<SurfacePair> surface_pairs = simulation.surface_pairs();
  bool rubs = false;
  for (const SurfacePair& pair : surface_pairs) {
    rubs = rubs || pair.friction > 0;
    lines.add((pair.first == pair.second ? pair.first + " with itself" : pair.first + " with " + pair.second) + ": " + kind_of(pair));
  }
  for (const ToolModel& tool : model.tools)
    if (tool.motion && tool.motion->by_force()) lines.add(tool.name + " is driven by a force: its speed is found with the impulses of its pairs");
  for (const ToolModel& tool : model.tools)
    if (tool.turns_freely()) lines.add(tool.name + " turns freely about its axle: its spin is found with the impulses of its pairs");
  if (surface_pairs.empty()) absent.push_back("contact");
  else if (!rubs) absent.push_back("friction and slip");

  lines.start("stages");
  for (const StageConfig& stage : plan.stages) {
    const bool settles = stage.kind == "settle";
    lines.add(stage.name + ": " + (stage.kind == stage.name ? "" : stage.kind + ", ") + (settles ? "at most " : "") + number_text(settles ? stage.limit : stage.duration) + " s");
  }
  if (!nodal) absent.push_back("nodal pressure");
  lines.start("not there");
  std::string names;
  for (const std::string& name : absent) names += (names.empty() ? "" : ", ") + name;
  lines.add(names.empty() ? "nothing: the scene asks for everything" : names);
  return out.str();
}

}  // namespace forming_sim
