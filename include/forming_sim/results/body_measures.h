#pragma once
// Mass, centre and momenta of a body, and its bounding box.
#include <Eigen/Geometry>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

struct BodyMeasures {
  double mass = 0;                             ///< kg (kg/m in plane strain)
  Vec3 centre = Vec3::Zero();                  ///< of mass, m
  Vec3 momentum = Vec3::Zero();                ///< kg m/s
  Vec3 angular_momentum = Vec3::Zero();        ///< about the origin, kg m2/s
  Eigen::AlignedBox3d box;                     ///< of the nodes, m
};

/// Over the nodes first, first + 1, ... first + count - 1. Axisymmetric: around the circle
/// what is radial cancels, so centre and momentum lie along the axis.
BodyMeasures measure_body(int first, int count, bool axisymmetric, const std::vector<double>& nodal_mass, const NodeField& positions,
                          const NodeField& velocities);

}  // namespace forming_sim
