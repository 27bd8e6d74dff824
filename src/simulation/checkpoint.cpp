// Every number that the next steps depend on, to bytes and back.
#include <cstdint>
#include <functional>
#include <sstream>
#include <string_view>

#include "config/archive.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {
/// Counts up with every change of what is saved or of its order, down to the order of an element's corners.
constexpr std::uint64_t kLayout = 0x6d726f660000001eu;

template <class T> std::size_t mark_of(const T* values, std::size_t count) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(values), count * sizeof(T)});
}

/// A number of each body's mesh and each tool's surface, which come from files that may have changed.
std::vector<std::size_t> marks_of(const Model& model, const NodeField& X) {
  std::vector<std::size_t> marks;
  for (const BodyModel& body : model.bodies) {
    std::vector<int> numbers;
    for (const std::array<int, 4>& corners : body.mesh.simplices()) numbers.insert(numbers.end(), corners.begin(), corners.end());
    for (const auto& [name, nodes] : body.mesh.sets) {
      numbers.push_back(static_cast<int>(name.size()));
      numbers.insert(numbers.end(), name.begin(), name.end());
      numbers.push_back(static_cast<int>(nodes.size()));
      numbers.insert(numbers.end(), nodes.begin(), nodes.end());
    }
    marks.push_back(mark_of(X.data() + body.first_node, static_cast<std::size_t>(body.node_count)) ^ mark_of(numbers.data(), numbers.size()) ^ (body.formed ? mark_of(body.reference().data(), body.reference().size()) : 0));
  }
  for (const ToolModel& tool : model.tools) {
    std::vector<int> corners;
    for (const Facet& facet : tool.mesh.surface) corners.insert(corners.end(), facet.nodes.begin(), facet.nodes.end());
    marks.push_back(mark_of(tool.mesh.nodes.data(), tool.mesh.nodes.size()) ^ mark_of(corners.data(), corners.size()));
  }
  return marks;
}

/// Of the first body or tool that is not the checkpoint's.
std::string changed_part(const Model& model, const std::vector<std::size_t>& now, const std::vector<std::size_t>& then) {
  for (std::size_t k = 0; k < now.size(); ++k)
    if (now[k] != then.at(k)) return k < model.bodies.size() ? "the mesh of body " + model.bodies[k].name : "the surface of tool " + model.tools[k - model.bodies.size()].name;
  return "";
}
}  // namespace

template <class Archive> void Simulation::Impl::exchange(Archive& a) {
  a.numbers(x.data()->data(), x.size() * 4);
  a.numbers(v.data()->data(), v.size() * 4);
  for (double* value : {&time, &dt, &previous_dt, &previous_kick, &work, &damping, &settled_away, &friction, &contact_dissipated, &contact_potential,
                        &initial, &most, &min_gap, &explicit_stable_dt, &first_dt, &first_element_dt, &farthest, &smallest.dt, &next_crossing_check, &wall, &observed})
    a.number(*value);
  for (long* value : {&steps, &halvings, &sweeps, &swept_steps, &unsettled_steps, &active_pairs, &crossings, &longer_steps, &resting}) a.number(*value);
  control.exchange(a);
  steady.exchange(a);
  if (plan.time_step.limit == "global") global.exchange(a, static_cast<std::size_t>(elements.blocks()) * kLanes);
  if (!by_cells()) departure.exchange(a, x.size());
  a.number(smallest.element);
  a.number(smallest.node);
  a.text(smallest.reason);
  if (damage.any()) damage.exchange(a);
  settle.exchange(a);
  a.text(unsettled);
  ways.exchange(a, x.size());
  tool_ways.exchange(a, 2 * tools.size());
  a.number(rests);
  a.number(takes_hold);
  a.number(pressed);
  std::size_t told = warnings.size() - told_at_start;
  a.number(told);
  warnings.resize(told_at_start + told);
  for (std::size_t k = told_at_start; k < warnings.size(); ++k) a.text(warnings[k]);
  a.number(ledger_told);
  a.number(overstepped);
  a.number(fall_told);
  supports.exchange(a);
  fading.exchange(a);
  a.numbers(contact_force.data(), contact_force.size());
  const auto exchange_reaction = [&](Reaction& reaction) {
    a.numbers(reaction.impulse.data(), 3);
    a.numbers(reaction.angular.data(), 3);
    a.number(reaction.radial);
  };
  for (Reaction& reaction : reactions) exchange_reaction(reaction);
  for (ToolStatus& tool : tools) {
    for (Vec3* value : {&tool.way, &tool.force, &tool.moment, &tool.peak_force, &tool.peak_moment}) a.numbers(value->data(), 3);
    a.number(tool.radial_force);
    a.number(tool.peak_radial_force);
    a.number(tool.most_against);
    exchange_reaction(tool.felt);
    a.number(tool.touched);
    a.number(tool.landings);
    a.number(tool.first_landing);
    a.number(tool.pressed);
  }
}

std::vector<char> Simulation::save() const {
  Impl& s = *impl_;
  Writer out;
  out.number(kLayout);
  out.number(s.elements.simplices().size());
  out.number(s.x.size());
  out.number(s.tools.size());
  out.list(marks_of(s.model, s.X));
  out.list(s.stages.starts());
  out.list(s.stages.stops());
  s.stages.exchange_drives(out);
  s.exchange(out);
  std::vector<double> memory;
  s.elements.append_state(memory);
  out.list(memory);
  out.list(s.contact ? s.contact->save() : std::vector<char>());
  return out.take();
}

void Simulation::restore(const std::vector<char>& data) {
  Impl& s = *impl_;
  Reader in(data);
  std::uint64_t layout = 0;
  in.number(layout);
  if (layout != kLayout) throw Error(Code::resume_error, "the checkpoint was written by another build of this version, which keeps other things; resume with the build that wrote it");
  std::size_t simplices = 0, nodes = 0, tools = 0;
  in.number(simplices);
  in.number(nodes);
  in.number(tools);
  if (simplices != s.elements.simplices().size() || nodes != s.x.size() || tools != s.tools.size()) {
    std::ostringstream what;
    what << "the checkpoint holds " << simplices << " elements, " << nodes << " nodes and " << tools
         << " tools, the scene " << s.elements.simplices().size() << ", " << s.x.size() << " and " << s.tools.size()
         << "; resume with the scene that wrote it";
    throw Error(Code::resume_error, what.str());
  }
  std::vector<std::size_t> marks;
  in.list(marks);
  if (const std::string part = changed_part(s.model, marks_of(s.model, s.X), marks); !part.empty())
    throw Error(Code::resume_error, part + " has changed since the checkpoint was written: its file is another; resume with the file of then, or run the scene from its start");
  std::vector<double> starts, stops, memory;
  in.list(starts);
  in.list(stops);
  s.stages = StageRunner(s.plan.stages, s.model);
  s.stages.exchange_drives(in);
  s.stages.replay(starts, stops);
  s.change_boundaries();
  s.begin_loads();
  s.exchange(in);
  s.choose_booked();
  in.list(memory);
  std::vector<double> expected;
  s.elements.append_state(expected);
  if (memory.size() != expected.size())
    throw Error(Code::resume_error, "the checkpoint's element memory has another size than the scene's; resume with the scene that wrote it");
  s.elements.read_state(memory.data());
  std::vector<char> contact;
  in.list(contact);
  if (s.contact) s.contact->restore(contact);
  s.energies_step = s.damage_step = -1;
  s.place_tools();
}

}  // namespace forming_sim
