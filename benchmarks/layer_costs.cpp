// What each further layer of plasticity costs, in parts of the first.
#include "layer_costs.h"

#include "timed_body.h"

namespace forming_sim::bench {

void layer_costs(std::vector<Row>& rows) {
  struct Family {
    CellKind kind;
    int cells;  ///< along each side: about 4000 elements, which a cache holds
    const char* name;
  };
  const Family families[] = {{CellKind::crossed, 32, "crossed"}, {CellKind::hex6, 9, "hex6"}, {CellKind::hex24, 5, "hex24"}};
  const std::vector<int> counts{1, 2, 3, 5, 10};
  for (const Family& family : families) {
    const Clock clock;
    std::vector<TimedBody> bodies;
    for (int count : counts) {
      MaterialConfig material = aluminium();
      for (int k = 0; k < count; ++k) {
        LayerConfig layer;
        layer.weight = 1.0 / count;
        layer.hardening.emplace();
        layer.hardening->curve = "perfect";
        layer.hardening->yield_stress = 150e6 + 50e6 * k;  // all of them yield
        material.layers.push_back(layer);
      }
      bodies.emplace_back(family.kind, family.cells, material, 0.02);
    }
    const std::vector<std::vector<double>> ns = alternate(bodies, 30);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const std::string name = std::string(family.name) + ", " + std::to_string(counts[i]) + (counts[i] == 1 ? " layer" : " layers");
      rows.push_back(just(name, "forces, ns an element", *std::min_element(ns[i].begin(), ns[i].end()), clock.seconds()));
      if (i > 0)
        rows.push_back(at_most(name, "each further layer over one", (median_ratio(ns[i], ns[0]) - 1) / (counts[i] - 1), 0.5, clock.seconds()));
    }
  }
}

}  // namespace forming_sim::bench
