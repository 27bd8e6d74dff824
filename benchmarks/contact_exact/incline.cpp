// An elastic block on an incline of tan = .5: with friction .5 it sticks, with .49 it slides as a rigid body does. Without
// damping friction feeds its swing: how fast, and what becomes of it.
#include "support/incline_impulses.h"
#include "support/incline_swing.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {
namespace {

std::string kind_of(const incline::Block& block) { return words("%dD, slope of %s", block.dimension, block.facets ? "facets" : "one plane"); }

void let_go(Report& report, const std::string& choice, const std::string& mesh, const incline::Block& block, double fineness) {
  const incline::Found found = incline::rest_or_slide(block);
  std::vector<double> answers{found.acceleration, found.ratio};
  if (incline::exact(block) == 0) answers = {found.acceleration, found.creep};
  report.add({choice, mesh, found.run, answers, "", fineness});
}

/// In the plane and in space, on facets and on a plane, by cells and by layer.
void all_kinds(Report& report, const incline::Block& given) {
  for (int dimension : {2, 3})
    for (bool facets : {false, true}) {
      incline::Block block = given;
      block.dimension = dimension;
      block.facets = facets;
      for (int cells : {3, 6, 12}) {
        block.cells = cells;
        let_go(report, kind_of(block), words("%d along", cells), block, cells);
      }
      block.cells = 6;
      for (double layer : {1e-3, 1e-4, 1e-6}) {
        if (!facets) continue;
        block.layer = layer;
        let_go(report, kind_of(block) + ", by layer", words("h0 %g m", layer), block, 0);
      }
    }
}

/// The run, and the same block by impulses on its nodes, without the package's contact and without a layer: means over 24 starts.
void let_go_twice(Report& report, const std::string& choice, const incline::Block& block, double incline::Found::*answer, double steps = 0.4) {
  const incline::BothWays mean = incline::both_ways(block, steps, 24);
  const std::string mesh = words("%d along", block.cells);
  for (const auto& [how, found] : {std::pair<const char*, const incline::Found&>{"", mean.found}, {", by impulses", mean.by_impulses}})
    report.add({choice + how, mesh, found.run, {found.*answer, found.ratio}, words("%s %.5f, tangential / normal %.5f", answer == &incline::Found::slip ? "slip, m/s" : "acceleration / g", found.*answer, found.ratio)});
}

/// What the eigenvalues say of the swing, and what the run did.
void let_swing(Report& report, const std::string& choice, const incline::Block& block, double steps = 0.4) {
  const incline::Grown grown = incline::let_swing(block, steps);
  std::string said = grown.damping == 0 ? "eigenvalues real, no swing grows" :
                     words("eigenvalues: %.1f 1/s at %.0f rad/s; damping of %.0f 1/s ends it; ", grown.linear.rate, grown.linear.frequency, grown.damping) +
                     words("with these steps %.2f 1/s at %.1f rad/s", grown.stepped.rate, grown.stepped.frequency);
  said += words("; swing %.1e m/s at first, %.1e at last", grown.first, grown.last);
  report.add({choice, words("%d x %d", block.cells, block.rows), grown.run, {grown.found.rate / grown.stepped.rate, grown.found.frequency / grown.stepped.frequency}, said});
}
void swings(Report& report) {
  report.begin("incline swings", "The growth of the swing of a block that slides, over that of the eigenvalues",
               {{"rate / that of the eigenvalues", 1, 0.01, kNothing}, {"frequency / that of the eigenvalues", 1, 0.005, kNothing}});
  struct Choice {
    int cells, rows;
    double mu;
  };
  for (const Choice& c : {Choice{1, 1, .49}, {2, 1, 0}, {2, 1, .1}, {2, 1, .3}, {3, 1, .1}, {3, 1, .3}, {3, 1, .49}, {6, 2, .49}, {8, 4, 0}, {8, 4, .49}, {16, 8, .49}})
    let_swing(report, words("friction %g", c.mu), incline::sliding_block(c.cells, c.rows, c.mu, 0));
  incline::Block block = incline::sliding_block(8, 4, .49, 0);
  block.facets = true;
  let_swing(report, "friction 0.49, slope of facets", block);
  for (double steps : {.8, .1}) let_swing(report, words("friction 0.49, steps of %g of the stable one", steps), incline::sliding_block(8, 4, .49, 0), steps);
  for (double damping : {300., 500., 730.}) let_swing(report, words("friction 0.49, damping %g 1/s", damping), incline::sliding_block(8, 4, .49, damping));
  let_swing(report, "friction 0.49, damping 500 1/s", incline::sliding_block(12, 4, .49, 500));
  for (int rows : {2, 4}) {
    block = incline::sliding_block(rows == 2 ? 6 : 8, rows, .49, 0);
    block.viscosity = .06;
    let_swing(report, "friction 0.49, bulk viscosity 0.06, which the eigenvalues do not know", block);
  }
}

}  // namespace

void incline_problem(Report& report) {
  const auto slides = [](const incline::Block& block) {
    return std::vector<Sought>{{"acceleration / g", incline::exact(block), 0.01, kNothing}, {"tangential / normal force", block.mu, 1e-4, kNothing}};
  };
  const std::vector<Sought> sticks{{"acceleration / g", 0, 1e-4, kNothing}, {"creep, m/s", 0, 1e-5, kNothing}};
  report.begin("incline sticks", "A block on an incline of tan = .5 with friction .5", sticks);
  all_kinds(report, {});
  incline::Block sliding;
  sliding.mu = 0.49;
  sliding.belt = 0.5;
  sliding.damping = 0;
  report.begin("incline slides", "A block on an incline of tan = .5 with friction .49", slides(sliding));
  all_kinds(report, sliding);
  swings(report);
  incline::Block swinging;
  swinging.damping = 0;
  swinging.swing = "free";
  swinging.mu = 0.51;
  report.begin("incline undamped sticks", "The same block without damping, friction .51", sticks);
  for (int cells : {3, 6, 12}) {
    swinging.cells = cells;
    let_go(report, kind_of(swinging), words("%d along", cells), swinging, cells);
  }
  report.begin("incline undamped stops", "The same, which slides at first on a belt, after 1 s", {{"slip, m/s", 0, 1e-4, kNothing}, {"tangential / normal force", 0.51, 1, kNothing}});
  swinging.facets = false;
  swinging.after = 1;
  for (double belt : {.01, .05})
    for (int cells : {1, 3, 6}) {
      swinging.cells = cells;
      swinging.belt = belt;
      let_go_twice(report, words("belt %g m/s", belt), swinging, &incline::Found::slip);
    }
  swinging.mu = 0.49;
  swinging.belt = 0;
  swinging.after = 0.4;
  report.begin("incline undamped slides", "The same without damping, friction .49, from rest", slides(swinging));
  for (bool facets : {false, true})
    for (int cells : {1, 3, 6, 12}) {
      swinging.cells = cells;
      swinging.facets = facets;
      if (facets)
        let_go(report, kind_of(swinging), words("%d along", cells), swinging, 0);
      else
        let_go_twice(report, kind_of(swinging), swinging, &incline::Found::acceleration);
    }
  // Faster than it swings.
  swinging.belt = 2;
  for (int cells : {3, 6, 12}) {
    swinging.cells = cells;
    let_go(report, kind_of(swinging) + ", belt 2 m/s", words("%d along", cells), swinging, 0);
  }
}

}  // namespace forming_sim::bench
