// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::view {

/// Collects arrays of numbers; each is stored once and referred to by JSON.
class PageArrays {
 public:
  /// Row-major, in single precision.
  [[nodiscard]] nlohmann::json add(const MatrixX& values);
  [[nodiscard]] nlohmann::json add_doubles(const VectorX& values);
  [[nodiscard]] nlohmann::json add(const std::vector<std::int16_t>& values);
  [[nodiscard]] nlohmann::json add(const std::vector<std::uint32_t>& values);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  nlohmann::json add_array(const T* values, std::size_t count,
                           const char* type);

  std::string bytes_;
};

/// Numbers as 16-bit integers.
struct Quantised {
  double scale = 0.0;                  ///< [unit of the values]
  std::vector<std::int16_t> integers;  ///< values / scale, rounded
};
/// @param values finite; if all are below 2.3e-308, zeros without a scale
[[nodiscard]] Quantised quantise(const VectorX& values);

/// RFC 4648.
[[nodiscard]] std::string encode_base64(const std::string& bytes);

}  // namespace limber::view
