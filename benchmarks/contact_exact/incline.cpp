// An elastic block on an incline of tan = .5: with friction .5 it sticks, with .49 it slides as a rigid body does.
#include "support/incline.h"

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
  report.begin("incline slides", "A block on an incline of tan = .5 with friction .49", slides(sliding));
  all_kinds(report, sliding);
  // Friction feeds the swing of an elastic body that slides slowly; without damping it grows until nodes slip back.
  incline::Block swinging;
  swinging.damping = 0;
  swinging.mu = 0.51;
  report.begin("incline undamped sticks", "The same without damping, friction .51", sticks);
  for (int cells : {3, 6, 12}) {
    swinging.cells = cells;
    let_go(report, kind_of(swinging), words("%d along", cells), swinging, cells);
  }
  swinging.mu = 0.49;
  report.begin("incline undamped slides", "The same without damping, friction .49: slow, and on a belt", slides(swinging));
  for (double belt : {0., .5, 2.})
    for (int cells : {3, 6, 12}) {
      swinging.cells = cells;
      swinging.belt = belt;
      let_go(report, kind_of(swinging) + words(", belt %g m/s", belt), words("%d along", cells), swinging, cells);
    }
}

}  // namespace forming_sim::bench
