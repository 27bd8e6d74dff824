#pragma once
// CalculiX (the program ccx; Debian's package calculix-ccx) as a peer: a deck is
// written from the package's own mesh and material, run on one thread, and its printed
// results are read back. Units of a deck: mm, N, MPa, tonnes, s.
#include <map>
#include <string>
#include <vector>

#include "forming_sim/material/config.h"
#include "forming_sim/mesh/mesh.h"
#include "speed_error/problems.h"

namespace forming_sim::bench {

class Deck {
 public:
  /// Bricks of `type` (C3D8, C3D8I, C3D8R, C3D20R) for the coarse cells of a mesh:
  /// hexahedra as they are, quadrilaterals as one layer of `width` (m) along z, held in
  /// z. The sets of the mesh are node sets of the same names, ALL is every node.
  /// Throws std::runtime_error for a mesh of other cells.
  Deck(const Mesh& mesh, const std::string& type, double width = 0);

  /// The material of all bricks: elastic, von Mises, the hardening curve as a table to plastic strain 4.
  void material(const MaterialConfig& material);
  /// The dead load of a traction (Pa) along an axis (1 to 3) on the faces of a set; inside a *STEP.
  void traction(const std::string& set, int axis, double value);
  /// Names the faces whose nodes are all of a set a surface; comes into `steps`.
  void surface(const std::string& name, const std::string& set);
  /// Adds a point (m); its number.
  int point(const Vec3& x);
  void node_set(const std::string& name, const std::vector<int>& numbers);
  /// Numbers of the mesh's node: one, or where it was made a layer of bricks two.
  std::vector<int> numbers(int node) const;
  /// Numbers of a set of the mesh, those between its nodes too.
  const std::vector<int>& set(const std::string& name) const { return sets_.at(name); }
  const Vec3& place(int number) const { return nodes_[number - 1]; }  ///< mm
  /// Without elements: an implicit increment is no step of theirs.
  RunSize size() const;

  /// What follows the model: constraints, then steps, written by the problem.
  std::string steps;
  std::string text() const;

 private:
  int between(int a, int b);
  /// Calls each(brick, face, its four corners) for the faces whose corners are all of a set.
  template <class Each> void each_face(const std::string& set, Each&& each) const;
  std::vector<Vec3> nodes_;                       ///< mm
  std::vector<std::vector<int>> bricks_;          ///< numbers, from 1
  std::map<std::pair<int, int>, int> middle_;     ///< of edges
  std::map<std::string, std::vector<int>> sets_;
  std::string type_, material_;
  int doubled_ = 0;                               ///< nodes of the first face, 0: of hexahedra
};

/// One table that ccx printed.
struct Printed {
  std::string what, set;   ///< "displacements", "forces", "total" (force); the set in capitals
  double time;
  std::vector<std::vector<double>> rows;  ///< node number, values
};

class CalculixRun {
 public:
  /// Runs the deck in DIR/calculix, or where the request names no directory in one that
  /// is removed; stopped after `limit` s of processor time.
  CalculixRun(const Deck& deck, const std::string& name, const Request& request, int limit = 60);

  bool failed() const { return !failure_.empty(); }
  const std::string& failure() const { return failure_; }   ///< in its own words
  const std::vector<Printed>& printed() const { return printed_; }
  /// The last table of a set. Throws std::runtime_error where there is none.
  const Printed& last(const std::string& what, const std::string& set) const;
  double wall_time() const { return wall_time_; }
  long increments() const { return increments_; }

 private:
  std::string failure_;
  std::vector<Printed> printed_;
  double wall_time_ = 0;
  long increments_ = 0;
};

/// Path of ccx, "" where it is not installed; then `report` says how to install it.
std::string find_calculix();
bool calculix_or_say(Report& report);

}  // namespace forming_sim::bench
