#pragma once
// The places that sets and cuts are chosen by: a plane, a box, a cylinder, a sphere.
#include <functional>
#include <string>

#include "forming_sim/mesh/config.h"

namespace forming_sim {

/// How far a point is from it, m: below 0 inside a box, a cylinder or a sphere, above 0 where the normal of a plane points to.
/// whose: as messages name it; flat: z does not count.
/// Throws Error(mesh_error) for a direction of no length, a box whose least corner is beyond its greatest, or an unknown way to choose.
std::function<double(const Vec3&)> distance_from(const PlaceConfig& region, bool flat, const std::string& whose);

}  // namespace forming_sim
