#pragma once
// The elements whose step is timed, one line each, and the motions that they are timed in.
#include "support/bodies.h"

namespace forming_sim::bench {

struct SpeedFamily {
  const char* name;
  CellKind kind;
  const char* average;  ///< of the pressure: BodyModel::pressure_average
  bool ring;            ///< the section is turned about the y axis
};

constexpr SpeedFamily kSpeedFamilies[] = {{"4 crossed triangles", CellKind::crossed, "cell", false},
                                          {"2 triangles", CellKind::quad2, "cell", false},
                                          {"free triangles", CellKind::triangle, "node", false},
                                          {"axisymmetric, 4 crossed triangles", CellKind::crossed, "cell", true},
                                          {"axisymmetric, 2 triangles", CellKind::quad2, "cell", true},
                                          {"24 tetrahedra", CellKind::hex24, "cell", false},
                                          {"6 tetrahedra", CellKind::hex6, "cell", false},
                                          {"free tetrahedra", CellKind::tetrahedron, "node", false},
                                          {"one-point quadrilaterals", CellKind::quad1, "cell", false},
                                          {"one-point hexahedra", CellKind::hex1, "cell", false}};

/// An even stretch of a body with Voce hardening, a little more in every step.
struct SpeedMotion {
  const char* name;
  double start;     ///< strain along the body before the first step
  double per_step;  ///< strain along the body in a step
  double bending = 0;  ///< strain in a step that bending adds along its outermost fibres, towards y in the plane, z in space

  bool yields() const { return start > 0; }
};
constexpr SpeedMotion kElastic{"elastic", 0, 1e-9};          ///< far from the yield stress
constexpr SpeedMotion kForming{"forming", 0.03, 1e-6};       ///< all of it yields, as in a forming run of some hundred thousand steps
constexpr SpeedMotion kImpactFlow{"full flow", 0.03, 3e-4};  ///< all of it yields, as in an impact
constexpr SpeedMotion kBending{"forming and bending", 0.03, 1e-6, 1e-6};  ///< one-point cells flow by what varies across them too
constexpr const SpeedMotion* kSpeedMotions[] = {&kElastic, &kForming, &kImpactFlow};

/// Stretches of the axes of a body whose strain along itself is e: the volume stays to first order.
/// Along y of a ring, so that its radius shrinks.
inline Vec3 stretches(const SpeedFamily& family, int dimension, double e) {
  if (family.ring) return {1 - 0.5 * e, 1 + e, 1};
  if (dimension == 2) return {1 + e, 1 - e, 1};
  return {1 + e, 1 - 0.5 * e, 1 - 0.5 * e};
}

}  // namespace forming_sim::bench
