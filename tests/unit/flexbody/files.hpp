// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "limber/common/errors.hpp"
#include "support/temporary_folder.hpp"

namespace limber::flexbody::test {

using limber::test::TemporaryFolder;

inline std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::filesystem::path& file,
                        const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// Text of the InputError that `work` throws; empty if it throws none.
template <typename Work>
std::string find_input_error(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace limber::flexbody::test
