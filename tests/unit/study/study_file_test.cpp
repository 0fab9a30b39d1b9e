// SPDX-License-Identifier: BSD-3-Clause
#include "limber/study/study_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>

#include "limber/common/errors.hpp"
#include "limber/study/study_reader.hpp"

namespace limber::study::study_file_test {
namespace {

namespace fs = std::filesystem;

/// A file of one study, written, closed and opened as any reader of SQLite
/// does.
class AFileOfAStudy : public ::testing::Test {
 protected:
  AFileOfAStudy() {
    fs::remove(file_);
    record_.study = read_study(R"(
scenario = 's.toml'
[design]
kind = 'list'
[[factor]]
name = 'force'
path = 'load.push.force.0'
values = [-1.6385300000000001, 2e-300]
[[factor]]
name = 'level'
path = 'fidelity'
values = ['rigid', 'coupled']
[[response]]
name = 'y'
summary = 'steps'
)",
                               "study.toml");
    record_.runs = 2;
    StudyFile file(file_, record_);
    StudyRow first;
    first.factors = {"-1.6385300000000001", "rigid"};
    first.responses = {-0.1};
    first.seconds = 0.25;
    StudyRow second;
    second.run = 1;
    second.factors = {"2e-300", "coupled"};
    second.responses = {std::nullopt};
    second.error = "why";
    file.add({first, second});
  }
  ~AFileOfAStudy() override {
    sqlite3_close(database_);
    fs::remove(file_);
  }

  /// The only value of a query, as text; numbers with all their digits.
  std::string ask(const std::string& query) {
    if (database_ == nullptr) sqlite3_open(file_.c_str(), &database_);
    sqlite3_stmt* statement = nullptr;
    EXPECT_EQ(
        sqlite3_prepare_v2(database_, query.c_str(), -1, &statement, nullptr),
        SQLITE_OK)
        << sqlite3_errmsg(database_);
    EXPECT_EQ(sqlite3_step(statement), SQLITE_ROW);
    const auto* text = sqlite3_column_text(statement, 0);
    std::string result =
        text == nullptr ? "nothing" : reinterpret_cast<const char*>(text);
    sqlite3_finalize(statement);
    return result;
  }

  fs::path file_ = fs::temp_directory_path() /
                   fmt::format("limber_study_{}.sqlite", getpid());
  StudyRecord record_;
  sqlite3* database_ = nullptr;
};

TEST_F(AFileOfAStudy, HasNumbersOfFactorsToTheLastBit) {
  EXPECT_EQ(ask("SELECT force = -1.6385300000000001 FROM runs WHERE run = 0"),
            "1");
  EXPECT_EQ(ask("SELECT force = 2e-300 FROM runs WHERE run = 1"), "1");
  EXPECT_EQ(ask("SELECT typeof(force) FROM runs WHERE run = 0"), "real");
}

TEST_F(AFileOfAStudy, HasWordsOfFactorsAsText) {
  EXPECT_EQ(ask("SELECT level FROM runs WHERE run = 1"), "coupled");
}

TEST_F(AFileOfAStudy, HasResponsesTimesAndReasons) {
  EXPECT_EQ(ask("SELECT y = -0.1 FROM runs WHERE run = 0"), "1");
  EXPECT_EQ(ask("SELECT y FROM runs WHERE run = 1"), "nothing");
  EXPECT_EQ(ask("SELECT error FROM runs WHERE run = 0"), "nothing");
  EXPECT_EQ(ask("SELECT error FROM runs WHERE run = 1"), "why");
  EXPECT_EQ(ask("SELECT steps = 0.25 FROM timing WHERE run = 0"), "1");
}

// What a process leaves that is killed while it makes the tables: some pages,
// and a journal that undoes them.
TEST_F(AFileOfAStudy, IsMadeAnewAfterAKillBeforeItHadTables) {
  const fs::path begun = file_.string() + ".begun";
  const fs::path left = file_.string() + ".left";
  fs::remove(begun);
  ASSERT_EQ(sqlite3_open(begun.c_str(), &database_), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database_,
                         "PRAGMA cache_size = 1; BEGIN EXCLUSIVE;"
                         "CREATE TABLE study (key TEXT, value TEXT);"
                         "INSERT INTO study VALUES ('a', zeroblob(1000000));",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  const auto overwrite = fs::copy_options::overwrite_existing;
  fs::copy_file(begun, left, overwrite);
  fs::copy_file(begun.string() + "-journal", left.string() + "-journal",
                overwrite);
  ASSERT_GT(fs::file_size(left), 0U);
  StudyFile file(left, record_);
  EXPECT_TRUE(file.read_rows().empty());
  EXPECT_EQ(file.record().runs, 2U);
  for (const fs::path& one : {begun, left}) fs::remove(one);
}

TEST_F(AFileOfAStudy, RefusesRowsThatAreNotAsTheyWereWritten) {
  EXPECT_EQ(StudyFile(file_).read_rows().at(0).responses.at(0), -0.1);
  for (const std::string change :
       {"y = -0.1000000000000001", "y = NULL", "error = 'no'",
        "warnings = 'none'", "digest = NULL"}) {
    (void)ask("UPDATE runs SET " + change + " WHERE run = 0 RETURNING run");
    EXPECT_THROW((void)StudyFile(file_).read_rows(), InputError) << change;
    (void)ask("DELETE FROM runs WHERE run = 0 RETURNING run");
    StudyRow again;
    again.factors = {"-1.6385300000000001", "rigid"};
    again.responses = {-0.1};
    StudyFile(file_, record_).add({again});
    EXPECT_EQ(StudyFile(file_).read_rows().size(), 2U);
  }
}

}  // namespace
}  // namespace limber::study::study_file_test
