// SPDX-License-Identifier: BSD-3-Clause
#include "app/text_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "common/errors.hpp"

namespace limber::app {

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text << '\n') || !stream.flush()) {
    throw InputError(fmt::format("'{}' cannot be written; is the disk full?",
                                 file.string()));
  }
}

}  // namespace limber::app
