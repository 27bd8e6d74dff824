// A cylinder on a rigid plane, and on another cylinder of other cells, against Hertz, who takes both for half spaces:
// by cells across the half width a, by the size of the part that is meshed, by the load (a/R) and by h0.
#include "support/hertz_line.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {
namespace {

void pressed(Report& report, const std::string& choice, const std::string& mesh, const hertz_line::Press& given, double fineness) {
  const hertz_line::Found found = hertz_line::press(given);
  report.add({choice, mesh, found.run, {found.half_width, found.middle, found.shape}, "", fineness});
}

}  // namespace

void hertz_line_problem(Report& report) {
  const std::vector<Sought> sought{{"half width / a", 1, 0.01}, {"pressure in the middle / p0", 1, 0.01}, {"rms of the pressure / p0", 0, 0.03}};
  report.begin("hertz", "Cylinder pressed on a plane and on a cylinder, a/R .013", sought, "cells across a");
  for (double other : {0., 1., 1.3})
    for (double cells : {2, 4, 8, 16}) {
      if (other > 0 && cells > 8) continue;
      hertz_line::Press given;
      given.cells = cells;
      given.other_cells = other * cells;
      pressed(report, other == 0 ? "on a plane" : other == 1 ? "on a cylinder, same cells" : "on a cylinder, cells 1/1.3", words("%g across a", cells), given, cells);
    }
  report.begin("hertz by size", "Cylinder pressed on a plane: the part that is meshed, the load, the layer", sought, "");
  for (double size : {8., 16., 32.}) {
    hertz_line::Press given;
    given.cells = 8;
    given.size = size;
    pressed(report, "part of the cylinder", words("%g a high", size), given, 0);
  }
  for (double load : {4e5, 1e5, 2.5e4, 6.25e3}) {
    hertz_line::Press given;
    given.cells = 8;
    given.load = load;
    pressed(report, "load", words("a/R %.4f", hertz_line::half_width(load) / hertz_line::kRadius), given, 0);
  }
  for (double layer : {1e-1, 1e-2, 1e-3, 1e-4}) {
    hertz_line::Press given;
    given.cells = 8;
    given.layer = layer;
    pressed(report, "layer", words("h0 %g cell", layer), given, 0);
  }
}

}  // namespace forming_sim::bench
