// In dimension 2 nothing leaves the plane z = 0. The declared units tell
// rotations (deg, deg/s; about z) from vectors (in the plane).
#include "rules.h"

namespace forming_sim {

namespace {

void check_vector(const Vec3& value, const std::string& path, const Field& field, FaultList& faults) {
  const bool turns = field.unit() == "deg" || field.unit() == "deg/s";
  const bool good = turns ? value.x() == 0 && value.y() == 0 : value.z() == 0;
  if (good || !value.allFinite()) return;
  faults.add(path, given_text(value),
             turns ? "give [0, 0, angle]: in dimension 2 things turn about z only"
                   : "give z = 0: in dimension 2 everything lies in the x-y plane");
}

/// no_turns: others refuse whatever turns bodies or moves tools, as rules_axisymmetric.cpp does; how a tool is placed is left.
template <class Config> void check_plane(const Config& config, const std::string& path, bool no_turns, FaultList& faults) {
  for_each_field(config, [&](const std::string& name, const auto& value, const Field& field) {
    using T = std::decay_t<decltype(value)>;
    const std::string here = join_path(path, name);
    if (no_turns && (field.unit() == "deg" || field.unit() == "deg/s") && name != "rotation_deg") return;
    if constexpr (is_config<T>) {
      check_plane(value, here, no_turns, faults);
    } else if constexpr (is_optional<T>) {
      if (value) check_plane(*value, here, no_turns, faults);
    } else if constexpr (is_vector<T>) {
      if constexpr (is_group<T>) {
        for (std::size_t i = 0; i < value.size(); ++i) check_plane(value[i], join_path(here, i), no_turns, faults);
      } else if constexpr (std::is_same_v<typename T::value_type, Vec3>) {
        faults.each(value, [&](std::size_t i) { check_vector(value[i], join_path(here, i), field, faults); });
      }
    } else if constexpr (std::is_same_v<T, Vec3>) {
      const bool corner_of_box = std::is_base_of_v<PlaceConfig, Config> && (name == "min" || name == "max");
      const bool axle = std::is_same_v<Config, MotionConfig> && name == "axle";
      const bool through_the_plane = corner_of_box || axle || std::is_same_v<Config, SpringbackConfig> || std::is_same_v<Config, AnisotropyConfig>;  // rules_bodies.cpp and rules_tools.cpp know what is right
      if (!through_the_plane) check_vector(value, here, field, faults);
    }
  });
}

}  // namespace

void check_section(const Scene& scene, FaultList& faults) {
  if (scene.dimension != 2) return;
  check_plane(scene, "", scene.axisymmetric, faults);
  if (scene.output.springback && !scene.output.springback->normal.isZero(0))
    faults.add("output.springback.normal", given_text(scene.output.springback->normal), "leave it out: in dimension 2 angles are seen in the x-y plane");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t k = 0; k < scene.bodies[i].boundaries.size(); ++k) {
      const auto& axes = scene.bodies[i].boundaries[k].axes;
      if (std::find(axes.begin(), axes.end(), "z") == axes.end()) continue;
      faults.add(join_path(body_path(i) + ".boundaries", k) + ".axes", given_text(axes),
                 "leave z out: in dimension 2 nothing moves along z");
    }
  }
}

}  // namespace forming_sim
