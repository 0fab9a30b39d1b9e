// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include "limber/fem/matrices/read_matrices.hpp"

namespace limber::fem::test {

/// tests/data/matrices/NAME
std::filesystem::path sample_folder(const std::string& name);

MatrixModel read_sample(const std::string& name);

/// The whole text of a file.
std::string read_text(const std::filesystem::path& file);

/// A copy of a sample in a new folder of its own.
std::filesystem::path copy_sample(const std::string& name);

/// Replaces a file's text.
void replace_text(const std::filesystem::path& file, const std::string& text);

/// The error of reading these, or empty if they are read.
std::string find_read_error(const std::filesystem::path& folder);

/// Row and column as node and component.
using EntryKey = std::tuple<std::size_t, int, std::size_t, int>;

/// Entries above zero by what they are, whatever the order of rows.
std::map<EntryKey, double> list_entries(const MatrixModel& model,
                                        const ModelMatrix& matrix);

/// Largest difference of entries over the largest entry.
double compare_entries(const std::map<EntryKey, double>& a,
                       const std::map<EntryKey, double>& b);

/// The six rigid motions (about the origin) of all rows of known kind.
MatrixX rigid_motions(const MatrixModel& model);

}  // namespace limber::fem::test
