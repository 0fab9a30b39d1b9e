// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/deck_name.hpp"

#include "limber/common/upper_case.hpp"

namespace limber {

bool has_deck_name(const std::filesystem::path& file) {
  const std::string extension = to_upper(file.extension().string());
  return extension == ".BDF" || extension == ".NAS" || extension == ".DAT" ||
         extension == ".INP";
}

}  // namespace limber
