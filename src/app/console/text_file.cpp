// SPDX-License-Identifier: BSD-3-Clause
#include "app/text_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "common/errors.hpp"
#include "common/whole_file.hpp"

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
