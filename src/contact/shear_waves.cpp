#include "forming_sim/contact/shear_waves.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "forming_sim/config/fault.h"

namespace forming_sim {

namespace {
constexpr double kOver = 1e-6;  ///< phi of a vertex whose contact is over
constexpr std::size_t kSaved = 8;  ///< numbers of a vertex
constexpr std::size_t kSavedPresses = 7;  ///< of a body
constexpr std::size_t kHolds = 64; ///< vertices on tools that are asked

/// Those of a body, from the first to behind the last.
using Vertices = std::pair<const RubbedNode*, const RubbedNode*>;
Vertices of_body(const WaveBody& body, const std::vector<RubbedNode>& pressed) {
  const auto before = [](const RubbedNode& r, int n) { return r.node < n; };
  const RubbedNode *first = pressed.data(), *end = first + pressed.size();
  first = std::lower_bound(first, end, body.first_node, before);
  return {first, std::lower_bound(first, end, body.first_node + body.nodes, before)};
}

static_assert(std::is_trivially_copyable_v<MassSums>);
constexpr std::size_t kSavedMasses = 1 + sizeof(MassSums) / sizeof(double);  ///< of a body
}  // namespace

ShearWaves::ShearWaves(const std::vector<WaveBody>& bodies, std::size_t nodes, int modes) : bodies_(bodies), place_(nodes, -1) {
  for (const WaveBody& body : bodies) moving_.emplace_back(body.first_node, body.nodes, modes);
  last_masses_.resize(bodies.size());
  presses_.resize(bodies.size());
}

const WaveBody& ShearWaves::of_pair(int first, int second) const {
  const int bodies = static_cast<int>(bodies_.size());
  if (first >= bodies) return bodies_[second];
  if (second >= bodies) return bodies_[first];
  return bodies_[bodies_[second].impedance < bodies_[first].impedance ? second : first];
}

int ShearWaves::body_of(int n) const {
  int b = 0;
  while (n >= bodies_[b].first_node + bodies_[b].nodes) ++b;
  return b;
}

void ShearWaves::hold(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held) {
  for (std::size_t b = 0; b < moving_.size(); ++b)
    if (moving_[b].hold(inverse_mass, held)) last_masses_[b].known = false;
}

void ShearWaves::find_asked(const WaveBody& body, const std::vector<RubbedNode>& pressed) {
  asked_.clear();
  const auto [first, end] = of_body(body, pressed);
  for (const RubbedNode* r = first; r != end; ++r)
    if (r->by_tools.squaredNorm() > 0) asked_.push_back(r);
  const std::size_t stride = asked_.size() / kHolds + 1;
  for (std::size_t i = 0; i * stride < asked_.size(); ++i) asked_[i] = asked_[i * stride];
  asked_.resize((asked_.size() + stride - 1) / stride);
}

void ShearWaves::know_places() {
  for (std::size_t i = 0; i < rubs_.size(); ++i) place_[rubs_[i].node] = static_cast<int>(i);
}

void ShearWaves::Presses::add(double part, const Node& step_normal, double step_size, const Node& step_momentum) {
  normal = (1 - part) * normal + step_normal;
  momentum = (1 - part) * momentum + step_momentum;
  size = (1 - part) * size + step_size;
}

double ShearWaves::Presses::w() const {
  const double across = normal.norm();
  if (across == 0) return 1;
  const double s = std::min(across, std::max(0.0, momentum.dot(normal) / across)) / size;
  return std::clamp(2 * (1 - s), 0.0, 1.0);
}

void ShearWaves::follow(Team& team, double dt, double last_dt, const NodeField& x, const NodeField& before, const NodeField& after, const std::vector<RubbedNode>& pressed) {
  // A velocity belongs to the middle of its step.
  const auto place_after = [&](int n) -> Node { return x[n] - 0.5 * dt * after[n]; };
  const auto place_before = [&](int n) -> Node { return x[n] - dt * after[n] - 0.5 * last_dt * before[n]; };
  constexpr int kNone = std::numeric_limits<int>::max();
  int of = -1;  // the body whose motion is known
  ChangeOfMotion whole;
  double part = 0, w = 0;  // of what is steady, that the step changes; of phi
  next_.clear();
  masses_.assign(moving_.size(), LastMasses());
  for (const Rubbing& r : rubs_) place_[r.node] = -1;
  std::size_t i = 0, p = 0;
  for (;;) {
    const int n = std::min(i < rubs_.size() ? rubs_[i].node : kNone, p < pressed.size() ? pressed[p].node : kNone);
    if (n == kNone) break;
    const RubbedNode* rubbed = p < pressed.size() && pressed[p].node == n ? &pressed[p++] : nullptr;
    Rubbing r = i < rubs_.size() && rubs_[i].node == n ? rubs_[i++] : Rubbing{n, before[n], Node::Zero()};
    const int b = body_of(n);
    const WaveBody& body = bodies_[b];
    if (body.impedance == 0) continue;
    if (of != b) {
      find_asked(body, pressed);
      held_before_.clear();
      held_after_.clear();
      for (const RubbedNode* h : asked_) {
        const double size = h->by_tools.norm();
        const Node along = h->by_tools / size;
        held_before_.push_back({place_before(h->node), along, h->told_before / size});
        held_after_.push_back({place_after(h->node), along, h->told / size});
      }
      if (!last_masses_[b].known) {
        NodeField x_before(x.size());
        for (int k = body.first_node; k < body.first_node + body.nodes; ++k) x_before[k] = place_before(k);
        last_masses_[b].sums = moving_[b].masses(team, x_before, before, 0);
      }
      masses_[b] = {true, moving_[b].masses(team, x, after, 0.5 * dt)};
      whole = ChangeOfMotion(moving_[b].motion(last_masses_[b].sums, before, place_before, held_before_), moving_[b].motion(masses_[b].sums, after, place_after, held_after_));
      part = dt / (body.time + dt);
      Node normal = Node::Zero(), momentum = Node::Zero();
      double size = 0;
      const auto [first, end] = of_body(body, pressed);
      for (const RubbedNode* press = first; press != end; ++press) {
        normal += press->normal;
        size += press->normal.norm();
      }
      for (int c = 0; c < 3; ++c) momentum[c] = masses_[b].sums.momentum[c] - last_masses_[b].sums.momentum[c];
      presses_[b].add(part, normal, size, momentum);
      w = presses_[b].w();
      of = b;
    }
    const double was_phi = r.v[3], phi = was_phi + part * ((rubbed ? w : 0) - was_phi);
    r.change = whole.at(place_before(n), place_after(n));
    r.change[3] = 0;
    r.v += r.change;
    const Node beside = after[n] - r.v;
    r.v += (1 - was_phi) * part * beside;
    if (rubbed) {
      const double across = rubbed->normal.squaredNorm();
      if (across > 0) r.v += was_phi * part * rubbed->normal.dot(beside) / across * rubbed->normal;
      if (rubbed->area > 0) r.v -= 1 / (body.impedance * rubbed->area * body.time) * rubbed->radiated;
    }
    r.v[3] = phi;
    if (rubbed || phi > kOver) next_.push_back(r);
  }
  rubs_.swap(next_);
  for (std::size_t b = 0; b < presses_.size(); ++b)
    if (!masses_[b].known) presses_[b] = Presses();
  last_masses_.swap(masses_);
  know_places();
}

std::vector<double> ShearWaves::save() const {
  std::vector<double> saved;
  for (const Presses& p : presses_) saved.insert(saved.end(), {p.normal[0], p.normal[1], p.normal[2], p.momentum[0], p.momentum[1], p.momentum[2], p.size});
  for (const LastMasses& last : last_masses_) {
    saved.push_back(last.known);
    saved.resize(saved.size() + kSavedMasses - 1);
    std::memcpy(&saved.back() - (kSavedMasses - 2), &last.sums, sizeof last.sums);
  }
  for (const Rubbing& r : rubs_) saved.insert(saved.end(), {static_cast<double>(r.node), r.v[0], r.v[1], r.v[2], r.v[3], r.change[0], r.change[1], r.change[2]});
  return saved;
}

void ShearWaves::restore(const std::vector<double>& saved) {
  for (const Rubbing& r : rubs_) place_[r.node] = -1;
  rubs_.clear();
  std::size_t i = 0;
  for (Presses& p : presses_) {
    if (i + kSavedPresses > saved.size()) break;
    const double* s = &saved[i];
    p = {Node(s[0], s[1], s[2], 0), Node(s[3], s[4], s[5], 0), s[6]};
    i += kSavedPresses;
  }
  for (LastMasses& last : last_masses_) {
    if (i + kSavedMasses > saved.size()) break;
    last.known = saved[i] != 0;
    std::memcpy(static_cast<void*>(&last.sums), &saved[i + 1], sizeof last.sums);
    i += kSavedMasses;
  }
  for (; i + kSaved <= saved.size(); i += kSaved) {
    const double* s = &saved[i];
    if (!(s[0] >= 0 && s[0] < static_cast<double>(place_.size()))) throw Error(Code::resume_error, "the checkpoint tells of node " + std::to_string(s[0]) + " that rubs, of " + std::to_string(place_.size()));
    rubs_.push_back({static_cast<int>(s[0]), Node(s[1], s[2], s[3], s[4]), Node(s[5], s[6], s[7], 0)});
  }
  know_places();
}

}  // namespace forming_sim
