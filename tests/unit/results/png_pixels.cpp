// SPDX-License-Identifier: BSD-3-Clause
#include "png_pixels.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "temporary_folder.hpp"

namespace limber::results::test {
namespace {

std::uint32_t read_number(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  }
  return value;
}

std::string join_data(const std::string& bytes) {
  std::string data;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = read_number(bytes, at);
    if (bytes.compare(at + 4, 4, "IDAT") == 0) {
      data += bytes.substr(at + 8, length);
    }
    at += length + 12;
  }
  return data;
}

int predict(int type, int left, int up, int corner) {
  if (type == 1) return left;
  if (type == 2) return up;
  if (type == 3) return (left + up) / 2;
  if (type != 4) return 0;
  const int guess = left + up - corner;
  const int to_left = std::abs(guess - left);
  const int to_up = std::abs(guess - up);
  const int to_corner = std::abs(guess - corner);
  if (to_left <= to_up && to_left <= to_corner) return left;
  return to_up <= to_corner ? up : corner;
}

void undo_filters(const std::vector<std::uint8_t>& raw, Pixels& pixels) {
  const std::size_t stride = pixels.width * pixels.channels;
  pixels.values.resize(pixels.height * stride);
  for (std::size_t y = 0; y < pixels.height; ++y) {
    const std::uint8_t* line = raw.data() + y * (stride + 1);
    std::uint8_t* now = pixels.values.data() + y * stride;
    for (std::size_t x = 0; x < stride; ++x) {
      const bool has_left = x >= pixels.channels;
      const int left = has_left ? now[x - pixels.channels] : 0;
      const int up = y > 0 ? *(now + x - stride) : 0;
      const int corner =
          has_left && y > 0 ? *(now + x - stride - pixels.channels) : 0;
      now[x] = static_cast<std::uint8_t>(line[x + 1] +
                                         predict(line[0], left, up, corner));
    }
  }
}

}  // namespace

Pixels read_png(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  if (bytes.size() < 33 || bytes.compare(1, 3, "PNG") != 0) return {};
  const int colours = bytes[25];
  if (bytes[24] != 8 || (colours != 2 && colours != 6) || bytes[28] != 0) {
    return {};
  }
  Pixels pixels{read_number(bytes, 16),
                read_number(bytes, 20),
                colours == 2 ? std::size_t{3} : std::size_t{4},
                {}};
  const std::string data = join_data(bytes);
  std::vector<std::uint8_t> raw(pixels.height *
                                (pixels.width * pixels.channels + 1));
  uLongf size = raw.size();
  const auto* source = reinterpret_cast<const Bytef*>(data.data());
  if (uncompress(raw.data(), &size, source, data.size()) != Z_OK) return {};
  undo_filters(raw, pixels);
  return pixels;
}

double find_different_fraction(const Pixels& a, const Pixels& b) {
  if (a.values.size() != b.values.size() || a.width != b.width) return 1.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.values.size(); i += a.channels) {
    for (std::size_t c = 0; c < a.channels; ++c) {
      if (std::abs(a.values[i + c] - b.values[i + c]) <= 8) continue;
      ++count;
      break;
    }
  }
  return double(count) / double(a.width * a.height);
}

double find_inked_fraction(const Pixels& pixels) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels.values.size(); i += pixels.channels) {
    const auto* pixel = pixels.values.data() + i;
    if (std::any_of(pixel, pixel + 3, [](auto c) { return c < 250; })) ++count;
  }
  return double(count) / double(pixels.width * pixels.height);
}

}  // namespace limber::results::test
