// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace limber::view {

/// A slider of a playground, or a choice.
struct PlayControl {
  std::string label;
  std::string path;  ///< as runs::parse_play_settings takes it
  /// The path without the index at its end: all components are set as one, as
  /// the file may have none. Empty: a value of its own.
  std::string vector = {};
  std::string unit = {};
  double value = 0.0, least = 0.0, most = 0.0;  ///< of a slider [`unit`]
  std::vector<std::string> choices = {};        ///< of a choice
  std::string choice = {};                      ///< its value
  bool is_whole = false;                        ///< takes whole numbers alone
};

/// A scene that a page simulates itself.
struct Playground {
  std::string name;
  std::string scenario;               ///< its path among `files`
  bool has_rigid = false;             ///< whether a rigid ghost is informative
  std::vector<std::string> settings;  ///< PATH=VALUE, always
  std::map<std::string, std::string> files;   ///< contents by path
  std::map<std::string, std::string> bodies;  ///< paths among them by link
  std::vector<PlayControl> controls;
};

/// Checks that the module and the page are there, and that the module is of the
/// same sources as this command.
/// @throws InputError naming what is not, and how to get it.
void find_playground();

/// Writes one HTML file that simulates a scene in a browser's worker, without a
/// network: the dynamics as WebAssembly (scripts/playground), in the page of
/// write_page.
/// @throws InputError as find_playground, or if the file cannot be written.
void write_play_page(const std::filesystem::path& file,
                     const Playground& playground);

}  // namespace limber::view
