// Error of a bent sheet against cells, element family and wall time.
#include "rows.h"
#include "support/column.h"

namespace forming_sim::bench {

std::vector<Row> bending(const Request&) {
  struct Family {
    const char* name;
    int dimension;
    const char* pattern;
    const char* average;
  };
  const Family families[] = {{"crossed triangles, p per cell", 2, "fine", "cell"},
                             {"2 triangles a cell, p per cell", 2, "coarse", "cell"},
                             {"2 triangles a cell, p per node", 2, "coarse", "node"},
                             {"one-point quadrilaterals", 2, "one_point", "cell"},
                             {"24 tetrahedra, p per cell", 3, "fine", "cell"},
                             {"6 tetrahedra, p per cell", 3, "coarse", "cell"},
                             {"6 tetrahedra, p per node", 3, "coarse", "node"},
                             {"one-point hexahedra", 3, "one_point", "cell"}};
  const ExactBend& exact = kVoceBends[1];
  std::vector<Row> rows;
  for (const Family& family : families)
    for (double aspect : {1., 4., 8.}) {
      if (aspect > 4 && std::string(family.pattern) != "one_point") continue;
      for (int cells : {2, 4, 8}) {
        const Clock clock;
        const Bend b = bend(family.dimension, exact.kt, cells, aspect, aluminium(true), family.pattern, family.average);
        const double time = clock.seconds();
        const std::string name = std::string(family.name) + ", " + std::to_string(cells) + (aspect > 1 ? ", " + std::to_string(int(aspect)) + " times longer" : "");
        rows.push_back(near(name, "moment, N", b.moment, exact.moment, aspect > 1 ? 0.03 : 0.01, time));
        rows.push_back(near(name, "k_after/k", b.after, exact.after, 0.001, time));
      }
    }
  return rows;
}

}  // namespace forming_sim::bench
