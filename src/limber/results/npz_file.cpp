// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/npz_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/utf8.hpp"

namespace limber::results {
namespace {

/// Little-endian.
template <typename Number>
void put(std::string& out, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    out += static_cast<char>((number >> (8 * i)) & 0xFF);
  }
}

std::string bytes_of(const double* values, Eigen::Index count) {
  std::string bytes(static_cast<std::size_t>(count) * sizeof(double), '\0');
  if (count > 0) std::memcpy(bytes.data(), values, bytes.size());
  return bytes;
}

/// Code points of UTF-8; an invalid byte becomes the replacement character.
std::vector<std::uint32_t> decode(const std::string& text) {
  constexpr std::uint32_t kUnknown = 0xFFFD;
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = measure_utf8(text, i);
    const auto lead = static_cast<unsigned char>(text[i++]);
    std::uint32_t point = size == 1 ? lead : lead & (0x7FU >> size);
    for (std::size_t k = 1; k < size; ++k) {
      point = point << 6 | (text[i++] & 0x3FU);
    }
    points.push_back(size > 0 ? point : kUnknown);
  }
  return points;
}

/// Fields of a member that the entry and the directory share.
void put_entry(std::string& out, const std::string& name,
               const std::string& data) {
  constexpr std::uint16_t kVersion = 20;
  constexpr std::uint16_t kFirstDate = 33;  // 1 January 1980
  const auto size = static_cast<std::uint32_t>(data.size());
  const auto check = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(data.data()), size));
  put(out, kVersion);
  put(out, std::uint16_t{0});  // flags
  put(out, std::uint16_t{0});  // not compressed
  put(out, std::uint16_t{0});  // time
  put(out, kFirstDate);
  put(out, check);
  put(out, size);
  put(out, size);
  put(out, static_cast<std::uint16_t>(name.size()));
  put(out, std::uint16_t{0});  // nothing beside the name
}

}  // namespace

void NpzFile::add_array(const std::string& name, const std::string& type,
                        const std::string& shape, std::string data) {
  std::string header = fmt::format(
      "{{'descr': '{}', 'fortran_order': True, 'shape': {}, }}", type, shape);
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kBefore = 10;
  while ((kBefore + header.size() + 1) % kAlignment != 0) header += ' ';
  header += '\n';
  std::string member("\x93NUMPY\x01\x00", 8);
  put(member, static_cast<std::uint16_t>(header.size()));
  members_.push_back({name + ".npy", member + header + std::move(data)});
}

void NpzFile::add(const std::string& name, const MatrixX& matrix) {
  add_array(name, "<f8", fmt::format("({}, {})", matrix.rows(), matrix.cols()),
            bytes_of(matrix.data(), matrix.size()));
}

void NpzFile::add(const std::string& name,
                  const std::vector<std::string>& texts) {
  std::vector<std::vector<std::uint32_t>> all;
  std::size_t width = 1;
  for (const std::string& text : texts) {
    all.push_back(decode(text));
    width = std::max(width, all.back().size());
  }
  std::string data;
  for (auto& points : all) {
    points.resize(width, 0);
    for (const std::uint32_t point : points) put(data, point);
  }
  add_array(name, fmt::format("<U{}", width),
            fmt::format("({},)", texts.size()), std::move(data));
}

std::string NpzFile::bytes() const {
  std::string out;
  std::string directory;
  for (const Member& member : members_) {
    LIMBER_EXPECT(out.size() + member.data.size() <
                  std::numeric_limits<std::uint32_t>::max());
    put(directory, std::uint32_t{0x02014b50});
    put(directory, std::uint16_t{20});
    put_entry(directory, member.name, member.data);
    put(directory, std::uint16_t{0});  // comment
    put(directory, std::uint16_t{0});  // disk
    put(directory, std::uint16_t{0});  // attributes
    put(directory, std::uint32_t{0});
    put(directory, static_cast<std::uint32_t>(out.size()));
    directory += member.name;
    put(out, std::uint32_t{0x04034b50});
    put_entry(out, member.name, member.data);
    out += member.name + member.data;
  }
  const auto count = static_cast<std::uint16_t>(members_.size());
  const auto start = static_cast<std::uint32_t>(out.size());
  out += directory;
  put(out, std::uint32_t{0x06054b50});
  put(out, std::uint32_t{0});  // disks
  put(out, count);
  put(out, count);
  put(out, static_cast<std::uint32_t>(directory.size()));
  put(out, start);
  put(out, std::uint16_t{0});  // comment
  return out;
}

}  // namespace limber::results
