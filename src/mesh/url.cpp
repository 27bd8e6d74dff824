#include "forming_sim/mesh/url.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <vector>

namespace forming_sim {
namespace {

namespace fs = std::filesystem;

// Folders below a root of ROS_PACKAGE_PATH are searched this deep.
constexpr int kPackageDepth = 4;

bool starts_with(const std::string& text, const std::string& head) { return text.compare(0, head.size(), head) == 0; }

std::vector<std::string> paths_of(const char* variable) {
  std::vector<std::string> paths;
  const char* value = std::getenv(variable);
  std::istringstream in(value ? value : "");
  for (std::string path; std::getline(in, path, ':');)
    if (!path.empty()) paths.push_back(path);
  return paths;
}

bool is_package(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (fs::exists(folder / "CATKIN_IGNORE", ignored)) return false;
  std::ifstream manifest(folder / "package.xml");
  if (!manifest) return false;
  const std::string text{std::istreambuf_iterator<char>(manifest), {}};
  std::smatch found;
  static const std::regex name_tag("<name>\\s*([^<\\s]+)\\s*</name>");
  return std::regex_search(text, found, name_tag) && found[1] == name;
}

// The package below a root, as rospack finds it: not inside other packages,
// hidden folders, or what CATKIN_IGNORE marks.
fs::path find_below(const fs::path& root, const std::string& name) {
  if (is_package(root / name, name)) return root / name;
  if (is_package(root, name)) return root;
  std::error_code error;
  fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (!at->is_directory(ignored)) continue;
    if (is_package(at->path(), name)) return at->path();
    if (at.depth() + 1 >= kPackageDepth || at->path().filename().string()[0] == '.' ||
        fs::exists(at->path() / "package.xml", ignored) || fs::exists(at->path() / "CATKIN_IGNORE", ignored))
      at.disable_recursion_pending();
  }
  return {};
}

fs::path find_package(const std::string& name, const std::string& url, Code code) {
  std::string tried;
  for (const std::string& root : paths_of("ROS_PACKAGE_PATH")) {
    const fs::path found = find_below(root, name);
    if (!found.empty()) return found;
    tried += ", " + root;
  }
  for (const std::string& prefix : paths_of("CMAKE_PREFIX_PATH")) {
    const fs::path folder = fs::path(prefix) / "share" / name;
    if (is_package(folder, name)) return folder;
    tried += ", " + folder.string();
  }
  throw Error(code,
              "file \"" + url + "\": the package " + name + " was not found" +
                  (tried.empty() ? "; ROS_PACKAGE_PATH and CMAKE_PREFIX_PATH are empty: source the setup.bash of the workspace"
                                 : " (tried " + tried.substr(2) +
                                       "); check its name and the variables ROS_PACKAGE_PATH and CMAKE_PREFIX_PATH"));
}

std::string decode_percent(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(text[i + 2]))) {
      out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

/// Shells see to ~/, but not behind `file:=`, in a scene or a goal.
std::string from_home(const std::string& path) {
  const char* home = std::getenv("HOME");
  return home && starts_with(path, "~/") ? home + path.substr(1) : path;
}

fs::path path_of(const std::string& url, const std::string& base_directory, Code code) {
  if (const auto nul = url.find('\0'); nul != std::string::npos)
    throw Error(code, "file \"" + url.substr(0, nul) + "\": behind that the path has a NUL character; no file can");
  const auto scheme_end = url.find("://");
  if (scheme_end == std::string::npos) {
    const fs::path path(from_home(url));
    return path.is_absolute() ? path : fs::path(base_directory.empty() ? "." : base_directory) / path;
  }
  const std::string rest = url.substr(scheme_end + 3);
  if (starts_with(url, "file://")) {
    const std::string path = starts_with(rest, "localhost/") ? rest.substr(9) : rest;
    if (path.empty() || path[0] != '/')
      throw Error(code, "file \"" + url + "\": a file URL needs an absolute path, as in file:///folder/name.stl");
    return decode_percent(path);
  }
  if (starts_with(url, "package://")) {
    const auto slash = rest.find('/');
    if (slash == 0 || slash == std::string::npos || slash + 1 == rest.size())
      throw Error(code, "file \"" + url + "\": a package URL has the form package://NAME/PATH");
    return find_package(rest.substr(0, slash), url, code) / rest.substr(slash + 1);
  }
  throw Error(code, "file \"" + url + "\": the scheme " + url.substr(0, scheme_end) +
                                    ":// is not known; give a path, file:// or package://");
}

}  // namespace

std::string local_path(const std::string& given, Code code) { return given.empty() ? given : path_of(given, "", code).lexically_normal().string(); }

std::string resolve_url(const std::string& url, const std::string& base_directory) {
  if (url.empty()) throw Error(Code::mesh_error, "file \"\": the path is empty; give a path, file:// or package://");
  const fs::path path = path_of(url, base_directory, Code::mesh_error).lexically_normal();
  std::error_code error;
  if (fs::is_directory(path, error))
    throw Error(Code::mesh_error, "file \"" + url + "\": " + path.string() + " is a folder; name a file in it");
  if (!fs::exists(path, error))
    throw Error(Code::mesh_error, "file \"" + url + "\": there is no file " + fs::absolute(path, error).string());
  if (!fs::is_regular_file(path, error))
    throw Error(Code::mesh_error, "file \"" + url + "\": " + path.string() + " is not a regular file; name a mesh file");
  if (!std::ifstream(path))
    throw Error(Code::mesh_error, "file \"" + url + "\": " + path.string() + " cannot be opened for reading; check its permissions");
  return path.string();
}

}  // namespace forming_sim
