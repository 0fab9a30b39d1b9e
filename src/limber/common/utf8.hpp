// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace limber {

/// Length of the UTF-8 character that begins at byte `at`, or 0 if none does
/// [bytes].
///
/// Source   Unicode 15.0, table 3-7, "Well-Formed UTF-8 Byte Sequences"
[[nodiscard]] std::size_t measure_utf8(std::string_view text, std::size_t at);

/// Whether the whole text is UTF-8, as JSON, XML and HDF5's texts require.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace limber
