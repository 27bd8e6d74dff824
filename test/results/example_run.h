#pragma once
// A small plane-strain result with known numbers, for the tests of this room.
#include <cmath>
#include <filesystem>
#include <string>

#include "forming_sim/results/frame.h"

namespace forming_sim {

/// A directory of its own that is removed with its owner.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "forming_sim_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return (std::filesystem::path(path_) / name).string(); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// n x n squares of two triangles, a tool of two segments, a plane.
inline ResultHeader example_header(int n) {
  ResultHeader header;
  header.version = "0.1.0";
  header.scene_name = "sheet <& die>";
  header.scene_text = "name: sheet\ndimension: 2\n";
  header.dimension = 2;
  header.bodies = {"sheet"};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) header.initial_positions.push_back(Node(i * 1e-3, j * 1e-3, 0, 0));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      header.elements.push_back({a, a + 1, b + 1, -1});
      header.elements.push_back({a, b + 1, b, -1});
    }
  header.element_body.assign(header.elements.size(), 0);
  for (int i = 0; i < n; ++i) header.surface.push_back({{i, i + 1, -1}, 2 * i});
  header.sets["sheet/left edge"] = {0, n + 1};
  header.tools.resize(2);
  header.tools[0].name = "punch";
  header.tools[0].points = {Vec3(0, 0, 0), Vec3(1e-3, 0, 0), Vec3(1e-3, 1e-3, 0)};
  header.tools[0].facets = {{0, 1, -1}, {1, 2, -1}};
  header.tools[1].name = "floor";
  header.tools[1].plane_normal = Vec3(0, 1, 0);
  return header;
}

/// The number that frame `index` holds at place `i`.
inline double example_value(int index, std::size_t i) { return index + std::sin(0.1 * static_cast<double>(i)); }

inline Frame example_frame(const ResultHeader& header, int index) {
  Frame frame;
  frame.time = 1e-3 * index;
  frame.step = 10 * index;
  frame.stage = "form";
  frame.positions = header.initial_positions;
  frame.velocities.resize(header.initial_positions.size());
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    frame.positions[i].y() += example_value(index, i);
    frame.velocities[i] = Node(0, example_value(index, i), 0, 0);
    frame.contact_pressure.push_back(static_cast<float>(1e6 * example_value(index, i)));
    frame.contact_gap.push_back(static_cast<float>(1e-3 * example_value(index, i)));
    frame.contact_slip.push_back(static_cast<float>(1e-4 * example_value(index, i)));
    frame.thickness.push_back(static_cast<float>(1e-3 * example_value(index, i)));
    frame.limit_ratio.push_back(static_cast<float>(0.7 * example_value(index, i)));
    frame.thinning.push_back(static_cast<float>(0.1 * example_value(index, i)));
  }
  for (std::size_t e = 0; e < header.elements.size(); ++e) {
    const float value = static_cast<float>(example_value(index, e));
    frame.plastic_strain.push_back(value);
    frame.stress.push_back({value, 2 * value, 3 * value, 4 * value, 5 * value, 6 * value});
    frame.volume_ratio.push_back(1 + value);
    frame.damage.push_back(0.5F * value);
  }
  frame.damage_unit = "1";
  frame.surface_strain.assign(header.surface.size(), static_cast<float>(index));
  frame.surface_strain_minor.assign(header.surface.size(), static_cast<float>(-0.5 * index));
  frame.membrane_strain.assign(header.surface.size(), static_cast<float>(0.3 * index));
  frame.membrane_strain_minor.assign(header.surface.size(), static_cast<float>(-0.2 * index));
  frame.tools.resize(2);
  frame.tools[0].position = Vec3(0, 0.01 * (index / 2), 0);  // it rests every other frame
  frame.tools[0].force = Vec3(0, 100 + index, 0);
  frame.tools[0].moment = Vec3(0, 0, index - 3);
  frame.tools[0].present = index < 4;
  return frame;
}

}  // namespace forming_sim
