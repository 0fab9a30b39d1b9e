// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::scene {

/// Collects the problems of one file, to report them together.
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  /// A problem at `line` (0: no line in particular).
  void add(int line, const std::string& text) {
    texts_.push_back(locate(line, text));
  }
  void add(const InputError& error, int line) {
    for (const std::string& text : error.problems()) add(line, text);
  }
  /// "FILE:LINE: TEXT", as the error of `add` has it.
  [[nodiscard]] std::string locate(int line, const std::string& text) const {
    const std::string place = line > 0 ? ":" + std::to_string(line) : "";
    return file_ + place + ": " + text;
  }
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] bool empty() const { return texts_.empty(); }
  /// @throws InputError if there was any problem.
  void raise() const {
    if (!texts_.empty()) throw InputError(texts_);
  }

 private:
  std::string file_;
  std::vector<std::string> texts_;
};

}  // namespace limber::scene
