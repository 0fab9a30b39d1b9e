// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/drawing/png_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/whole_file.hpp"

namespace limber::results {
namespace {

const Bytef* to_zlib(const std::string& bytes) {
  return reinterpret_cast<const Bytef*>(bytes.data());
}

std::string to_big_endian(std::uint32_t number) {
  std::string bytes;
  for (unsigned shift = 32; shift > 0;) {
    shift -= 8;
    bytes += static_cast<char>(number >> shift & 0xffU);
  }
  return bytes;
}

// Length, type, data and check sum.
std::string make_chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto sum =
      crc32(0, to_zlib(checked), static_cast<uInt>(checked.size()));
  return to_big_endian(static_cast<std::uint32_t>(data.size())) + checked +
         to_big_endian(static_cast<std::uint32_t>(sum));
}

// zlib's format.
std::string deflate_all(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int status = compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                              to_zlib(bytes), static_cast<uLong>(bytes.size()));
  LIMBER_EXPECT(status == Z_OK);
  packed.resize(size);
  return packed;
}

std::string make_png(const Canvas& canvas) {
  const std::vector<std::uint8_t> pixels = canvas.find_pixels();
  const std::size_t row = 3 * static_cast<std::size_t>(canvas.width());
  std::string lines;
  for (std::size_t first = 0; first < pixels.size(); first += row) {
    lines += '\0';  // no filter
    lines.append(reinterpret_cast<const char*>(&pixels[first]), row);
  }
  const std::string header =
      to_big_endian(static_cast<std::uint32_t>(canvas.width())) +
      to_big_endian(static_cast<std::uint32_t>(canvas.height())) +
      std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits a colour, RGB
  return "\x89PNG\r\n\x1a\n" + make_chunk("IHDR", header) +
         make_chunk("IDAT", deflate_all(lines)) + make_chunk("IEND", "");
}

}  // namespace

void write_png(const std::filesystem::path& file, const Canvas& canvas) {
  write_whole(file, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary);
    out << make_png(canvas);
    out.flush();
    if (out) return;
    throw InputError(
        fmt::format("'{}' cannot be written; does its folder exist, and is "
                    "there free space?",
                    file.string()));
  });
}

}  // namespace limber::results
