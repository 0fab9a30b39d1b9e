// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The readers of users' files, as functions of bytes. Whatever the bytes, a
/// reader answers or throws InputError; anything else is a finding.
namespace limber::fuzz {

struct Reader {
  std::string name;  ///< of its folder in tests/fuzz/corpus
  /// @throws InputError for what it refuses.
  void (*read)(std::string_view bytes);
};

[[nodiscard]] const std::vector<Reader>& all_readers();

/// Reads `bytes` and answers whether they were taken (true) or refused by an
/// InputError. Every other exception passes through.
bool takes(const Reader& reader, std::string_view bytes);

}  // namespace limber::fuzz
