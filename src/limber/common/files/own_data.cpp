// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/own_data.hpp"

#include <system_error>

#include "limber/common/files/own_file.hpp"

namespace limber {

std::array<std::filesystem::path, 3> list_data_places(const std::string& name) {
  const std::filesystem::path folder = find_own_file().parent_path();
  return {folder / name, folder.parent_path() / "share/limber" / name,
          std::filesystem::path(LIMBER_DATA_DIR) / name};
}

std::filesystem::path find_own_data(const std::string& name) {
  std::error_code unknown;
  for (const std::filesystem::path& place : list_data_places(name)) {
    if (std::filesystem::exists(place, unknown)) return place;
  }
  return {};
}

}  // namespace limber
