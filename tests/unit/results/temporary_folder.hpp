// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "limber/common/errors.hpp"
#include "support/temporary_folder.hpp"

namespace limber::results::test {

using limber::test::TemporaryFolder;

inline std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Text of the InputError that `work` throws, or nothing.
template <typename Work>
std::string find_input_error(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace limber::results::test
