// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/flat_body.hpp"

#include <fstream>

#include "limber/common/files/hdf5_flatten.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/body_seal.hpp"

namespace limber::flexbody {
namespace {

std::string read_seal(const std::filesystem::path& file) {
  std::string seal(kBodySealSize, '\0');
  std::ifstream(file, std::ios::binary)
      .read(seal.data(), static_cast<std::streamsize>(seal.size()));
  return seal;
}

}  // namespace

void write_flat_body(const ReducedBody& body,
                     const std::filesystem::path& file) {
  write_body(body, file);
  FlatFile flat = flatten_hdf5(file);
  flat.user_block = read_seal(file);
  write_flat(file, flat);
  seal_body_file(file);
}

}  // namespace limber::flexbody
