#pragma once
// Probes: a node or a set of nodes whose motion and stress are followed.
#include <array>
#include <string>
#include <vector>

#include "forming_sim/results/config.h"
#include "forming_sim/simulation/model.h"
#include "forming_sim/element/elements.h"

namespace forming_sim {

struct Probe {
  std::string name;
  std::vector<int> nodes;     ///< joined numbering; one for a point
  std::vector<int> elements;  ///< over which the stress is averaged: those with all nodes in the set,
                              ///< or, where there is none, those that touch it
  bool held = false;          ///< boundaries hold or drive nodes of it, or have, and push on them
};

struct ProbeValue {
  Vec3 position = Vec3::Zero();  ///< m, mean of the nodes
  Vec3 velocity = Vec3::Zero();  ///< m/s, mean of the nodes
  Sym stress = Sym::Zero();      ///< Pa, mean over the current volume: xx yy zz xy yz zx
};

/// Their names and nodes. Throws SceneError naming the probes whose body or set is not there or empty.
std::vector<Probe> place_probes(const std::vector<ProbeConfig>& configs, const Model& model);
/// With the elements too, for which all of the model's are gone through.
std::vector<Probe> find_probes(const std::vector<ProbeConfig>& configs, const Model& model,
                               const std::vector<std::array<int, 4>>& elements);

/// stress: of the probe's elements, in their order.
ProbeValue measure(const Probe& probe, const Model& model, const std::vector<std::array<int, 4>>& elements,
                   const NodeField& positions, const NodeField& velocities, const Sym* stress);

/// Volume of a simplex (plane strain: area; axisymmetric: per radian), positive where its nodes are in order.
double simplex_volume(const Model& model, const std::array<int, 4>& element, const NodeField& positions);

/// Angle of the line from one point to another against the x axis, in the x-y
/// plane (dimension 2) or the x-z plane (3), degrees in (-180, 180]. With a normal, of any length, in the plane across that, in the right-hand sense
/// about it; across x against the y axis.
double line_angle_deg(int dimension, const Vec3& from, const Vec3& to, const Vec3& normal = Vec3::Zero());
/// b - a, brought into (-180, 180].
double angle_change_deg(double a, double b);

}  // namespace forming_sim
