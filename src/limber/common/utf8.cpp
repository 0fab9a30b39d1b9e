// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/utf8.hpp"

namespace limber {
namespace {

// Bytes after the first, and the range of the second of them.
struct Tail {
  std::size_t length = 0;
  unsigned char least = 0x80;
  unsigned char most = 0xbf;
};

// `length` is 0 also for a byte that begins no character of several.
Tail find_tail(unsigned char lead) {
  if (lead < 0xc2 || lead > 0xf4) return {};
  if (lead < 0xe0) return {1};
  if (lead == 0xe0) return {2, 0xa0};        // shorter in two
  if (lead == 0xed) return {2, 0x80, 0x9f};  // no surrogates
  if (lead < 0xf0) return {2};
  if (lead == 0xf0) return {3, 0x90};        // shorter in three
  if (lead == 0xf4) return {3, 0x80, 0x8f};  // up to U+10FFFF
  return {3};
}

}  // namespace

std::size_t measure_utf8(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned char>(text[at + i]);
  };
  if (byte(0) < 0x80) return 1;
  const Tail tail = find_tail(byte(0));
  if (tail.length == 0 || at + tail.length >= text.size()) return 0;
  if (byte(1) < tail.least || byte(1) > tail.most) return 0;
  for (std::size_t i = 2; i <= tail.length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
  }
  return 1 + tail.length;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = measure_utf8(text, at);
    if (size == 0) return false;
    at += size;
  }
  return true;
}

}  // namespace limber
