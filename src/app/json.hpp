// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/types.hpp"

namespace limber::app {

/// A JSON value; objects keep the order in which keys were added.
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;

  Json() : value_(nullptr) {}
  Json(bool value) : value_(value) {}                      // NOLINT
  Json(int value) : value_(double(value)) {}               // NOLINT
  Json(long value) : value_(double(value)) {}              // NOLINT
  Json(std::size_t value) : value_(double(value)) {}       // NOLINT
  Json(double value) : value_(value) {}                    // NOLINT
  Json(const char* value) : value_(std::string(value)) {}  // NOLINT
  Json(std::string value) : value_(std::move(value)) {}    // NOLINT
  Json(const VectorX& values);                             // NOLINT
  Json(const std::vector<double>& values);                 // NOLINT
  Json(const std::vector<std::string>& values);            // NOLINT

  [[nodiscard]] static Json array();
  [[nodiscard]] static Json object();
  [[nodiscard]] static Json matrix(const MatrixX& values);

  Json& add(const std::string& key, Json value);  ///< to an object
  Json& push(Json value);                         ///< to an array

  /// @param indent spaces a level; negative: all on one line.
  [[nodiscard]] std::string text(int indent = 2) const;
  /// The same for people: "key: value" lines, members indented.
  [[nodiscard]] std::string outline() const;

 private:
  void write_outline(std::string& out, int depth) const;
  void write(std::string& out, int indent, int depth) const;

  std::variant<std::nullptr_t, bool, double, std::string, Array, Object> value_;
};

}  // namespace limber::app
