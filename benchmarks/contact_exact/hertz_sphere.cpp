// A sphere strikes a rigid plane, against Hertz, who takes it for a half space: by cells a radius, by speed (a/R) and by h0.
#include "support/hertz_sphere.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {
namespace {

void struck(Report& report, const std::string& choice, const std::string& mesh, const hertz_sphere::Strike& given, double fineness) {
  const hertz_sphere::Found found = hertz_sphere::strike(given);
  report.add({choice, mesh, found.run, {found.approach, found.force, found.duration, found.rebound}, "", fineness});
}

}  // namespace

void hertz_sphere_problem(Report& report) {
  const std::vector<Sought> sought{{"approach / Hertz", 1, 0.015}, {"greatest force / Hertz", 1, 0.015}, {"duration / Hertz", 1, 0.015}, {"rebound", 1, 1e-3}};
  report.begin("hertz sphere", "Sphere strikes a plane at 1 m/s, a/R .042", sought, "cells a radius");
  for (int cells : {8, 14, 28, 56}) {
    hertz_sphere::Strike given;
    given.cells = cells;
    struck(report, "axisymmetric", words("%d a radius", cells), given, cells);
  }
  for (const char* pattern : {"coarse", "fine"})
    for (int cells : {6, 8, 10}) {
      if (pattern == std::string("fine") && cells > 8) continue;
      hertz_sphere::Strike given;
      given.dimension = 3;
      given.cells = cells;
      given.gather = 10;
      given.pattern = pattern;
      struck(report, words("3D, %s", pattern), words("%d a radius", cells), given, cells);
    }
  report.begin("hertz sphere by speed", "Sphere strikes a plane: speed and layer", sought, "");
  for (double speed : {3., 1., .3, .1}) {
    hertz_sphere::Strike given;
    given.cells = 28;
    given.gather = 6 * std::pow(speed, -0.4);  // cells as a
    given.speed = speed;
    struck(report, "speed", words("%g m/s, a/R %.3f", speed, hertz_sphere::half_width(speed)), given, 0);
  }
  for (double layer : {1e-6, .2e-6, .05e-6, .01e-6}) {
    hertz_sphere::Strike given;
    given.cells = 28;
    given.layer = layer;
    struck(report, "layer", words("h0 %g um", 1e6 * layer), given, 0);
  }
}

}  // namespace forming_sim::bench
