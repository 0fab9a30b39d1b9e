// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/text_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/whole_file.hpp"

namespace limber::app {

void write_text(const std::filesystem::path& file, const std::string& text) {
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream stream(part, std::ios::binary);
    if (!(stream << text << '\n') || !stream.flush()) {
      throw InputError(fmt::format("'{}' cannot be written; is the disk full?",
                                   file.string()));
    }
  });
}

}  // namespace limber::app
