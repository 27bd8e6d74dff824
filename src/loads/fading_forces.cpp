#include "forming_sim/loads/fading_forces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace forming_sim {

namespace {
/// v turned by the least rotation that takes n to m.
Vec3 turned(const Vec3& v, const Vec3& n, const Vec3& m) {
  const Vec3 s = n.cross(m), sv = s.cross(v);
  return v + sv + s.cross(sv) / std::max(1 + n.dot(m), 1e-3);
}
}  // namespace

void FadingForces::begin(double start, double duration, double may_do, const OfBody& body, std::vector<HoldingForce> forces, const std::vector<Face>& surface, const NodeField& x) {
  Set set;
  set.start = start;
  set.duration = duration;
  set.may_do = may_do;
  set.body = body;
  std::map<int, int> turning;  // of nodes
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (forces[i].on_surface) turning[forces[i].node] = static_cast<int>(i);
  for (const Face& face : surface) {
    const std::size_t before = set.corners.size();
    for (int k = 0; k < face.corners; ++k)
      if (const auto of = turning.find(face.nodes[k]); of != turning.end()) set.corners.push_back({static_cast<int>(set.faces.size()), k, of->second});
    if (set.corners.size() > before) set.faces.push_back(face);
  }
  set.forces = std::move(forces);
  set.normals = set.normals_at(x);
  sets_.push_back(std::move(set));
}

std::vector<Node> FadingForces::Set::normals_at(const NodeField& x) const {
  std::vector<Node> normals(forces.size(), Node::Zero());
  for (const Corner& c : corners) normals[c.force] += node(area_share(faces[c.face], c.k, x, false));
  for (Node& n : normals)
    if (!n.isZero(0)) n /= n.norm();
  return normals;
}

void FadingForces::add(double t, const NodeField& x, const std::vector<double>& mass, NodeField& f) {
  for (Set& set : sets_) {
    const double u = std::clamp((t - set.start) / set.duration, 0.0, 1.0), left = 1 - u * u * u * (10 - u * (15 - 6 * u));
    const std::vector<Node> normals = set.normals_at(x);
    set.added.resize(set.forces.size());
    Node more = Node::Zero();
    for (std::size_t i = 0; i < set.forces.size(); ++i) {
      set.added[i] = left * node(turned(vec3(set.forces[i].force), vec3(set.normals[i]), vec3(normals[i])));
      more += set.added[i] - left * set.forces[i].force;
      f[set.forces[i].node] += set.added[i];
    }
    if (set.corners.empty()) continue;  // none has turned
    set.acceleration = node(Vec3(set.body.free * vec3(more) / set.body.mass));
    for (int n = set.body.first_node; n < set.body.first_node + set.body.nodes; ++n) f[n] -= mass[n] * set.acceleration;
  }
}

bool FadingForces::work(double kick, const std::vector<double>& mass, const NodeField& v_before, const NodeField& v) {
  const auto before = sets_.size();
  const auto spent = [&](Set& set) {
    double done = 0;
    for (std::size_t i = 0; i < set.added.size(); ++i) done += set.added[i].dot(v_before[set.forces[i].node] + v[set.forces[i].node]);
    if (!set.acceleration.isZero(0))
      for (int n = set.body.first_node; n < set.body.first_node + set.body.nodes; ++n) done -= mass[n] * set.acceleration.dot(v_before[n] + v[n]);
    const double of_step = 0.5 * kick * done;
    set.may_do -= of_step;
    return set.may_do < std::max(of_step, 0.0);  // the next step would do too much
  };
  sets_.erase(std::remove_if(sets_.begin(), sets_.end(), spent), sets_.end());
  return sets_.size() < before;
}

double FadingForces::end() const {
  double last = 0;
  for (const Set& set : sets_) last = std::max(last, set.start + set.duration);
  return last;
}

void FadingForces::forget(double t) {
  sets_.erase(std::remove_if(sets_.begin(), sets_.end(), [t](const Set& set) { return t >= set.start + set.duration; }), sets_.end());
}

}  // namespace forming_sim
