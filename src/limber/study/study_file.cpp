// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/study_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <map>

#include "limber/common/errors.hpp"
#include "limber/common/records/digest.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/study/study_reader.hpp"

namespace limber::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLayout = "2";

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(
      fmt::format("results of a study '{}': {}", file.string(), why));
}

std::string quote_name(const std::string& name) { return "\"" + name + "\""; }

std::vector<std::string> list_columns(const Study& study) {
  std::vector<std::string> columns = {"run"};
  for (const Factor& factor : study.factors) columns.push_back(factor.name);
  for (const Response& one : study.responses) columns.push_back(one.name);
  columns.emplace_back("error");
  columns.emplace_back("warnings");
  columns.emplace_back("digest");
  return columns;
}

/// Digest of all values that are read back; factors are those of the design.
std::string digest_of(const StudyRow& row) {
  Digest digest;
  digest.add(row.run);
  for (const std::optional<double>& response : row.responses) {
    digest.add(response.has_value());
    digest.add(response.value_or(0.0) + 0.0);  // SQLite has no -0
  }
  digest.add(row.error);
  digest.add(row.warnings);
  return digest.text();
}

}  // namespace

/// A connection, and statements that throw on failure.
class StudyFile::Database {
 public:
  Database(const fs::path& file, bool writes) : file_(file) {
    const int flags = writes ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                             : SQLITE_OPEN_READONLY;
    const int error = sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr);
    if (error != SQLITE_OK) fail();
    sqlite3_busy_timeout(handle_, 10'000);
  }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database() { sqlite3_close(handle_); }

  [[noreturn]] void fail() const { refuse(file_, sqlite3_errmsg(handle_)); }

  void run(const std::string& sql) const {
    if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) !=
        SQLITE_OK) {
      fail();
    }
  }

  /// Without tables, after what was not committed is undone.
  [[nodiscard]] bool is_empty() const {
    Statement count(*this, "SELECT count(*) FROM sqlite_master");
    (void)count.step();
    return count.whole(0) == 0;
  }

  class Statement {
   public:
    Statement(const Database& database, const std::string& sql)
        : database_(database) {
      if (sqlite3_prepare_v2(database.handle_, sql.c_str(), -1, &handle_,
                             nullptr) != SQLITE_OK) {
        database.fail();
      }
    }
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;
    ~Statement() { sqlite3_finalize(handle_); }

    void bind(int i, const std::string& text) {
      sqlite3_bind_text(handle_, i, text.c_str(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT);
    }
    void bind(int i, double value) { sqlite3_bind_double(handle_, i, value); }
    void bind(int i, const std::optional<double>& value) {
      value ? bind(i, *value) : bind_nothing(i);
    }
    /// Not an overload: it would truncate a number that is not a count.
    void bind_count(int i, std::size_t value) {
      sqlite3_bind_int64(handle_, i, static_cast<sqlite3_int64>(value));
    }
    void bind_nothing(int i) { sqlite3_bind_null(handle_, i); }
    /// A factor's value: a number as such.
    void bind_value(int i, const std::string& text) {
      const char* const end = text.data() + text.size();
      double number = 0.0;
      const auto [stop, error] = std::from_chars(text.data(), end, number);
      if (error == std::errc() && stop == end) return bind(i, number);
      bind(i, text);
    }
    /// Nothing if there are none.
    void bind_words(int i, const std::string& text) {
      text.empty() ? bind_nothing(i) : bind(i, text);
    }
    /// Whether there is a row.
    bool step() {
      const int result = sqlite3_step(handle_);
      if (result != SQLITE_ROW && result != SQLITE_DONE) database_.fail();
      return result == SQLITE_ROW;
    }
    void reset() { sqlite3_reset(handle_); }
    [[nodiscard]] std::string text(int i) const {
      const auto* bytes = sqlite3_column_text(handle_, i);
      return bytes == nullptr
                 ? ""
                 : std::string(reinterpret_cast<const char*>(bytes));
    }
    [[nodiscard]] std::size_t whole(int i) const {
      return static_cast<std::size_t>(sqlite3_column_int64(handle_, i));
    }
    [[nodiscard]] std::optional<double> number(int i) const {
      if (sqlite3_column_type(handle_, i) == SQLITE_NULL) return std::nullopt;
      return sqlite3_column_double(handle_, i);
    }

   private:
    const Database& database_;
    sqlite3_stmt* handle_ = nullptr;
  };

 private:
  fs::path file_;
  sqlite3* handle_ = nullptr;
};

StudyFile::StudyFile(const fs::path& file, const StudyRecord& record)
    : file_(file), record_(record) {
  lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) refuse(file, std::strerror(errno));
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(lock_);
    refuse(file, "another process writes it now");
  }
  try {
    database_ = std::make_unique<Database>(file, true);
    database_->run("PRAGMA synchronous = NORMAL");
    // A process that was killed while it made the tables leaves none.
    database_->is_empty() ? create() : check(record);
  } catch (...) {
    database_.reset();
    close(lock_);
    throw;
  }
}

StudyFile::StudyFile(const fs::path& file) : file_(file) {
  if (!fs::is_regular_file(file)) refuse(file, "there is no such file");
  database_ = std::make_unique<Database>(file, false);
  record_ = read_record();
}

StudyFile::~StudyFile() {
  database_.reset();
  if (lock_ >= 0) close(lock_);
}

void StudyFile::create() {
  std::string columns = "run INTEGER PRIMARY KEY";
  for (const Factor& factor : record_.study.factors) {
    columns += ", " + quote_name(factor.name);
  }
  for (const Response& response : record_.study.responses) {
    columns += ", " + quote_name(response.name) + " REAL";
  }
  database_->run("BEGIN EXCLUSIVE");
  database_->run("CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT)");
  database_->run(fmt::format(
      "CREATE TABLE runs ({}, error TEXT, warnings TEXT, digest TEXT)",
      columns));
  database_->run(
      "CREATE TABLE timing (run INTEGER PRIMARY KEY, ready REAL, steps REAL)");
  Database::Statement insert(*database_, "INSERT INTO study VALUES (?, ?)");
  const std::vector<std::pair<std::string, std::string>> values = {
      {"layout", kLayout},
      {"file", record_.study.file.string()},
      {"text", record_.study.text},
      {"manifest", record_.manifest},
      {"runs", std::to_string(record_.runs)},
      {"shard", std::to_string(record_.shard)},
      {"shards", std::to_string(record_.shards)}};
  for (const auto& [key, value] : values) {
    insert.bind(1, key);
    insert.bind(2, value);
    (void)insert.step();
    insert.reset();
  }
  database_->run("COMMIT");
}

StudyRecord StudyFile::read_record() const {
  std::map<std::string, std::string> values;
  Database::Statement select(*database_, "SELECT key, value FROM study");
  while (select.step()) values[select.text(0)] = select.text(1);
  if (values["layout"] != kLayout) {
    refuse(file_, fmt::format("is of layout '{}'; this Limber reads {}",
                              values["layout"], kLayout));
  }
  StudyRecord record;
  record.study = read_study(values["text"], values["file"]);
  record.manifest = values["manifest"];
  record.runs = scene::to_index(values["runs"]).value_or(0);
  record.shard = scene::to_index(values["shard"]).value_or(0);
  record.shards = scene::to_index(values["shards"]).value_or(1);
  return record;
}

void StudyFile::check(const StudyRecord& requested) const {
  const StudyRecord own = read_record();
  std::vector<std::string> differences =
      find_differences(Manifest(own.manifest), Manifest(requested.manifest));
  if (own.shard != requested.shard || own.shards != requested.shards) {
    differences.push_back(fmt::format("shard: {}/{} -> {}/{}", own.shard + 1,
                                      own.shards, requested.shard + 1,
                                      requested.shards));
  }
  if (differences.empty()) return;
  constexpr std::size_t kMostListed = 5;
  const std::size_t count = differences.size();
  if (count > kMostListed) {
    differences.resize(kMostListed);
    differences.push_back(fmt::format("and {} more", count - kMostListed));
  }
  refuse(file_,
         fmt::format("belong to another study: {}; move the folder away, "
                     "choose another with --out, or restore the original input",
                     fmt::join(differences, "; ")));
}

std::vector<StudyRow> StudyFile::read_rows() const {
  const Study& study = record_.study;
  std::string names;
  for (const std::string& column : list_columns(study)) {
    names += (names.empty() ? "" : ", ") + ("runs." + quote_name(column));
  }
  Database::Statement select(
      *database_,
      fmt::format("SELECT {}, timing.ready, timing.steps FROM runs LEFT JOIN "
                  "timing USING (run) ORDER BY run",
                  names));
  const Design design = make_design(study);
  std::vector<StudyRow> rows;
  while (select.step()) {
    StudyRow row;
    int i = 0;
    row.run = select.whole(i++);
    if (row.run >= design.size()) refuse(file_, "has a run beyond its design");
    row.factors = design[row.run];
    i += static_cast<int>(study.factors.size());
    for (std::size_t r = 0; r < study.responses.size(); ++r) {
      row.responses.push_back(select.number(i++));
    }
    row.error = select.text(i++);
    row.warnings = select.text(i++);
    if (select.text(i++) != digest_of(row)) {
      refuse(file_,
             fmt::format("run {} was changed after it was written; delete its "
                         "row, and the study simulates it again",
                         row.run));
    }
    row.seconds_ready = select.number(i++).value_or(0.0);
    row.seconds = select.number(i++).value_or(0.0);
    rows.push_back(std::move(row));
  }
  return rows;
}

void StudyFile::add(const std::vector<StudyRow>& rows) {
  if (rows.empty()) return;
  const std::size_t count = list_columns(record_.study).size();
  std::string marks = "?";
  for (std::size_t i = 1; i < count; ++i) marks += ", ?";
  database_->run("BEGIN IMMEDIATE");
  try {
    Database::Statement insert(
        *database_, fmt::format("INSERT INTO runs VALUES ({})", marks));
    Database::Statement time(*database_,
                             "INSERT OR REPLACE INTO timing VALUES (?, ?, ?)");
    for (const StudyRow& row : rows) {
      int i = 1;
      insert.bind_count(i++, row.run);
      for (const std::string& value : row.factors)
        insert.bind_value(i++, value);
      for (const auto& value : row.responses) insert.bind(i++, value);
      insert.bind_words(i++, row.error);
      insert.bind_words(i++, row.warnings);
      insert.bind(i, digest_of(row));
      (void)insert.step();
      insert.reset();
      time.bind_count(1, row.run);
      time.bind(2, row.seconds_ready);
      time.bind(3, row.seconds);
      (void)time.step();
      time.reset();
    }
    database_->run("COMMIT");
  } catch (const InputError&) {
    try {
      database_->run("ROLLBACK");
    } catch (const InputError&) {  // the first one says why
    }
    throw;
  }
}

}  // namespace limber::study
