// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/page_arrays.hpp"

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::view {

template <typename T>
nlohmann::json PageArrays::add_array(const T* values, std::size_t count,
                                     const char* type) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + count * sizeof(T));
  const auto* source = reinterpret_cast<const char*>(values);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t b = 0; b < sizeof(T); ++b) {
      bytes_[at + b * count + i] = source[i * sizeof(T) + b];
    }
  }
  return {{"at", at}, {"count", count}, {"type", type}};
}

nlohmann::json PageArrays::add(const MatrixX& values) {
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      rows = values.cast<float>();
  return add_array(rows.data(), static_cast<std::size_t>(rows.size()), "f32");
}

nlohmann::json PageArrays::add_doubles(const VectorX& values) {
  return add_array(values.data(), static_cast<std::size_t>(values.size()),
                   "f64");
}

nlohmann::json PageArrays::add(const std::vector<std::int16_t>& values) {
  return add_array(values.data(), values.size(), "i16");
}

nlohmann::json PageArrays::add(const std::vector<std::uint32_t>& values) {
  return add_array(values.data(), values.size(), "u32");
}

Quantised quantise(const VectorX& values) {
  constexpr double kMost = 32767.0;
  Quantised result;
  result.integers.resize(static_cast<std::size_t>(values.size()), 0);
  const double largest =
      values.size() == 0 ? 0.0 : values.cwiseAbs().maxCoeff();
  // Below this, steps have too few bits.
  if (largest < std::numeric_limits<double>::min()) return result;
  // The page's factor is a double as well.
  result.scale = largest / kMost;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    result.integers[static_cast<std::size_t>(i)] =
        static_cast<std::int16_t>(std::lround(values[i] / result.scale));
  }
  return result;
}

std::string encode_base64(const std::string& bytes) {
  constexpr const char* kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_there = i + k < bytes.size();
      group = group << 8 |
              (is_there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_there = k < 2 || i + k - 1 < bytes.size();
      text += is_there ? kLetters[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace limber::view
