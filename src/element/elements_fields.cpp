// What is asked of the elements between the steps: sums, fields, their state.
#include <algorithm>

#include "element/group.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

void Elements::add_bytes(const Group& g, GroupPlan& plan) const {
  plan.memory_bytes += static_cast<double>((g.memory_storage.size() + g.constants_storage.size() + g.hourglass_storage.size() + g.viscosity_storage.size()) * sizeof(Lane));
  plan.state_bytes += static_cast<double>((g.memory_storage.size() / g.items * (g.items - 1) + g.hourglass_storage.size() + g.viscosity_storage.size()) * sizeof(Lane));  // V0 stays
  const double slots = static_cast<double>(g.tile_start.back() - g.tiles);  // of nodes
  plan.force_bytes += slots * record_size_ * sizeof(double);
  plan.index_bytes += (static_cast<double>(g.node_storage.size() + g.slot_storage.size()) + slots) * sizeof(int);
}

std::vector<GroupPlan> Elements::plan() const {
  std::vector<GroupPlan> groups;
  for (const Group& g : groups_) {
    if (g.at_edges) continue;
    GroupPlan plan;
    plan.body = g.body;
    plan.kind = static_cast<CellKind>(g.kind);
    plan.pressure = g.pressure;
    plan.layers = g.solid.layers;
    plan.cells = g.cells;
    plan.elements = static_cast<long>(g.cells) * g.cell_simplices;
    add_bytes(g, plan);
    if (g.nodal()) plan.pressure_bytes = (g.even() ? 2 : 1) * (plan.index_bytes + 2 * plan.force_bytes);  // once more over the simplices
    // Those of a body's points at edges count as those of its first cells that ask for them.
    const bool first = std::none_of(groups.begin(), groups.end(), [&](const GroupPlan& p) { return p.body == g.body && p.edge_points > 0; });
    if (g.nodal() && first)
      for (const Group& points : groups_)
        if (points.at_edges && points.body == g.body) {
          plan.edge_points += points.cells;
          add_bytes(points, plan);
        }
    groups.push_back(plan);
  }
  return groups;
}

long Elements::blocks() const {
  long sum = 0;
  for (const Group& g : groups_) sum += g.blocks;
  return sum;
}

long Elements::blocks_at_rest() const {
  long sum = 0;
  for (const Group& g : groups_)
    for (std::size_t t = 0; t < g.rest.size(); ++t)
      if (g.rest[t] == Group::passed_over) sum += g.last_block(static_cast<long>(t)) - g.first_block(static_cast<long>(t));
  return sum;
}

double Elements::plastic_work() const {
  double sum = 0;
  for (const Group& g : groups_)
    for (double w : g.plastic) sum += w;
  return sum;
}

double Elements::viscous_work() const {
  double sum = 0;
  for (const Group& g : groups_)
    for (double w : g.viscous) sum += w;
  return sum;
}

std::vector<double> Elements::plastic_strain() const {
  std::vector<double> p(simplices_.size()), at_edges(points_);
  for (const Group& g : groups_) {
    if (g.nodal()) continue;
    for (int cell = 0; cell < g.cells; ++cell)
      for (int s = 0; s < g.cell_simplices; ++s) {
        const Lane* memory = g.memory_storage.data() + (static_cast<std::size_t>(cell / kLanes) * g.cell_simplices + s) * g.items;
        const auto at = [&](int item) { return memory[item][cell % kLanes]; };
        const double strain = dimension_ == 2 ? plastic_strain_of<2>(g.solid, at) : plastic_strain_of<3>(g.solid, at);
        if (g.at_edges) at_edges[g.first_point + cell] = strain;
        for (int part = s; part < g.parts; part += g.cell_simplices) p[g.element(cell, part)] = strain;
      }
  }
  for (const Group& g : groups_) {
    if (!g.nodal()) continue;
    const std::vector<double> means = means_over_edges(g, at_edges, 1);
    for (std::size_t i = 0; i < means.size(); ++i) p[g.element(i)] = means[i];
  }
  return p;
}

void Elements::observe_blocks(const Group& g, long first_block, long last_block, const NodalView& view, double* stress, double* ratio, double* energy) const {
  const auto observe = g.at_edges ? kernels_.edge.observe : g.nodal() ? kernels_.nodal.observe : kernels_.observe;
  const long lanes = static_cast<long>(g.cell_simplices) * kLanes;
  CellGroup cells = g;
  set_step(cells.solid, view.last_dt);
  team_->share(last_block - first_block, blocks_of_a_thread(g), [&](long first, long last) {
    observe(cells, view, static_cast<int>(first_block + first), static_cast<int>(first_block + last), stress ? stress + first * lanes * 6 : nullptr,
            ratio ? ratio + first * lanes : nullptr, energy + first);
  });
}

double Elements::stored_energy(const NodeField& x, const NodeField* v, double since) const {
  return stored_energy({x.data()->data(), v ? v->data()->data() : nullptr, nullptr, pressure_.data(), 0, since}, nullptr);
}

double Elements::stored_energy_of(const BodyModel& body, const NodeField& x) const {
  return stored_energy({x.data()->data(), nullptr, nullptr, pressure_.data(), 0, 0}, &body);
}

double Elements::stored_energy(const NodalView& view, const BodyModel* of) const {
  observe_pressure(view);
  double sum = 0;
  for (const Group& g : groups_) {
    if (of && g.body != of->name) continue;
    std::vector<double> energy(g.blocks);
    observe_blocks(g, 0, g.blocks, view, nullptr, nullptr, energy.data());
    for (double e : energy) sum += e;
  }
  const std::size_t first = of ? of->first_node : 0, end = of ? first + of->node_count : pressure_.size();
  for (std::size_t n = first; n < std::min(end, pressure_.size()); ++n)  // the volumetric energy of nodal pressures belongs to the nodes
    sum += 0.5 * nodal_volume0_[n] * pressure_[n] * growth_[n];
  return sum;
}

ElementFields Elements::observe(const NodeField& x, double since) const {
  const NodalView view{x.data()->data(), nullptr, nullptr, pressure_.data(), 0, since};
  observe_pressure(view);
  ElementFields fields;
  fields.stress.resize(simplices_.size());
  fields.volume_ratio.resize(simplices_.size());
  std::vector<double> S(static_cast<std::size_t>(points_) * 6);  // of points at edges
  for (const Group& g : groups_) {
    const std::size_t simplices = static_cast<std::size_t>(g.blocks) * g.cell_simplices;
    std::vector<Lane> stress(simplices * 6), ratio(simplices);
    std::vector<double> energy(g.blocks);
    observe_blocks(g, 0, g.blocks, view, stress.data()->value, ratio.data()->value, energy.data());
    for (int cell = 0; cell < g.cells; ++cell) {
      const int l = cell % kLanes;
      const std::size_t block = static_cast<std::size_t>(cell / kLanes) * g.cell_simplices;
      if (g.at_edges)
        for (int i = 0; i < 6; ++i) S[static_cast<std::size_t>(g.first_point + cell) * 6 + i] = stress[block * 6 + i][l];
      for (int s = 0; s < g.parts; ++s) {
        const std::size_t at = block + s % g.cell_simplices;
        const int element = g.element(cell, s);
        for (int i = 0; i < 6; ++i) fields.stress[element][i] = stress[at * 6 + i][l];
        fields.volume_ratio[element] = ratio[at][l];
      }
    }
  }
  for (const Group& g : groups_) {
    if (!g.nodal()) continue;
    const std::vector<double> means = means_over_edges(g, S, 6);
    for (std::size_t i = 0; i < means.size() / 6; ++i)
      for (int c = 0; c < 6; ++c) fields.stress[g.element(i)][c] += means[i * 6 + c];
  }
  return fields;
}

std::vector<Sym> Elements::stress_of(const std::vector<int>& elements, const NodeField& x, double since) const {
  std::vector<Sym> stress(elements.size());
  if (elements.empty()) return stress;
  // With pressures in the nodes an element has a share in those of its neighbours; and where an element in a block is asked for, all are found.
  if (any_nodal_ || elements.size() * kLanes >= simplices_.size()) {
    const std::vector<Sym> all = observe(x, since).stress;
    std::transform(elements.begin(), elements.end(), stress.begin(), [&](int e) { return all[e]; });
    return stress;
  }
  const NodalView view{x.data()->data(), nullptr, nullptr, nullptr, 0, since};
  std::vector<Lane> S, ratio;
  const Group* group = nullptr;
  int block = -1;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Location where = locate(elements[i]);
    const Group& g = groups_[where.group];
    if (&g != group || where.cell / kLanes != block) {
      group = &g, block = where.cell / kLanes;
      S.resize(static_cast<std::size_t>(g.cell_simplices) * 6), ratio.resize(g.cell_simplices);
      double energy;
      observe_blocks(g, block, block + 1, view, S.data()->value, ratio.data()->value, &energy);
    }
    for (int c = 0; c < 6; ++c) stress[i][c] = S[where.simplex % g.cell_simplices * 6 + c][where.cell % kLanes];
  }
  return stress;
}

void Elements::append_state(std::vector<double>& to) const {
  for (const Group& g : groups_) {
    for (const LargeArray<Lane>* storage : {&g.memory_storage, &g.hourglass_storage, &g.viscosity_storage, &g.weight_ratio}) {
      const double* memory = reinterpret_cast<const double*>(storage->data());
      to.insert(to.end(), memory, memory + storage->size() * kLanes);
    }
    to.insert(to.end(), g.plastic.begin(), g.plastic.end());
    to.insert(to.end(), g.viscous.begin(), g.viscous.end());
  }
}

const double* Elements::read_state(const double* from) {
  stillness_.forget();
  const auto take = [&](double* to, std::size_t count) {
    std::copy(from, from + count, to);
    from += count;
  };
  for (Group& g : groups_) {
    const LargeArray<Lane> ratios = g.weight_ratio;
    for (LargeArray<Lane>* storage : {&g.memory_storage, &g.hourglass_storage, &g.viscosity_storage, &g.weight_ratio})
      take(reinterpret_cast<double*>(storage->data()), storage->size() * kLanes);
    take(g.plastic.data(), g.plastic.size());
    take(g.viscous.data(), g.viscous.size());
    g.set_changed_weights(ratios);
  }
  return from;
}

}  // namespace forming_sim
