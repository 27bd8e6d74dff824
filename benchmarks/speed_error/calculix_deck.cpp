// A deck of CalculiX from a mesh of the package.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "forming_sim/material/material_point.h"
#include "forming_sim/mesh/cell_tables.h"
#include "speed_error/calculix.h"

namespace forming_sim::bench {
namespace {

/// Edges of a brick in the order of its middle nodes 9 to 20.
constexpr int kEdges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

void list(std::ostream& out, const std::vector<int>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) out << numbers[i] << (i + 1 == numbers.size() || i % 12 == 11 ? "\n" : ", ");
}

double yield_stress(const HardeningConfig& h, double p) {
  if (h.curve == "perfect") return h.yield_stress;
  if (h.curve == "linear") return h.yield_stress + h.modulus * p;
  if (h.curve == "voce") return h.saturation_stress - (h.saturation_stress - h.yield_stress) * std::exp(-h.rate * p) + h.modulus * p;
  throw std::runtime_error("a deck is given the hardening curve " + h.curve + "; right is perfect, linear or voce");
}

}  // namespace

Deck::Deck(const Mesh& mesh, const std::string& type, double width) : type_(type) {
  for (const Vec3& X : mesh.nodes) nodes_.push_back(1e3 * X);
  const int count = static_cast<int>(nodes_.size());
  if (mesh.dimension == 2) {
    doubled_ = count;
    for (int n = 0; n < count; ++n) nodes_.push_back(nodes_[n] + Vec3(0, 0, 1e3 * width));
  }
  for (const Cells& cells : mesh.cells) {
    if (cells.kind != CellKind::quad2 && cells.kind != CellKind::hex6)
      throw std::runtime_error(std::string("a deck is given cells of kind ") + shape_of(cells.kind).name + "; right is quad2 or hex6");
    const int corners = shape_of(cells.kind).nodes;
    for (int c = 0; c < cells.count(); ++c) {
      std::vector<int> brick;
      for (int a = 0; a < corners; ++a) brick.push_back(cells.nodes[corners * c + a] + 1);
      for (int a = 0; a < corners && doubled_ > 0; ++a) brick.push_back(brick[a] + count);
      bricks_.push_back(brick);
    }
  }
  if (type == "C3D20R")
    for (std::vector<int>& brick : bricks_)
      for (const auto& edge : kEdges) brick.push_back(between(brick[edge[0]], brick[edge[1]]));
  for (const auto& [name, members] : mesh.sets) {
    std::vector<int>& set = sets_[name];
    for (int n : members)
      for (int number : numbers(n)) set.push_back(number);
    std::sort(set.begin(), set.end());
    const std::vector<int> corners = set;
    for (const auto& [edge, number] : middle_)
      if (std::binary_search(corners.begin(), corners.end(), edge.first) && std::binary_search(corners.begin(), corners.end(), edge.second)) set.push_back(number);
  }
}

int Deck::between(int a, int b) {
  const auto [found, fresh] = middle_.emplace(std::minmax(a, b), static_cast<int>(nodes_.size()) + 1);
  if (fresh) nodes_.push_back((nodes_[a - 1] + nodes_[b - 1]) / 2);
  return found->second;
}

std::vector<int> Deck::numbers(int node) const { return doubled_ > 0 ? std::vector<int>{node + 1, node + 1 + doubled_} : std::vector<int>{node + 1}; }

int Deck::point(const Vec3& x) {
  nodes_.push_back(1e3 * x);
  return static_cast<int>(nodes_.size());
}

void Deck::node_set(const std::string& name, const std::vector<int>& numbers) { sets_[name] = numbers; }

void Deck::material(const MaterialConfig& m) {
  std::ostringstream out;
  out.precision(10);
  out << "*MATERIAL, NAME=BODY\n*ELASTIC\n" << 1e-6 * m.youngs_modulus << ", " << m.poissons_ratio << "\n*DENSITY\n" << 1e-12 * m.density << "\n";
  if (m.hardening) {
    out << "*PLASTIC\n";
    constexpr int points = 60;
    for (int k = 0; k <= points; ++k) {
      const double p = 4 * std::pow(static_cast<double>(k) / points, 3);
      out << 1e-6 * yield_stress(*m.hardening, p) << ", " << p << "\n";
    }
  }
  material_ = out.str();
}

template <class Each> void Deck::each_face(const std::string& set, Each&& each) const {
  std::vector<int> members = sets_.at(set);
  std::sort(members.begin(), members.end());
  for (std::size_t brick = 0; brick < bricks_.size(); ++brick)
    for (int face = 0; face < 6; ++face) {
      int n[4];
      for (int a = 0; a < 4; ++a) n[a] = bricks_[brick][kHexFaces[face][a]];
      if (std::all_of(n, n + 4, [&](int number) { return std::binary_search(members.begin(), members.end(), number); })) each(brick, face, n);
    }
}

void Deck::surface(const std::string& name, const std::string& set) {
  steps += "*SURFACE, NAME=" + name + ", TYPE=ELEMENT\n";
  each_face(set, [&](std::size_t brick, int face, const int*) { steps += std::to_string(brick + 1) + ", S" + std::to_string(face + 1) + "\n"; });
}

void Deck::traction(const std::string& name, int axis, double value) {
  std::map<int, double> load;  // N
  each_face(name, [&](std::size_t, int, const int* n) {
    const double whole = 1e-6 * value * 0.5 * (place(n[2]) - place(n[0])).cross(place(n[3]) - place(n[1])).norm();
    // A quarter to each corner; quadratic faces: -1/12 to each corner, 1/3 to each middle.
    for (int a = 0; a < 4; ++a) {
      load[n[a]] += middle_.empty() ? whole / 4 : -whole / 12;
      if (!middle_.empty()) load[middle_.at(std::minmax(n[a], n[(a + 1) % 4]))] += whole / 3;
    }
  });
  std::ostringstream out;
  out.precision(12);
  out << "*CLOAD\n";
  for (const auto& [number, force] : load) out << number << ", " << axis << ", " << force << "\n";
  steps += out.str();
}

RunSize Deck::size() const {
  const long bricks = static_cast<long>(bricks_.size());
  return {bricks, 0, 3 * static_cast<long>(nodes_.size()), 0, 0};
}

std::string Deck::text() const {
  std::ostringstream out;
  out.precision(12);
  out << "*NODE, NSET=ALL\n";
  for (std::size_t n = 0; n < nodes_.size(); ++n) out << n + 1 << ", " << nodes_[n].x() << ", " << nodes_[n].y() << ", " << nodes_[n].z() << "\n";
  out << "*ELEMENT, TYPE=" << type_ << ", ELSET=BRICKS\n";
  for (std::size_t e = 0; e < bricks_.size(); ++e) {
    out << e + 1 << ", ";
    list(out, bricks_[e]);
  }
  for (const auto& [name, members] : sets_) {
    out << "*NSET, NSET=" << name << "\n";
    list(out, members);
  }
  out << material_ << "*SOLID SECTION, ELSET=BRICKS, MATERIAL=BODY\n";
  if (doubled_ > 0) out << "*BOUNDARY\nALL, 3, 3\n";
  out << steps;
  return out.str();
}

}  // namespace forming_sim::bench
