// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {

/// *NAME, PARAMETER=VALUE, ... of an input file of Abaqus or CalculiX: all in
/// upper case but names of files.
struct Keyword {
  std::string name;
  std::map<std::string, std::string> parameters;
  std::map<std::string, std::string> spelled = {};  ///< as the file has them

  [[nodiscard]] bool has(const std::string& key) const {
    return parameters.contains(key);
  }
  /// Empty without it.
  [[nodiscard]] std::string get(const std::string& key) const;
};

/// What is done with an input file's lines.
struct DeckReading {
  /// @returns whether to read the file of an INPUT parameter: its data lines,
  /// or keywords of its own, as of *INCLUDE
  std::function<bool(const TextScanner& at, const Keyword& keyword)> begin;
  std::function<void(const TextScanner& at, std::string_view line)> add_data;
};

/// Reads an input file and those that it includes, without its comments.
/// Source: CalculiX 2.20 User's Manual, ch. 7; Abaqus Keywords Reference Guide
/// @throws InputError with file and line
void read_keyword_deck(const std::filesystem::path& file,
                       const DeckReading& reading);

}  // namespace limber::fem
