// A strip on a drum: F2/F1 = exp(mu theta) for a strip without thickness, by cells, by thickness and by h0.
#include "support/capstan.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {
namespace {

void braked(Report& report, const std::string& choice, const std::string& mesh, const capstan::Strip& strip, double fineness) {
  const capstan::Found found = capstan::brake(strip);
  report.add({choice, mesh, found.run, {found.ratio / capstan::exact(strip)}, "", fineness});
}

}  // namespace

void capstan_problem(Report& report) {
  report.begin("capstan", "A strip around a drum, t/R .01", {{"F2/F1 / exp(mu theta)", 1, 0.015}}, "cells on a right angle");
  for (double mu : {.2, .4})
    for (double degrees : {90., 180.})
      for (int cells : {10, 20, 40}) {
        capstan::Strip strip;
        strip.mu = mu;
        strip.degrees = degrees;
        strip.cells = static_cast<int>(std::lround(cells * degrees / 90));
        braked(report, words("mu %g, %g degrees", mu, degrees), words("%d a right angle", cells), strip, cells);
      }
  // Friction acts t/2 within the middle of the strip: the exponent is mu theta / (1 + t/(2R)).
  report.begin("capstan by thickness", "A strip around a drum by half a turn, mu .4: thickness", {{"F2/F1 / exp(mu theta)", 1, 0.015}, {"F2/F1 / exp(mu theta / (1 + t/2R))", 1, 0.01}}, "");
  for (double thickness : {4e-3, 2e-3, 1e-3, .5e-3}) {
    capstan::Strip strip;
    strip.mu = .4;
    strip.degrees = 180;
    strip.cells = 80;
    strip.thickness = thickness;
    const capstan::Found found = capstan::brake(strip);
    const double thick = std::exp(strip.mu * M_PI / (1 + thickness / (2 * capstan::kRadius)));
    report.add({"thickness", words("t/R %g", thickness / capstan::kRadius), found.run, {found.ratio / capstan::exact(strip), found.ratio / thick}});
  }
  report.begin("capstan by layer", "A strip around a drum by half a turn, mu .4: layer", {{"F2/F1 / exp(mu theta)", 1, 0.015}}, "");
  for (double layer : {1e-5, 1e-6, 1e-7}) {
    capstan::Strip strip;
    strip.mu = .4;
    strip.degrees = 180;
    strip.cells = 80;
    strip.layer = layer;
    braked(report, "layer", words("h0 %g um", 1e6 * layer), strip, 0);
  }
}

}  // namespace forming_sim::bench
