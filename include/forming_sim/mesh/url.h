#pragma once
// Where a file named in a scene lies.
#include <string>

namespace forming_sim {

/// Path of an existing file from a path (absolute, or relative to
/// `base_directory`), a file:// URL or package://NAME/PATH. The package NAME is
/// the folder with its package.xml found under ROS_PACKAGE_PATH, else
/// share/NAME under CMAKE_PREFIX_PATH.
/// Throws Error(mesh_error) naming every place that was tried.
std::string resolve_url(const std::string& url, const std::string& base_directory);

}  // namespace forming_sim
