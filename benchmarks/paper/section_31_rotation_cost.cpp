// Section 3.1: without the rotation of stresses a step does not cost more.
//
// Forces of a body whose nodes move to and fro, the laws in alternating turns on the
// same bodies; a turn of one law is compared with the turns of the others beside it.
#include <algorithm>

#include "paper/figures.h"
#include "support/bodies.h"
#include "timed_body.h"

namespace forming_sim::bench {
std::vector<Row> rotation_cost(const Request&) {
  struct Family {
    CellKind kind;
    int cells;  ///< along each side: about 4000 elements, which a cache holds
    const char* name;
  };
  const Family families[] = {{CellKind::crossed, 32, "crossed"}, {CellKind::hex6, 9, "hex6"}, {CellKind::hex24, 5, "hex24"}};
  const std::vector<std::string> laws{"classical", "paper", "green_elastic"};
  std::vector<Row> rows;
  for (const Family& family : families)
    for (const bool plastic : {false, true}) {
      const Clock clock;
      std::vector<TimedBody> bodies;
      for (const std::string& law : laws) {
        MaterialConfig material = aluminium(plastic);
        material.law = law;
        bodies.emplace_back(family.kind, family.cells, material, plastic ? 0.02 : 0.001);
      }
      const std::vector<std::vector<double>> ns = alternate(bodies, 60);
      const std::string name = std::string(family.name) + (plastic ? ", plastic" : ", elastic");
      for (std::size_t k = 0; k < laws.size(); ++k)
        rows.push_back(just("section 3.1", name + ", " + laws[k] + ": ns", median(ns[k]), clock.seconds()));
      for (std::size_t k = 1; k < laws.size(); ++k) {
        rows.push_back(at_most("section 3.1", name + ": " + laws[k] + " / classical", median_ratio(ns[k], ns[0]), 1, clock.seconds()));
        if (!rows.back().holds && laws[k] == "green_elastic") rows.back().note = "it takes J^(-5/3), which the printed law does without";
      }
      for (std::size_t k = 0; k < laws.size(); ++k)
        if (plastic != (bodies[k].plastic_work() > 0)) rows.back().note = "the bodies did not yield as they should: not a measurement";
    }
  rows.front().note =
      "medians over 60 turns, also of the ratios; ~4000 elements, 1 thread. The classical law is a function of its own, called from a kernel that "
      "tells laws apart at run time (a few percent), and gathers velocities and edges once more for (2.11); the new one is compiled into its kernel. Whole steps are compared: what the rotation alone takes is not timed";
  return rows;
}

}  // namespace forming_sim::bench
