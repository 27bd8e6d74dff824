#pragma once
// Where a file named in a scene lies.
#include <string>

#include "forming_sim/config/fault.h"

namespace forming_sim {

/// The path of what need not exist: of a path, where ~/ is the home directory, a file:// URL or package://NAME/PATH. Empty: empty.
/// Throws Error(code): another scheme, a package that is not found, a NUL character.
std::string local_path(const std::string& given, Code code);

/// Path of an existing file from a path (absolute, in the home directory with ~/, or relative to
/// `base_directory`), a file:// URL or package://NAME/PATH. The package NAME is
/// the folder with its package.xml found under ROS_PACKAGE_PATH, else
/// share/NAME under CMAKE_PREFIX_PATH.
/// Throws Error(mesh_error) naming every place that was tried.
std::string resolve_url(const std::string& url, const std::string& base_directory);

}  // namespace forming_sim
