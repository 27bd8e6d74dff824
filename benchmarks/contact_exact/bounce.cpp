// A rigid mass falls on a mild layer: the law itself, and how the end of the step dissipates. By both methods that have
// the layer, and the time step in parts of h0/v.
#include "support/bounce.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {

void bounce_problem(Report& report) {
  for (const bounce::Exact& exact : bounce::kExact) {
    report.begin(words("bounce phi %g", exact.phi), words("A mass bounces on a mild layer, phi = %g", exact.phi),
                 {{"least gap / h0", exact.least, 0.01}, {"contact time, h0/v", exact.duration, 0.01}, {"rebound", 1, 0.01}}, "steps per h0/v");
    for (const char* method : {"implicit", "explicit"})
      for (int dimension : {2, 3})
        for (double steps : {1e2, 1e3, 1e4}) {
          if (dimension == 3 && steps > 1e3) continue;
          const bounce::Found found = bounce::fall(method, dimension, exact.phi, 1 / steps);
          report.add({words("%s, %dD", method, dimension), words("%g steps", steps), found.run, {found.least, found.duration, found.rebound}, "", steps});
        }
  }
}

}  // namespace forming_sim::bench
