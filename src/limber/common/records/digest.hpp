// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "limber/common/types.hpp"

namespace limber {

/// A 128-bit digest (XXH3) of a sequence of values. Texts and lists are
/// preceded by their length, so that different sequences never coincide.
class Digest {
 public:
  Digest();
  Digest(const Digest& other);
  Digest(Digest&& other) noexcept;
  Digest& operator=(const Digest&) = delete;
  Digest& operator=(Digest&& other) noexcept;
  ~Digest();

  void add_bytes(const void* data, std::size_t size);

  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(const T& value) { add_bytes(&value, sizeof(value)); }
  void add(const std::string& text);
  void add(const Vector3& v);
  void add(const MatrixX& values);
  void add(const std::vector<double>& values);

  /// 32 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limber
