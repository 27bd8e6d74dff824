#pragma once
// Where a file named in a scene lies.
#include <string>

namespace forming_sim {

/// A path that begins with ~/ begins in the home directory: shells see to that, but not behind `file:=`, in a scene or a goal.
std::string from_home(const std::string& path);

/// Path of an existing file from a path (absolute, from_home(), or relative to
/// `base_directory`), a file:// URL or package://NAME/PATH. The package NAME is
/// the folder with its package.xml found under ROS_PACKAGE_PATH, else
/// share/NAME under CMAKE_PREFIX_PATH.
/// Throws Error(mesh_error) naming every place that was tried.
std::string resolve_url(const std::string& url, const std::string& base_directory);

}  // namespace forming_sim
