#pragma once
// Hill's quadratic yield stress of rolled sheet (Hill, 1948), in the axes of the material, 1 along the rolling direction,
// 2 across it, 3 through the thickness:
//
//   q_H^2 = F (S_22 - S_33)^2 + G (S_33 - S_11)^2 + H (S_11 - S_22)^2 + 2 L S_23^2 + 2 M S_31^2 + 2 N S_12^2,
//
// from the ratios r of the strain across the width to that through the thickness in tension along, at 45 degrees to and across
// the rolling direction, and such that q_H is the stress of tension along it:
//
//   G = 1/(1 + r0),  H = r0 G,  F = H/r90,  N = (F + G)(1 + 2 r45)/2,  L = M = 3/2 as without anisotropy.
//
// q_H^2 = sum_i p_i y_i^2 in its own modes: y the components of the deviator S along five unit tensors, two of them of its
// diagonal, three the shears times sqrt 2. Without anisotropy every p is 3/2.
#include <vector>

#include "forming_sim/material/config.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// q_H in a frame of three axes of the material, in any order.
struct HillModes {
  double normal[2][3] = {};  ///< diagonals of the two unit tensors
  double p[5] = {};            ///< of these two, and of the shears 01, 12, 20
  double most = 0, least = 0;  ///< of all p
};

/// Of a body. Its axes turn with the sheet: the normal stays across the fibres that were along and across the rolling direction,
/// and these two axes turn as the fibres do in the mean, by the rotation of the polar decomposition in the plane of the sheet.
/// In space the frame is rolling direction, across, normal. In a section it is two axes in its plane and z; where one of the two
/// is the normal, the other goes with its fibres.
struct Orthotropy {
  double space_axes[2][3] = {}, section_axes[2][2] = {};  ///< the first two of the frame at the start
  double second_fibre = 1;  ///< of a section: 1 where both are fibres of the sheet, 0 where the second is its normal
  HillModes space, plane;
};

/// What is wrong with the directions in this dimension, and what would be right; empty: nothing.
struct DirectionFault {
  std::string field, given, right;
};
std::vector<DirectionFault> find_direction_faults(const AnisotropyConfig& config, int dimension);

/// Directions that are not given: x is the rolling direction; the normal is z, of a section y. What a dimension cannot have is left empty.
Orthotropy orthotropy_of(const AnisotropyConfig& config);

/// Numbers that a point keeps of its axes.
constexpr int axis_items(int dimension) { return 2 * dimension; }

/// Fibres d of the first two axes by the edges X_m (columns) that they go with: d^m = d . X^m, so that they are x_m d^m later.
std::vector<double> axes_at_start(const Orthotropy& material, int dimension, const Mat3& edges);

}  // namespace forming_sim
