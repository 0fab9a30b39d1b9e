// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/fem/text/deck_place.hpp"
#include "limber/fem/text/keyword_deck.hpp"

namespace limber::fem {

/// What is done with a flat deck's lines.
struct FlatReading {
  /// @param pose of the instance that the keyword is in
  /// @returns as DeckReading::begin
  std::function<bool(const DeckPlace& at, const Keyword& keyword,
                     const Pose& pose)>
      begin;
  std::function<void(const DeckPlace& at, std::string_view line)> add_data;
};

/// Reads an input file of Abaqus or CalculiX with the content of its parts in
/// place of their instances: nodes moved, sets, surfaces and orientations
/// called INSTANCE.NAME where there are several instances.
///
/// Numbers of nodes and elements of the first instance stay. A power of ten
/// above all numbers of the parts is added to those of the second, twice of it
/// to those of the third, and so on; that for one instance more to those of the
/// assembly, outside of instances. A number without an instance there is one of
/// the assembly's, or, of a single instance, one of its.
/// Source: Abaqus Keywords Reference Guide, *INSTANCE; Abaqus User's Guide,
/// "Assembly definition"
/// @returns what was added to numbers, as notices
/// @throws InputError with file and line
std::vector<std::string> read_flat_deck(const std::filesystem::path& file,
                                        const FlatReading& reading);

}  // namespace limber::fem
