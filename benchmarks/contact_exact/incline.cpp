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

}  // namespace

void incline_problem(Report& report) {
  for (double mu : {.5, .49, .3}) {
    incline::Block block;
    block.mu = mu;
    if (mu == .5)
      report.begin("incline sticks", "A block on an incline of tan = .5 with friction .5", {{"acceleration / g", 0, 1e-5}, {"creep, m/s", 0, 1e-5}}, "cells");
    else
      report.begin(words("incline slides %g", mu), words("A block on an incline of tan = .5 with friction %g", mu),
                   {{"acceleration / g", incline::exact(block), 0.01}, {"tangential / normal force", mu, 1e-4}}, "cells");
    for (int dimension : {2, 3})
      for (bool facets : {false, true}) {
        block = {};
        block.mu = mu;
        block.dimension = dimension;
        block.facets = facets;
        for (int cells : {3, 6, 12}) {
          block.cells = cells;
          let_go(report, kind_of(block), words("%d along", cells), block, cells);
        }
        block.cells = 6;
        for (double layer : {1e-3, 1e-4, 1e-6}) {
          block.layer = layer;
          let_go(report, kind_of(block) + words(", h0 %g m", layer), "6 along", block, 0);
        }
      }
  }
}

}  // namespace forming_sim::bench
