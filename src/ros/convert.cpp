#include "forming_sim/ros/convert.h"

#include <filesystem>
#include <functional>

#include "forming_sim/config/reflect.h"
#include "forming_sim/config/words.h"
#include "forming_sim/scene/urls.h"

namespace forming_sim {
namespace {

// ---- one visitor for both directions: Config::declare hands out an accessor
// that works on the Config and on its message.

template <class Config, class Message> bool is_empty(const Message& message);

/// True for what stands for "not given" in a message; T is the Config's member type.
template <class T, class M> bool not_given(const M& value) {
  if constexpr (is_config<T>) return is_empty<T>(value);
  else if constexpr (is_optional<T>) return is_empty<typename T::value_type>(value);
  else if constexpr (is_vector<T> || std::is_same_v<T, std::string>) return value.empty();
  else if constexpr (std::is_same_v<T, Vec3>) return value.x == 0 && value.y == 0 && value.z == 0;
  else return value == 0;
}

template <class Config, class Message> bool is_empty(const Message& message) {
  const Config defaults{};
  bool empty = true;
  Config::declare([&](const char*, auto access, const Field&) {
    using T = std::decay_t<decltype(access(defaults))>;
    empty = empty && not_given<T>(access(message));
  });
  if constexpr (std::is_same_v<Config, MeshConfig>) {
    empty = empty && message.shape.vertices.empty() && message.shape.triangles.empty();
  }
  return empty;
}

template <class Config, class Message>
void write(const Config& config, Message& message, const std::string& path);

template <class T, class M> void write_value(const T& value, M& message, const std::string& path) {
  if constexpr (is_config<T>) {
    write(value, message, path);
  } else if constexpr (is_optional<T>) {
    if (!value) return;
    write(*value, message, path);
    if (is_empty<typename T::value_type>(message)) {
      throw SceneError({{Code::invalid_scene, path, "a group with nothing in it", "give its fields, or leave it out"}});
    }
  } else if constexpr (is_vector<T>) {
    message.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) write_value(value[i], message[i], join_path(path, i));
  } else if constexpr (std::is_same_v<T, Vec3>) {
    message.x = value.x();
    message.y = value.y();
    message.z = value.z();
  } else {
    message = value;
  }
}

template <class Config, class Message>
void write(const Config& config, Message& message, const std::string& path) {
  Config::declare([&](const char* name, auto access, const Field&) {
    write_value(access(config), access(message), join_path(path, name));
  });
}

/// shape_msgs/Mesh is the ROS spelling of an inline triangle mesh.
void read_shape(const MeshSpec& message, MeshConfig& config, const std::string& path, std::vector<Fault>& faults) {
  if (message.shape.vertices.empty() && message.shape.triangles.empty()) return;
  if (!config.points.empty() || !config.cells.empty() || !config.url.empty()) {
    faults.push_back({Code::invalid_scene, join_path(path, "shape"),
                      std::to_string(message.shape.triangles.size()) + " triangles beside " +
                          (config.url.empty() ? "points and cells" : "the url " + given_text(config.url)),
                      "give the mesh once: by url, by points and cells, or by shape"});
    return;
  }
  for (const auto& p : message.shape.vertices) config.points.emplace_back(p.x, p.y, p.z);
  for (const auto& triangle : message.shape.triangles) {
    for (const std::uint32_t corner : triangle.vertex_indices) config.cells.push_back(static_cast<int>(corner));
  }
  if (config.cell_type.empty()) config.cell_type = "triangle";
}

template <class Config, class Message>
void read(const Message& message, Config& config, const std::string& path, std::vector<Fault>& faults);

template <class T, class M>
void read_value(const M& message, T& value, const std::string& path, std::vector<Fault>& faults) {
  if constexpr (is_config<T>) {
    read(message, value, path, faults);
  } else if constexpr (is_optional<T>) {
    if (!not_given<T>(message)) read(message, value.emplace(), path, faults);
  } else if constexpr (is_vector<T>) {
    if (message.empty()) return;
    value.clear();
    value.resize(message.size());
    for (std::size_t i = 0; i < message.size(); ++i) read_value(message[i], value[i], join_path(path, i), faults);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    value = Vec3(message.x, message.y, message.z);
  } else if (!not_given<T>(message)) {
    value = static_cast<T>(message);
  }
}

template <class Config, class Message>
void read(const Message& message, Config& config, const std::string& path, std::vector<Fault>& faults) {
  Config::declare([&](const char* name, auto access, const Field&) {
    read_value(access(message), access(config), join_path(path, name), faults);
  });
  if constexpr (std::is_same_v<Config, MeshConfig>) read_shape(message, config, path, faults);
}

bool is_relative(const std::string& url) {
  return !url.empty() && url.find("://") == std::string::npos && url.front() != '/';
}

}  // namespace

SceneSpec scene_message(const Scene& scene) {
  SceneSpec message;
  write(scene, message, "");
  return message;
}

Scene scene_from(const SceneSpec& message, std::vector<Fault>& faults) {
  Scene scene;
  read(message, scene, "", faults);
  for (const auto& [path, url] : urls_of(scene))
    if (is_relative(*url))
      faults.push_back({Code::invalid_scene, path, given_text(*url), "give a file:// URL, a package:// URL or an absolute path: a goal has no directory of its own"});
  return scene;
}

std::vector<SceneFault> fault_messages(const std::vector<Fault>& faults) {
  std::vector<SceneFault> messages;
  for (const Fault& fault : faults) {
    SceneFault message;
    message.code = static_cast<int>(fault.code);
    message.field = fault.field;
    message.given = fault.given;
    message.remedy = fault.remedy;
    messages.push_back(message);
  }
  return messages;
}

void make_urls_absolute(Scene& scene) {
  for (const auto& [field, url] : urls_of(scene)) {
    if (!is_relative(*url)) continue;
    const std::filesystem::path path = std::filesystem::absolute(scene.base_directory) / *url;
    *url = "file://" + path.lexically_normal().string();
  }
}

}  // namespace forming_sim
