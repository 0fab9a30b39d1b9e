// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The readers of users' files, as functions of bytes. For any bytes a reader
/// succeeds or throws InputError; anything else is a finding.
namespace limber::fuzz {

struct Reader {
  std::string name;  ///< of its folder in tests/fuzz/corpus
  /// @throws InputError for invalid input.
  void (*read)(std::string_view bytes);
};

[[nodiscard]] const std::vector<Reader>& all_readers();

/// Reads `bytes` and returns whether they were accepted (true) or rejected by
/// an InputError. Other exceptions propagate.
bool takes(const Reader& reader, std::string_view bytes);

}  // namespace limber::fuzz
