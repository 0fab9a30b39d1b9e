// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace limber::results::test {

/// Channels of 8 bits, a row after the other.
struct Pixels {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t channels = 0;  ///< 3: red, green, blue; 4: and opacity
  std::vector<std::uint8_t> values;
};

/// Of a PNG of 8-bit colours that is not interlaced; empty if it is none.
/// Source: PNG specification (ISO/IEC 15948), 9.2 and 11.2.
[[nodiscard]] Pixels read_png(const std::filesystem::path& file);

/// Fraction of pixels of which a channel differs by more than 8 [-]; 1 if sizes
/// differ.
[[nodiscard]] double find_different_fraction(const Pixels& a, const Pixels& b);

/// Fraction of pixels that are not white [-].
[[nodiscard]] double find_inked_fraction(const Pixels& pixels);

}  // namespace limber::results::test
