// SPDX-License-Identifier: BSD-3-Clause
// What libFuzzer calls, with LIMBER_READER the name of one reader.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "fuzz/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace limber::fuzz;
  static const Reader& reader =
      *std::find_if(all_readers().begin(), all_readers().end(),
                    [](const Reader& r) { return r.name == LIMBER_READER; });
  takes(reader, {reinterpret_cast<const char*>(data), size});
  return 0;
}
