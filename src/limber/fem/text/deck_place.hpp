// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {

/// A line of a deck, for messages. Its file's path outlives it.
class DeckPlace {
 public:
  /// The line that is being read.
  DeckPlace(const TextScanner& at)  // NOLINT: a scanner is at a place
      : DeckPlace(at.file(), at.number()) {}
  DeckPlace(const std::filesystem::path& file, std::size_t number)
      : file_(&file), number_(number) {}

  [[nodiscard]] const std::filesystem::path& file() const { return *file_; }
  [[nodiscard]] std::size_t number() const { return number_; }  ///< from 1
  [[nodiscard]] std::string text() const;                       ///< "file:line"
  /// @throws InputError "file:line: what"
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const std::filesystem::path* file_;
  std::size_t number_;
};

}  // namespace limber::fem
