// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limber/study/design.hpp"
#include "limber/study/responses.hpp"
#include "limber/study/study.hpp"

namespace limber::study {

/// One line of the table of runs.
struct StudyRow {
  std::size_t run = 0;  ///< from 0
  std::vector<std::string> factors;
  ResponseValues responses;
  std::string error;           ///< why it failed; empty: it did not
  std::string warnings;        ///< a line each
  double seconds = 0.0;        ///< wall time of its steps [s]
  double seconds_ready = 0.0;  ///< and before them, alone or waiting [s]
};

/// Identity of a file of results.
struct StudyRecord {
  Study study;
  std::string manifest;   ///< of study and scenario (study_manifest.hpp)
  std::size_t runs = 0;   ///< of the whole design
  std::size_t shard = 0;  ///< holds runs with run % shards == shard
  std::size_t shards = 1;
};

/// The results of a study, an SQLite file (docs/reference/studies.md). Rows
/// are written completely or not at all, even after kill -9.
class StudyFile {
 public:
  /// Creates the file, or continues one of the same study.
  /// @throws InputError if it belongs to another study, naming the differences;
  /// if another process writes it; if it is not such a file.
  StudyFile(const std::filesystem::path& file, const StudyRecord& record);
  /// Reads one.
  explicit StudyFile(const std::filesystem::path& file);
  StudyFile(const StudyFile&) = delete;
  StudyFile& operator=(const StudyFile&) = delete;
  ~StudyFile();

  [[nodiscard]] const StudyRecord& record() const { return record_; }
  /// In the order of runs.
  [[nodiscard]] std::vector<StudyRow> read_rows() const;
  /// Adds all rows or none. @throws InputError if the file cannot be written.
  void add(const std::vector<StudyRow>& rows);

 private:
  class Database;
  void create();
  void check(const StudyRecord& requested) const;
  StudyRecord read_record() const;

  std::filesystem::path file_;
  int lock_ = -1;
  std::unique_ptr<Database> database_;
  StudyRecord record_;
};

}  // namespace limber::study
