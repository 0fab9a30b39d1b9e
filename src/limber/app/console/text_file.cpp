// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/text_file.hpp"

#include "limber/common/files/whole_file.hpp"

namespace limber::app {

void write_text(const std::filesystem::path& file, const std::string& text) {
  write_whole(file, text + '\n');
}

}  // namespace limber::app
