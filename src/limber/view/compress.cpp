// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/compress.hpp"

#include <zlib.h>

#include "limber/common/errors.hpp"

namespace limber::view {

std::string compress(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  LIMBER_EXPECT(status == Z_OK);
  packed.resize(size);
  return packed;
}

}  // namespace limber::view
