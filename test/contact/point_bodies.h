#pragma once
// Bodies of lumped nodes for the tests of contact: a mesh gives the surface,
// springs (or nothing) hold the nodes together.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "forming_sim/contact/contact.h"
#include "forming_sim/element/nodes.h"

namespace contact_test {
using namespace forming_sim;

inline std::function<ToolMotion(double)> at_rest(const Vec3& position = Vec3::Zero()) {
  return [position](double) {
    ToolMotion m;
    m.position0 = m.position1 = position;
    return m;
  };
}

struct World {
  int dimension = 2;
  NodeField x, v, force;
  std::vector<double> mass;
  Vec3 gravity = Vec3::Zero();
  struct Spring {
    int a, b;
    double length, stiffness;
  };
  std::vector<Spring> springs;
  std::vector<ContactSurface> bodies, tools;
  std::vector<Mesh> meshes;                         ///< of tools
  std::vector<std::function<Vec3(double)>> path;    ///< of tools: position over time
  double turning = 0;                               ///< of all tools about z through their position, rad/s
  std::vector<HeldNode> held;
  NodeField held_velocity;
  ContactConfig config;
  Team* team = nullptr;
  double modulus = 70e9, thinnest = 1, wave_speed = 5000;
  double time = 0, before = 0;  ///< dt of the step before
  ContactStep last;
  // sums over the run
  double change = 0, potential_before = 0, friction = 0, dissipated = 0, work = 0, soft = 0, exchanged = 0;
  long halvings = 0, crossings = 0;
  int most_sweeps = 0;
  double least_gap = 1;

  std::vector<ToolMotion> motion(double t0, double t1) const {
    std::vector<ToolMotion> all(tools.size());
    for (size_t t = 0; t < tools.size(); ++t) {
      all[t].position0 = path[t](t0);
      all[t].position1 = path[t](t1);
      all[t].rotation0 = Eigen::AngleAxisd(turning * t0, Vec3::UnitZ()).toRotationMatrix();
      all[t].rotation1 = Eigen::AngleAxisd(turning * t1, Vec3::UnitZ()).toRotationMatrix();
    }
    return all;
  }
  ContactSetup setup() const {
    ContactSetup setup;
    setup.dimension = dimension;
    setup.config = config;
    setup.bodies = bodies;
    setup.tools = tools;
    for (const Mesh& mesh : meshes) setup.tool_meshes.push_back(&mesh);
    setup.softest_modulus = modulus;
    setup.thinnest = thinnest;
    setup.wave_speed = wave_speed;
    setup.team = team;
    return setup;
  }
  Contact make() const {
    Contact contact(setup(), x, motion(time, time));
    std::vector<double> inverse;
    for (double m : mass) inverse.push_back(1 / m);
    contact.set_masses(inverse, held);
    return contact;
  }
  /// First and last node of the surface of a body.
  std::pair<int, int> nodes_of(const ContactSurface& body) const {
    std::pair<int, int> range(static_cast<int>(x.size()), -1);
    for (const Facet& f : body.facets)
      for (int k = 0; k < dimension; ++k) {
        range.first = std::min(range.first, f.nodes[k]);
        range.second = std::max(range.second, f.nodes[k]);
      }
    return range;
  }
  /// Moves bodies that touched each other at the start, as the contact wants it.
  void take_shifts(const Contact& contact) {
    for (size_t b = 0; b < bodies.size(); ++b) {
      const int first = nodes_of(bodies[b]).first, last = b + 1 < bodies.size() ? nodes_of(bodies[b + 1]).first : static_cast<int>(x.size());
      for (int n = first; n < last; ++n) x[n] += node(contact.body_shifts()[b]);
    }
  }
  void spring_forces() {
    force.assign(x.size(), Node::Zero());
    for (const Spring& s : springs) {
      const Node d = x[s.b] - x[s.a];
      const double length = d.norm();
      const Node f = s.stiffness * (length - s.length) / length * d;
      force[s.a] += f;
      force[s.b] -= f;
    }
    for (size_t i = 0; i < x.size(); ++i) force[i] += mass[i] * node(gravity);
  }
  void step(Contact& contact, double dt, bool check = true) {
    spring_forces();
    NodeField v_before, kicked;
    last = contact.advance(
        time, dt, x, v, v_before,
        [&](double h, NodeField& v_star) {
          for (size_t i = 0; i < x.size(); ++i) v_star[i] = v[i] + (0.5 * (before > 0 ? before + h : h) / mass[i]) * force[i];
          for (size_t i = 0; i < held.size(); ++i)
            v_star[held[i].node] = node(held[i].projector * vec3(v_star[held[i].node]) + (Mat3::Identity() - held[i].projector) * vec3(held_velocity[i]));
          kicked = v_star;
        },
        [](double h, const NodeField& with, NodeField& at) {
          static Team alone(1);
          move_nodes(NodeTeam(alone, static_cast<long>(at.size())), h, with, nullptr, at);
        },
        [&](double h, std::vector<ToolMotion>& now) { now = motion(time, time + h); });
    for (size_t i = 0; i < x.size(); ++i) {
      const Node j = mass[i] * (v[i] - kicked[i]);
      const double w = j.dot(0.5 * (v[i] + v_before[i]));
      change += w;
      exchanged += std::abs(w);
    }
    before = last.dt;
    time += last.dt;
    halvings += last.halvings;
    friction += last.friction_work;
    dissipated += last.dissipated;
    work += last.tool_work - last.held_work;
    soft += last.soft_start_work;
    most_sweeps = std::max(most_sweeps, last.sweeps);
    least_gap = std::min(least_gap, last.min_gap_over_layer);
    if (check) crossings += contact.count_crossings(x, motion(time, time));
  }
  double closure() const { return change + last.potential + dissipated + friction - work - soft; }
  Vec3 momentum() const {
    Vec3 p = Vec3::Zero();
    for (size_t i = 0; i < x.size(); ++i) p += mass[i] * vec3(v[i]);
    return p;
  }
  Vec3 angular_momentum() const {
    Vec3 l = Vec3::Zero();
    for (size_t i = 0; i < x.size(); ++i) l += mass[i] * vec3(x[i]).cross(vec3(v[i]));
    return l;
  }
  double kinetic() const {
    double sum = 0;
    for (size_t i = 0; i < x.size(); ++i) sum += .5 * mass[i] * v[i].squaredNorm();
    return sum;
  }
  Vec3 mean_velocity() const {
    double m = 0;
    for (double mi : mass) m += mi;
    return momentum() / m;
  }

  void add_tool(const std::string& name, Mesh mesh, double friction, std::function<Vec3(double)> where) {
    ContactSurface s;
    s.name = name;
    s.dimension = dimension;
    s.rigid = true;
    s.facets = mesh.surface;
    s.friction = friction;
    tools.push_back(s);
    meshes.push_back(std::move(mesh));
    path.push_back(std::move(where));
  }
  void add_plane(const std::string& name, const Vec3& point, const Vec3& normal, double friction, std::function<Vec3(double)> where) {
    add_tool(name, Mesh(), friction, std::move(where));
    tools.back().plane = true;
    tools.back().point = point;
    tools.back().normal = normal.normalized();
  }
  /// nx x ny cells from `low` of size dx, dy, turned by `angle` about low.
  void add_strip(const Vec3& low, int nx, int ny, double dx, double dy, double density, double stiffness, double angle = 0) {
    const int first = static_cast<int>(x.size());
    const auto id = [&](int i, int j) { return first + j * (nx + 1) + i; };
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const double px = i * dx, py = j * dy;
        x.push_back(Node(low.x() + std::cos(angle) * px - std::sin(angle) * py, low.y() + std::sin(angle) * px + std::cos(angle) * py, 0, 0));
        mass.push_back(density * dx * dy * (i == 0 || i == nx ? .5 : 1) * (j == 0 || j == ny ? .5 : 1));
      }
    v.resize(x.size(), Node::Zero());
    ContactSurface s;
    s.name = "body" + std::to_string(bodies.size());
    s.dimension = 2;
    const auto segment = [&](int a, int b) {
      Facet f;
      f.nodes = {a, b, -1};
      s.facets.push_back(f);
    };
    for (int i = 0; i < nx; ++i) segment(id(i, 0), id(i + 1, 0));
    for (int j = 0; j < ny; ++j) segment(id(nx, j), id(nx, j + 1));
    for (int i = nx; i > 0; --i) segment(id(i, ny), id(i - 1, ny));
    for (int j = ny; j > 0; --j) segment(id(0, j), id(0, j - 1));
    bodies.push_back(s);
    const auto tie = [&](int a, int b) { springs.push_back({a, b, (x[a] - x[b]).norm(), stiffness}); };
    if (stiffness > 0)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
          if (i < nx) tie(id(i, j), id(i + 1, j));
          if (j < ny) tie(id(i, j), id(i, j + 1));
          if (i < nx && j < ny) tie(id(i, j), id(i + 1, j + 1)), tie(id(i + 1, j), id(i, j + 1));
        }
  }
  /// A body with the given corners in the plane, counter-clockwise, a mass at each
  /// and at their middle, a spring between any two.
  void add_polygon(const std::vector<Vec3>& corners, double nodal_mass, double stiffness) {
    const int first = static_cast<int>(x.size()), n = static_cast<int>(corners.size());
    Vec3 middle = Vec3::Zero();
    ContactSurface s;
    s.name = "body" + std::to_string(bodies.size());
    s.dimension = 2;
    for (int i = 0; i < n; ++i) {
      middle += corners[i] / n;
      x.push_back(node(corners[i]));
      Facet f;
      f.nodes = {first + i, first + (i + 1) % n, -1};
      s.facets.push_back(f);
    }
    x.push_back(node(middle));
    mass.resize(x.size(), nodal_mass);
    v.resize(x.size(), Node::Zero());
    bodies.push_back(s);
    for (int a = first; a <= first + n; ++a)
      for (int b = a + 1; b <= first + n; ++b) springs.push_back({a, b, (x[a] - x[b]).norm(), stiffness});
  }
  /// A box of n x n x m cells with triangulated faces.
  void add_box(const Vec3& low, int nx, int ny, int nz, double d, double density, double stiffness) {
    const int first = static_cast<int>(x.size());
    const auto id = [&](int i, int j, int k) { return first + (k * (ny + 1) + j) * (nx + 1) + i; };
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
          x.push_back(Node(low.x() + i * d, low.y() + j * d, low.z() + k * d, 0));
          mass.push_back(density * d * d * d * (i == 0 || i == nx ? .5 : 1) * (j == 0 || j == ny ? .5 : 1) * (k == 0 || k == nz ? .5 : 1));
        }
    v.resize(x.size(), Node::Zero());
    ContactSurface s;
    s.name = "body" + std::to_string(bodies.size());
    const auto quad = [&](int a, int b, int c, int e) {
      Facet f;
      f.nodes = {a, b, c};
      s.facets.push_back(f);
      f.nodes = {a, c, e};
      s.facets.push_back(f);
    };
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        quad(id(i, j, 0), id(i, j + 1, 0), id(i + 1, j + 1, 0), id(i + 1, j, 0));
        quad(id(i, j, nz), id(i + 1, j, nz), id(i + 1, j + 1, nz), id(i, j + 1, nz));
      }
    for (int k = 0; k < nz; ++k)
      for (int i = 0; i < nx; ++i) {
        quad(id(i, 0, k), id(i + 1, 0, k), id(i + 1, 0, k + 1), id(i, 0, k + 1));
        quad(id(i, ny, k), id(i, ny, k + 1), id(i + 1, ny, k + 1), id(i + 1, ny, k));
      }
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j) {
        quad(id(0, j, k), id(0, j, k + 1), id(0, j + 1, k + 1), id(0, j + 1, k));
        quad(id(nx, j, k), id(nx, j + 1, k), id(nx, j + 1, k + 1), id(nx, j, k + 1));
      }
    bodies.push_back(s);
    if (stiffness <= 0) return;
    const int ways[13][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
          for (const auto& w : ways) {
            const int a = i + w[0], b = j + w[1], c = k + w[2];
            if (a < 0 || a > nx || b < 0 || b > ny || c < 0 || c > nz) continue;
            springs.push_back({id(i, j, k), id(a, b, c), (x[id(i, j, k)] - x[id(a, b, c)]).norm(), stiffness});
          }
  }
};

/// Segments through the points, in this order.
inline Mesh polyline(const std::vector<Vec3>& points, bool closed = false) {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.nodes = points;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i + (closed ? 0 : 1) < n; ++i) {
    Facet f;
    f.nodes = {i, (i + 1) % n, -1};
    mesh.surface.push_back(f);
  }
  return mesh;
}

inline Mesh triangles(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& corners) {
  Mesh mesh;
  mesh.nodes = points;
  for (const auto& c : corners) {
    Facet f;
    f.nodes = c;
    mesh.surface.push_back(f);
  }
  return mesh;
}

/// A wavy square of 2 n n triangles in the x-y plane, from -size to size.
inline Mesh sheet(int n, double size, const std::function<double(double, double)>& height) {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> corners;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double px = size * (2.0 * i / n - 1), py = size * (2.0 * j / n - 1);
      points.emplace_back(px, py, height(px, py));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      corners.push_back({a, a + 1, a + n + 2});
      corners.push_back({a, a + n + 2, a + n + 1});
    }
  return triangles(points, corners);
}

}  // namespace contact_test
