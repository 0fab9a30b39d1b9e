// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/package_paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <vector>

namespace limber::scene {
namespace {

using Folder = std::filesystem::path;

bool is_there(const Folder& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown);
}

/// A folder and those above it.
std::vector<Folder> list_above(const Folder& folder) {
  std::vector<Folder> all;
  Folder at = std::filesystem::absolute(folder.empty() ? "." : folder);
  for (; at.has_relative_path(); at = at.parent_path()) all.push_back(at);
  all.push_back(at);
  return all;
}

/// The folders in a folder, in the order of their names.
std::vector<Folder> list_inner(const Folder& folder) {
  std::vector<Folder> all;
  std::error_code unknown;
  for (const auto& entry :
       std::filesystem::directory_iterator(folder, unknown)) {
    if (entry.is_directory(unknown)) all.push_back(entry.path());
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<Folder> list_environment() {
  std::vector<Folder> all;
  for (const char* variable : {"LIMBER_PACKAGE_PATH", "ROS_PACKAGE_PATH"}) {
    const char* value = std::getenv(variable);
    std::istringstream folders(value == nullptr ? "" : value);
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (!folder.empty()) all.emplace_back(folder);
    }
  }
  return all;
}

/// The file in a package that is the folder, in it or one level deeper.
Folder find_around(const Folder& folder, const std::string& package,
                   const Folder& inner) {
  if (folder.filename() == package && is_there(folder / inner)) {
    return folder / inner;
  }
  if (is_there(folder / package / inner)) return folder / package / inner;
  for (const Folder& deeper : list_inner(folder)) {
    if (is_there(deeper / package / inner)) return deeper / package / inner;
  }
  return {};
}

}  // namespace

std::filesystem::path find_in_package(const std::string& name,
                                      const std::filesystem::path& folder,
                                      const RobotOptions& options) {
  const std::size_t slash = name.find('/');
  const std::string package = name.substr(0, slash);
  const Folder inner = slash == std::string::npos ? "" : name.substr(slash + 1);
  const auto given = options.packages.find(package);
  if (given != options.packages.end()) {
    const Folder file = std::filesystem::absolute(given->second / inner);
    return is_there(file) ? file : Folder();
  }
  for (const Folder& above : list_above(folder)) {
    if (is_there(above / package / inner)) return above / package / inner;
  }
  for (const Folder& listed : list_environment()) {
    const Folder file = find_around(listed, package, inner);
    if (!file.empty()) return std::filesystem::absolute(file);
  }
  return {};
}

}  // namespace limber::scene
