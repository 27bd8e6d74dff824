#include "mesh/region.h"

#include <Eigen/Geometry>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {

std::function<double(const Vec3&)> distance_from(const PlaceConfig& region, bool flat, const std::string& whose) {
  const auto direction = [&](Vec3 given, const char* what) {
    if (!(given.norm() > 0) || !given.allFinite() || !region.point.allFinite())
      throw Error(Code::mesh_error, whose + "the " + what + " has no length" + (flat ? " in x and y" : "") + "; give a direction");
    return Vec3(given.normalized());
  };
  const Vec3 point = region.point;
  const double radius = region.radius;
  if (region.choose == "plane") {
    const Vec3 normal = direction(flat ? Vec3(region.normal.x(), region.normal.y(), 0) : region.normal, "normal of its plane");
    return [=](const Vec3& x) { return normal.dot(x - point); };
  }
  if (region.choose == "cylinder") {
    const Vec3 axis = flat || region.axis.isZero(0) ? Vec3(Vec3::UnitZ()) : direction(region.axis, "axis of its cylinder");
    return [=](const Vec3& x) { return axis.cross(x - point).norm() - radius; };
  }
  if (region.choose == "sphere") return [=](const Vec3& x) { return (x - point).norm() - radius; };
  if (region.choose != "box") throw Error(Code::mesh_error, whose + "given choose \"" + region.choose + "\"; plane, box, cylinder or sphere is needed");
  Vec3 least = region.min, greatest = region.max;
  if (flat) least.z() = greatest.z() = 0;
  if (!(least.array() <= greatest.array()).all())
    throw Error(Code::mesh_error, whose + "the least corner " + place(region.min) + " of its box is beyond the greatest " + place(region.max) + "; exchange the coordinates");
  return [=](const Vec3& x) {
    const int axes = flat ? 2 : 3;
    return (least - x).head(axes).cwiseMax((x - greatest).head(axes)).maxCoeff();
  };
}

}  // namespace forming_sim
