#include "forming_sim/mesh/trim.h"

#include "forming_sim/config/fault.h"
#include "forming_sim/config/reflect.h"
#include "forming_sim/config/words.h"
#include "forming_sim/mesh/measure.h"
#include "mesh/region.h"

namespace forming_sim {

namespace {

/// Empty where the region is none: that is then among the faults.
std::function<double(const Vec3&)> distance_of(const TrimConfig& region, bool flat, const std::string& name, std::vector<Fault>& faults) {
  try {
    return distance_from(region, flat, "");
  } catch (const Error& error) {
    faults.push_back({error.code(), name, given_text(region.choose), error.what()});
    return {};
  }
}

}  // namespace

Remainder find_remainder(const Mesh& mesh, const std::vector<TrimConfig>& regions) {
  struct Cut {
    std::function<bool(const Vec3&)> takes;
    std::string name, choose;
    bool any = false;
  };
  std::vector<Cut> cuts;
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const TrimConfig& region = regions[i];
    const std::string name = join_path("trim", i);
    const auto distance = distance_of(region, mesh.dimension == 2, name, faults);
    if (!distance) continue;
    const bool positive = region.choose == "plane" || region.outside;
    cuts.push_back({[=](const Vec3& x) { return positive ? distance(x) > 0 : distance(x) < 0; }, name, region.choose});
  }
  Remainder left;
  left.node.assign(mesh.nodes.size(), -1);
  std::size_t stay = 0;
  for (const Cells& block : mesh.cells) {
    const int size = shape_of(block.kind).nodes;
    left.cells.emplace_back();
    for (int cell = 0; cell < block.count(); ++cell) {
      const int* nodes = &block.nodes[static_cast<std::size_t>(cell) * size];
      Vec3 middle = Vec3::Zero();
      for (int a = 0; a < size; ++a) middle += mesh.nodes[nodes[a]] / size;
      bool gone = false;
      for (Cut& cut : cuts)
        if (cut.takes(middle)) gone = cut.any = true;
      if (gone) continue;
      left.cells.back().push_back(cell);
      ++stay;
      for (int a = 0; a < size; ++a) left.node[nodes[a]] = 0;
    }
  }
  const auto box = bounds(mesh);
  const std::string extent = "the body extends from " + place(box.min()) + " to " + place(box.max());
  for (const Cut& cut : cuts)
    if (!cut.any) faults.push_back({Code::mesh_error, cut.name, given_text(cut.choose), "no cell lies there: " + extent + ", and a cell is cut away where its middle lies in the region; give another place, or leave it out"});
  if (!faults.empty()) throw SceneError(faults);
  if (stay == 0) throw Error(Code::mesh_error, "nothing is left: " + extent + ", and all its cells are cut away; turn a normal round, or cut less");
  int next = 0;
  for (int& n : left.node)
    if (n == 0) n = next++;
  return left;
}

Mesh remaining(const Mesh& mesh, const Remainder& left) {
  Mesh rest;
  rest.dimension = mesh.dimension;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (left.node[n] >= 0) rest.nodes.push_back(mesh.nodes[n]);
  for (std::size_t b = 0; b < mesh.cells.size(); ++b) {
    const Cells& block = mesh.cells[b];
    const int size = shape_of(block.kind).nodes;
    Cells cells{block.kind, {}};
    for (int cell : left.cells[b])
      for (int a = 0; a < size; ++a) cells.nodes.push_back(left.node[block.nodes[static_cast<std::size_t>(cell) * size + a]]);
    rest.cells.push_back(std::move(cells));
  }
  for (const auto& [name, nodes] : mesh.sets) {
    std::vector<int> kept;
    for (int n : nodes)
      if (left.node[n] >= 0) kept.push_back(left.node[n]);
    if (!kept.empty()) rest.sets[name] = std::move(kept);
  }
  find_surface(rest);
  return rest;
}

}  // namespace forming_sim
