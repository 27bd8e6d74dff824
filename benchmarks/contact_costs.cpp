// What contact costs: a pair that is listed, a pair that carries force, and a tool
// that a body never comes near.
#include <algorithm>
#include <cmath>

#include "contact_costs.h"
#include "forming_sim/contact/contact.h"
#include "forming_sim/element/nodes.h"
#include "support/runs.h"
#include "timed_body.h"

namespace forming_sim::bench {
namespace {

/// n x n squares of 1 m in the plane z = 0, each two triangles; every other node so much lower.
Mesh flat_tool(int n, double lower = 0) {
  Mesh tool;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) tool.nodes.emplace_back(-0.0037 + 1.0051 * i / n, -0.0029 + 1.0047 * j / n, -lower * ((i + j) % 2));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      for (const auto& [b, c] : {std::pair(a + 1, a + n + 2), std::pair(a + n + 2, a + n + 1)}) {
        Facet facet;
        facet.nodes = {a, b, c};
        tool.surface.push_back(facet);
      }
    }
  return tool;
}

enum class Rub { none, free, damped };

/// The surface of a square plate of n x n cells over a tool of n x n squares
/// whose mesh does not match, and which is plane, or uneven by a hundredth of a layer, so that its edges have to be met.
class PlateOverTool {
 public:
  PlateOverTool(int n, bool plane, int threads, Rub rub = Rub::none) : x_(positions_of(plate(n))), team_(threads) {
    const Mesh body_mesh = plate(n);
    const Mesh tool = flat_tool(n, plane ? 0 : 0.01 * kLayer);
    ContactSetup setup;
    setup.config.layer = kLayer;
    setup.softest_modulus = 70e9;
    setup.thinnest = 0.02;
    setup.wave_speed = 5000;
    ContactSurface body, die;
    body.name = "plate";
    body.facets = body_mesh.surface;
    setup.config.swing = rub == Rub::damped ? "damped" : "free";
    body.waves = {8.5e6, 2.5e-5, 0, static_cast<int>(x_.size())};  // of .02 m of aluminium
    die.friction = rub == Rub::none ? 0 : .1;
    die.name = "die";
    die.rigid = true;
    die.facets = tool.surface;
    setup.bodies = {body};
    setup.tools = {die};
    setup.tool_meshes = {&tool};
    setup.team = &team_;
    for (Node& node : x_) node[2] += 1e-3;  // clear of the tool at the start
    contact_ = std::make_unique<Contact>(setup, x_, std::vector<ToolMotion>(1));
    contact_->set_masses(std::vector<double>(x_.size(), 1.0), {});
    for (Node& node : x_) node[2] -= kLayer + 1e-3;  // the tool stands a layer back
  }

  /// All nodes but one stand from now on, because they are clamped or because nothing moves them.
  void stand(bool clamped) {
    v_.assign(x_.size(), Node::Zero());
    v_[0] = Node(100, 0, 0, 0);
    std::vector<HeldNode> held;
    for (int n = 1; clamped && n < static_cast<int>(x_.size()); ++n) held.push_back({n, Mat3::Zero()});
    contact_->set_masses(std::vector<double>(x_.size(), 1.0), held);
  }

  /// One step with all nodes `gap` layers from the tool, along which they slide at 1 m/s where they do not stand; adds to times().
  ContactStep step(double gap) {
    contact_->time_parts(&times_);
    NodeField x = x_, v = v_;
    for (Node& node : x) node[2] += gap * kLayer;
    return contact_->advance(0, 1e-7, x, v, v_before_, [&](double, NodeField& v_star) { v_star = v; },
                             [&](double dt, const NodeField& with, NodeField& at) { move_nodes(NodeTeam(team_, static_cast<long>(at.size())), dt, with, nullptr, at); }, [](double, std::vector<ToolMotion>& motion) { motion.assign(1, ToolMotion()); });
  }
  const Contact& contact() const { return *contact_; }
  const ContactTimes& times() const { return times_; }

 private:
  static constexpr double kLayer = 1e-4;  // m
  static Mesh plate(int n) {
    BlankConfig blank;
    blank.shape = "plate";
    blank.pattern = "coarse";
    blank.length = blank.width = 1;
    blank.thickness = 0.02;
    blank.cells_along = blank.cells_across = n;
    blank.cells_through = 1;
    return generate_blank(blank);
  }
  NodeField x_, v_ = NodeField(x_.size(), Node(1, 0, 0, 0)), v_before_;
  Team team_;
  std::unique_ptr<Contact> contact_;
  ContactTimes times_;
};

constexpr double ContactTimes::* kParts[] = {&ContactTimes::list, &ContactTimes::narrow, &ContactTimes::lanes, &ContactTimes::sweeps, &ContactTimes::check, &ContactTimes::books};

ContactTimes least_times(PlateOverTool& scene, double gap, ContactStep& step) {
  scene.step(gap);  // builds the list
  ContactTimes least{1, 1, 1, 1, 1, 1};
  for (int turn = 0; turn < 20; ++turn) {
    const ContactTimes before = scene.times();
    step = scene.step(gap);
    for (auto part : kParts) least.*part = std::min(least.*part, scene.times().*part - before.*part);
  }
  return least;
}
double whole(const ContactTimes& times) {
  double sum = 0;
  for (auto part : kParts) sum += times.*part;
  return sum;
}

/// What facets that lie in one plane save.
void plane_costs(std::vector<Row>& rows) {
  const Clock clock;
  double seconds[2], pairs[2];
  for (const bool plane : {false, true}) {
    PlateOverTool scene(223, plane, 1);
    ContactStep step;
    seconds[plane] = whole(least_times(scene, 0.9, step));
    pairs[plane] = static_cast<double>(step.active);
  }
  const std::string name = "contact, 100k nodes on 100k facets of one plane, pressed";
  rows.push_back(just(name, "active pairs, of those on uneven facets", pairs[1] / pairs[0], clock.seconds()));
  rows.push_back(just(name, "time, of that on uneven facets", seconds[1] / seconds[0], clock.seconds()));
}

/// What a clamp saves that lies between tools at rest.
void clamp_costs(std::vector<Row>& rows) {
  const Clock clock;
  double seconds[2];
  for (const bool clamped : {false, true}) {
    PlateOverTool scene(223, false, 1);
    scene.stand(clamped);
    ContactStep step;
    seconds[clamped] = whole(least_times(scene, 1.02, step));
  }
  rows.push_back(just("contact, 100k nodes clamped over a tool at rest", "time, of that of nodes that are free", seconds[1] / seconds[0], clock.seconds()));
}

/// What friction takes, and what keeps the swing down that it feeds, in pairs.
void friction_costs(std::vector<Row>& rows) {
  const Clock clock;
  double seconds[3];
  for (const Rub rub : {Rub::none, Rub::free, Rub::damped}) {
    PlateOverTool scene(223, false, 1, rub);
    ContactStep step;
    seconds[static_cast<int>(rub)] = whole(least_times(scene, 0.9, step));
  }
  const std::string name = "contact, 100k nodes on 100k facets, pressed, friction .1";
  rows.push_back(just(name, "swing free: time, of that without friction", seconds[1] / seconds[0], clock.seconds()));
  rows.push_back(just(name, "swing damped: time, of that of swing free", seconds[2] / seconds[1], clock.seconds()));
}

/// Least times of the parts over some steps at the same gap; 223 x 223 squares make 100k triangles.
void pair_costs(double gap, int threads, const std::string& name, std::vector<Row>& rows) {
  const Clock clock;
  PlateOverTool scene(223, false, threads);
  ContactStep step;
  const ContactTimes least = least_times(scene, gap, step);
  const double listed = static_cast<double>(scene.contact().listed_pairs()), active = static_cast<double>(step.active);
  const auto per = [](double time, double count) { return 1e9 * time / count; };
  rows.push_back(just(name, "listed pairs", listed, clock.seconds()));
  const double search = least.list + least.narrow + least.check;
  if (step.active == 0) {
    rows.push_back(at_most(name, "ns a listed pair", per(search + least.lanes + least.sweeps + least.books, listed), 20, clock.seconds()));
    return;
  }
  rows.push_back(just(name, "active pairs", active, clock.seconds()));
  rows.push_back(just(name, "sweeps", step.sweeps, clock.seconds()));
  rows.push_back(at_most(name, "search, ns a listed pair", per(search, listed), 20, clock.seconds()));
  rows.push_back(just(name, "  of this closest points, layers", per(least.narrow, listed), clock.seconds()));
  rows.push_back(just(name, "  of this the continuous check", per(least.check, listed), clock.seconds()));
  rows.push_back(just(name, "into tiles and lanes and back, ns an active pair", per(least.lanes, active), clock.seconds()));
  rows.push_back(at_most(name, "sweeps, ns an active pair and sweep", per(least.sweeps, active * step.sweeps), 45, clock.seconds()));
  rows.push_back(just(name, "energies and forces, ns an active pair", per(least.books, active), clock.seconds()));
}

/// A plate that flies past a tool, far from it, over the same plate alone.
void far_costs(std::vector<Row>& rows) {
  const Clock clock;
  const auto run = [](bool tool) {
    Model model;
    RunPlan plan;
    model.dimension = 3;
    BlankConfig blank;
    blank.shape = "plate";
    blank.pattern = "fine";
    blank.length = blank.width = 0.2;
    blank.thickness = 0.01;
    blank.cells_along = blank.cells_across = 40;
    blank.cells_through = 2;
    plan.stages.push_back(form_for(1));
    add_flying(model, plan, body_of(generate_blank(blank), aluminium(false)), "plate", Vec3(1, 0, 0));
    if (tool) {
      ToolModel die;
      die.name = "die";
      die.mesh = flat_tool(100);
      die.position = Vec3(0, 0, -0.5);
      model.tools.push_back(die);
    }
    return std::make_unique<Simulation>(plan, model, 1);
  };
  const std::unique_ptr<Simulation> with = run(true), without = run(false);
  const auto time = [](Simulation& sim) {
    const Clock step;
    for (int i = 0; i < 20; ++i) sim.step();
    return step.seconds();
  };
  std::vector<double> a, b;
  for (int turn = 0; turn < 40; ++turn) {
    a.push_back(time(*with));
    b.push_back(time(*without));
  }
  rows.push_back(at_most("a plate far from a tool", "time of a step / without the tool", median_ratio(a, b), 1.03, clock.seconds()));
}

}  // namespace

void contact_costs(std::vector<Row>& rows) {
  pair_costs(3, 1, "contact, 100k nodes on 100k facets, apart", rows);
  pair_costs(0.9, 1, "contact, 100k nodes on 100k facets, pressed", rows);
  pair_costs(0.9, 2, "the same by two threads", rows);
  plane_costs(rows);
  clamp_costs(rows);
  friction_costs(rows);
  far_costs(rows);
}

}  // namespace forming_sim::bench
