// The package's own method: the mild law at the end of the step, swept over the
// pairs; a continuous check, and halving of the step where that finds a touch.
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

#include "contact/impl.h"
#include "forming_sim/contact/continuous.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/law.h"
#include "forming_sim/parallel/stage_clock.h"

namespace forming_sim {

namespace {
constexpr long kPairsOfAChunk = 300;  ///< whose sums are made in turn
constexpr double kTolerance = 1e-5;  ///< of h0: a pressure of 1e-5 E; the jitter that bodies at rest keep is of that size too
}  // namespace

// Do the features of a close pair touch on their way? moved: the square of the way of every node, m2.
bool Contact::Impl::touches(double dt, const ClosePair& close) const {
  int n[4], count = 4, split = 2;
  if (close.group >= 0) {
    const NearList::FacetEntry& e = list.facets[close.entry];
    n[0] = list.groups[close.group].node;
    for (int k = 0; k < features.corners(); ++k) n[1 + k] = e.node[k];
    count = 1 + features.corners();
    split = 1;
  } else {
    for (int k = 0; k < 4; ++k) n[k] = list.watched[close.entry].node[k];
  }
  double most[2] = {0, 0};
  for (int k = 0; k < count; ++k) most[k >= split] = std::max(most[k >= split], moved[n[k]]);
  if (std::sqrt(most[0]) + std::sqrt(most[1]) < 0.999 * close.distance) return false;
  Node x[4], d[4];
  for (int k = 0; k < count; ++k) {
    d[k] = dt * work.v[n[k]];
    x[k] = work.x[n[k]];
  }
  const double least = 1e-3 * std::min(close.distance, layer);
  return close.group >= 0 ? point_meets_facet(features.corners(), x, d, least) : edges_meet(x, d, least);
}

// The first close pair that touches on the way, -1: none.
int Contact::Impl::first_touch(double dt) {
  moved.resize(work.v.size());
  double farthest[2] = {0, 0};  // of nodes of bodies, of tools; squares
  for (size_t i = 0; i < moved.size(); ++i) {
    moved[i] = dt * dt * dot3(work.v[i], work.v[i]);
    double& most = farthest[static_cast<int>(i) >= work.body_entries];
    most = std::max(most, moved[i]);
  }
  const double far_apart = std::sqrt(farthest[0]) + std::sqrt(std::max(farthest[0], farthest[1]));  // no pair closes by more
  constexpr long kNone = std::numeric_limits<long>::max();
  std::atomic<long> found{kNone};
  team.share(static_cast<long>(near.close.size()), kPairsOfAThread, [&](long first, long last) {
    for (long c = first; c < last && c < found; ++c)
      if (0.999 * near.close[c].distance <= far_apart && touches(dt, near.close[c])) {
        for (long other = found; c < other && !found.compare_exchange_weak(other, c);) {}
        return;
      }
  });
  return found == kNone ? -1 : static_cast<int>(found);
}

// Has what others bear pushed a pair in that was set aside?
bool Contact::Impl::pushed_in(double dt) const {
  return std::any_of(near.aside.begin(), near.aside.end(), [&](const AsidePair& pair) { return pair.gap + dt * dot3(pair.normal, relative(pair, work.v)) <= pair.layer; });
}

std::string Contact::Impl::name_of_vertex(int v) const {
  std::ostringstream text;
  const int s = features.vertex_surface[v];
  if (v < features.body_nodes)
    text << "node " << v << " of body " << body_names[s];
  else
    text << "a vertex of tool " << tools.names[s - features.bodies];
  return text.str();
}
std::string Contact::Impl::name_of_entry(int entry) const {
  const Node& p = work.x[entry];
  std::ostringstream text;
  text << (work.vertex[entry] < 0 ? "the plane" : name_of_vertex(work.vertex[entry])) << " at (" << p[0] << ", " << p[1] << ", " << p[2] << ") m";
  return text.str();
}

std::string Contact::Impl::name_of_surface(int surface) const {
  const int tool = surface - features.bodies;
  return tool >= 0 ? "tool " + tools.names[tool] : "body " + body_names[surface];
}

void Contact::Impl::check_unmovable(double time) {
  for (const long i : near.unmovable) {
    sweeps.take_back(i, i + 1, near.pairs, near.rubs);
    const ContactPair& pair = near.pairs[i];
    if (pair.end_gap > 0) continue;
    int held = 0;  // of the nodes of bodies the one that counts most
    for (int k = 0; k < pair.nodes; ++k) {
      const auto counts = [&](int i) { return pair.node[i] < work.body_entries ? std::abs(pair.weight[i]) : 0; };
      if (counts(k) > counts(held)) held = k;
    }
    const int of = features.vertex_surface[work.vertex[pair.node[held]]], other = pair.own == of ? pair.surface : pair.own;
    std::ostringstream text;
    text << "at time " << time << " s " << name_of_surface(other) << " runs over " << name_of_entry(pair.node[held])
         << ", which is held or driven against it (gap " << pair.end_gap << " m at the end of the step): let it stop short of it, or free the node";
    throw Error(Code::contact_error, text.str());
  }
}

[[noreturn]] void Contact::Impl::give_up(double time, double dt, int touch) const {
  std::ostringstream text;
  text << "at time " << time << " s contact found no step without a crossing, down to " << dt << " s (after at most " << config.max_halvings << " halvings, of this step and of those before it)";
  if (touch >= 0) {
    const ClosePair& close = near.close[touch];
    const int a = close.group >= 0 ? list.groups[close.group].node : list.watched[close.entry].node[0];
    const int b = close.group >= 0 ? list.facets[close.entry].node[0] : list.watched[close.entry].node[2];
    text << ": " << (close.group >= 0 ? "" : "an edge from ") << name_of_entry(a) << " and a feature with " << name_of_entry(b) << ", " << close.distance << " m apart";
  } else {
    double worst = 1e300;
    const ContactPair* pair = nullptr;
    for (const ContactPair& p : near.pairs)
      if (p.end_gap < worst) {
        worst = p.end_gap;
        pair = &p;
      }
    if (pair) text << ": " << name_of_entry(pair->node[0]) << " against " << name_of_surface(pair->surface) << " ends at a gap of " << worst << " m";
  }
  text << ". The bodies may be squeezed harder than they can yield, or move too fast for the layer of " << layer
       << " m: check the tools' stroke, refine the mesh there, or set contact.layer larger";
  throw Error(Code::contact_error, text.str());
}

// A gap that positions cannot tell from none holds nothing.
void Contact::Impl::check_resolution(double time, double dt, double gap) const {
  if (gap > 1e-6 * layer) return;
  double farthest = 0;
  for (const Node& x : work.x) farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  if (gap < 4 * std::numeric_limits<double>::epsilon() * farthest) give_up(time, dt, -1);
}

// Chunk by chunk, shared by the threads, then joined in the order of the pairs: the sums do not depend on the threads.
void Contact::Impl::close_books() {
  const long count = static_cast<long>(near.pairs.size());
  chunks.resize((count + kPairsOfAChunk - 1) / kPairsOfAChunk);
  records.resize(count, !near.rubs.empty());
  team.share(static_cast<long>(chunks.size()), kPairsOfAThread / kPairsOfAChunk, [&](long first, long last) {
    for (long c = first; c < last; ++c) {
      Chunk& chunk = chunks[c];
      chunk.step.begin(tools.names.size());
      chunk.end = RelaxedPotential();
      chunk.start = chunk.thickest = 0;
      chunk.kept = 0;
      Books books = empty_books(chunk.step);
      const long begin = c * kPairsOfAChunk, end = std::min(count, begin + kPairsOfAChunk);
      sweeps.take_back(begin, end, near.pairs, near.rubs);
      for (long i = begin; i < end; ++i) {
        ContactPair& pair = near.pairs[i];
        books.add(pair);
        chunk.start += mild_potential(pair.gap, pair.layer, pair.stiffness);
        chunk.step.min_gap_over_layer = std::min(chunk.step.min_gap_over_layer, pair.end_gap / layer);
        const bool inside = relax_layer(layer, push_speed * step.dt, pair, chunk.end);
        if (!inside && pair.impulse == 0) continue;
        records.put(begin + chunk.kept++, pair, near.rubs, step.dt);
        chunk.thickest = std::max(chunk.thickest, pair.layer);
      }
      chunk.normal_work = books.normal_work();
    }
  });
  Books books = open_books();
  RelaxedPotential end;
  double start = 0;
  long kept = 0, from = 0;
  thickest = layer;
  for (const Chunk& chunk : chunks) {
    records.move(from, kept, chunk.kept);
    kept += chunk.kept;
    from += kPairsOfAChunk;
    books.add(chunk.step, chunk.normal_work);
    thickest = std::max(thickest, chunk.thickest);
    start += chunk.start;
    end.before += chunk.end.before;
    end.after += chunk.end.after;
    step.min_gap_over_layer = std::min(step.min_gap_over_layer, chunk.step.min_gap_over_layer);
  }
  records.resize(kept, !near.rubs.empty());
  step.soft_start_work = end.after - end.before;
  step.potential = end.after;
  // Potential that comes or goes with the change of features counts as dissipation, of either sign.
  step.dissipated = -books.normal_work() - (end.before - start) - (start - potential);
  potential = step.potential;
}

void Contact::Impl::advance_implicit(double time, double dt, double full_dt, NodeField& x, NodeField& v, NodeField& v_star, const Predict& predict, const Move& move, const ToolsAt& tools_at) {
  StageClock clock(times);
  bool all = false;  // let pairs that push askew act before they are in their layer
  tried.resize(0, false);
  for (;;) {
    tools_at(dt, motion);
    predict(dt, v_star);
    work.kick = previous_dt > 0 ? 0.5 * (previous_dt + dt) : dt;
    clock.begins();
    find_driven_tools();
    // How far a driven tool goes is known afterwards: what its force alone would do to a light one is far more than what it does while that lies on something.
    const double predicted = both * fastest(v_star) * dt, told_way = step_way(x, dt);
    const double first_way = farthest_tool(told_way, [&](const DrivenTool& tool) { return tool.way(tool.last_speed, dt); });
    double bound = 2 * (predicted + first_way);
    tools.place_planes(motion, planes);
    SweepResult swept;
    double way = 0;
    bool aside = true;  // pairs may be set aside
    // The sweeps may make a node or a driven tool faster than was predicted: then look farther.
    for (;;) {
      const double reach = std::max(thickest, std::min(ceiling, 0.1 * bound)) + bound;
      ensure_list(x, reach, bound);
      near.clear();
      clock.ends(&ContactTimes::list);
      double most = 0;
      if (list.size() > 0) {
        gather(x, v, v_star, dt);
        const Layers layers(records, tried, work, dt, previous_dt, layer, ceiling);
        narrow_phase(constants(), &layers, planes, all, {reach, bound, travel, thickest, aside ? dt : 0}, team, list, near);
        layers.hand_over(near.born, near.pairs);
        if (sticking->any()) sticking->leave_to_one_side(features, work, layer, near.pairs, near.rubs);
        if (waves.any()) delay.recall(work, near.pairs, near.rubs);
        if (!all) alike.join(work, near.pairs, near.rubs);
        if (shear_limit.any()) shear_limit.set(features, x, work.kick, work, near.pairs, near.rubs);
        clock.ends(&ContactTimes::narrow);
        swept = SweepResult();
        for (DrivenTool& tool : driven) gather_driven(tool);
        for (size_t i = 1; i < driven.size(); ++i)
          if (driven[i].tool == driven[i - 1].tool) DrivenTool::see_each_other(driven[i - 1], driven[i]);
        if (!near.pairs.empty() || !tie_pairs.empty())
          swept = sweeps.solve(dt, kTolerance * layer, config.max_sweeps, work, tie_pairs, near.pairs, near.rubs, driven, times);
        clock.begins();  // the sweeps have told theirs
        step.sweeps += swept.sweeps;
        if (pushed_in(dt)) {
          aside = false;
          continue;
        }
        for (int i = 0; i < work.body_entries; ++i) most = std::max(most, dot3(work.v[i], work.v[i]));
      }
      const double tool_way = farthest_tool(told_way, [&](const DrivenTool& tool) { return tool.way(tool.speed + tool.push, dt); });
      way = std::max(bound / 2, std::max(predicted, both * std::sqrt(most) * dt) + tool_way);
      if (way <= bound) break;
      bound = 1.5 * way;
    }
    check_unmovable(time + dt);
    const int touch = swept.open ? first_touch(dt) : -1;
    clock.ends(&ContactTimes::check);
    if (swept.open && touch < 0) {
      step.settled = swept.settled;
      for (const DrivenTool& tool : driven) step.tool_push[tool.tool][tool.freedom] = tool.push;
      moved_by(way);
      break;
    }
    const long count = static_cast<long>(near.pairs.size());
    sweeps.take_back(0, count, near.pairs, near.rubs);
    tried.resize(count, !near.rubs.empty());
    long pressed = 0;
    for (const ContactPair& pair : near.pairs)
      if (pair.impulse > 0) tried.put(pressed++, pair, near.rubs, dt);
    tried.resize(pressed, !near.rubs.empty());
    if (!all) {
      all = true;
      continue;
    }
    if (std::ldexp(dt, config.max_halvings) < full_dt * (1 + 1e-9)) give_up(time, dt, touch);
    dt /= 2;
    ++step.halvings;
  }
  step.dt = dt;

  end(dt, move, x, v, v_star);

  clock.begins();
  close_books();
  follow_steady_motion(dt, x, v_star, v);
  clock.ends(&ContactTimes::books);
  check_resolution(time, dt, step.min_gap_over_layer * layer);
}

}  // namespace forming_sim
