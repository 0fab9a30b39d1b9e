// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/checkpoint_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "small_run.hpp"
#include "temporary_folder.hpp"

namespace limber::results::checkpoint_file_test {
namespace {

namespace fs = std::filesystem;
using test::make_small_run;
using test::read_bytes;
using test::TemporaryFolder;
using ::testing::ElementsAre;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

Manifest make_manifest() {
  Manifest manifest;
  manifest.add("of", "a run");
  return manifest;
}

std::vector<double> to_numbers(dynamics::SystemState state) {
  Archive archive;
  archive(state);
  return archive.numbers();
}

/// The first outputs of a history.
History cut(const History& all, std::size_t count) {
  History history = all;
  history.times.resize(count);
  history.probe_rows = all.probe_rows.read(0, count);
  history.states = all.states.read(0, count);
  history.energies = all.energies.read(0, count);
  return history;
}

void expect_same(const History& a, const History& b) {
  EXPECT_EQ(a.times, b.times);
  ASSERT_EQ(a.probe_rows.size(), b.probe_rows.size());
  for (std::size_t i = 0; i < a.probe_rows.size(); ++i) {
    EXPECT_EQ(a.probe_rows[i], b.probe_rows[i]);
  }
  EXPECT_EQ(a.events, b.events);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    EXPECT_EQ(a.columns[i].name, b.columns[i].name);
  }
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    EXPECT_EQ(to_numbers(a.states[i]), to_numbers(b.states[i]));
  }
}

class CheckpointFile : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "checkpoint.bin";
  fs::path log_ = folder_.path() / "checkpoint-1.log";
  History history_ = make_small_run().history;
};

TEST_F(CheckpointFile, GivesBackTheRunAndAllThatItLeftInParts) {
  CheckpointWriter writer(file_, make_manifest());
  for (std::size_t n = 0; n <= history_.times.size(); ++n) {
    const double number = static_cast<double>(n);
    writer.write({0.1 * number, {number, -0.0}, {number}, n}, cut(history_, n));
    const CheckpointRecord record = read_checkpoint(file_);
    EXPECT_EQ(record.run.time, 0.1 * number);
    EXPECT_EQ(record.run.numbers, (std::vector<double>{number, -0.0}));
    EXPECT_EQ(record.run.log.size(), n + 1);
    EXPECT_EQ(record.manifest.text(), make_manifest().text());
    expect_same(record.history, cut(history_, n));
  }
}

TEST_F(CheckpointFile, OfARunThatGoesOnGrowsFromWhatItWas) {
  CheckpointWriter(file_, make_manifest())
      .write({0.1, {1.0}, {}, 2}, cut(history_, 2));
  // What a kill leaves between the log and the file.
  std::ofstream(log_, std::ios::app) << "half of a block";
  CheckpointRecord record = read_checkpoint(file_);
  expect_same(record.history, cut(history_, 2));
  CheckpointWriter(file_, record)
      .write({0.2, {2.0}, {}, history_.times.size()}, history_);
  record = read_checkpoint(file_);
  EXPECT_THAT(record.run.numbers, ElementsAre(2.0));
  expect_same(record.history, history_);
  EXPECT_EQ(fs::file_size(log_), record.part.length);
}

// An interrupted run has results that are later than its last checkpoint.
TEST_F(CheckpointFile, LeavesOutOutputsAfterIt) {
  CheckpointWriter writer(file_, make_manifest());
  writer.write({0.1, {1.0}, {}, 1}, history_);
  CheckpointRecord record = read_checkpoint(file_);
  EXPECT_EQ(record.run.outputs, 1U);
  expect_same(record.history, cut(history_, 1));
  writer.write({0.2, {2.0}, {}, 2}, history_);
  record = read_checkpoint(file_);
  EXPECT_EQ(record.run.outputs, 2U);
  expect_same(record.history, cut(history_, 2));
}

// Each output is written once, however many checkpoints there are.
TEST_F(CheckpointFile, AppendsWhatIsNewAndRewritesNothing) {
  CheckpointWriter writer(file_, make_manifest());
  writer.write({0.0, {1.0}, {}, 1}, cut(history_, 1));
  const auto one = fs::file_size(log_);
  const std::string before = read_bytes(log_);
  const auto head = fs::file_size(file_);
  writer.write({0.0, {1.0}, {}, 2}, cut(history_, 2));
  const auto each = fs::file_size(log_) - one;
  EXPECT_TRUE(read_bytes(log_).starts_with(before));
  History longer = cut(history_, 2);
  for (int i = 0; i < 50; ++i) {
    longer.times.push_back(1.0);
    longer.probe_rows.push_back(longer.probe_rows.back());
    longer.states.push_back(longer.states.back());
    longer.energies.push_back(longer.energies.back());
    writer.write({0.0, {1.0}, {}, longer.times.size()}, longer);
  }
  EXPECT_EQ(fs::file_size(log_), one + 51 * each);
  EXPECT_EQ(fs::file_size(file_), head);
}

// More outputs than a block of the log holds.
TEST_F(CheckpointFile, HoldsAnyNumberOfOutputsSinceTheOneBefore) {
  History many = cut(history_, 2);
  CheckpointWriter writer(file_, make_manifest());
  writer.write({0.1, {1.0}, {1.0}, 2}, many);
  for (const std::size_t more : {64U, 65U, 1000U}) {
    for (std::size_t i = 0; i < more; ++i) {
      const std::size_t from = i % history_.times.size();
      many.times.push_back(static_cast<double>(i));
      many.probe_rows.push_back(history_.probe_rows[from]);
      many.states.push_back(history_.states[from]);
      many.energies.push_back(history_.energies[from]);
    }
    writer.write({0.2, {2.0}, {2.0}, many.times.size()}, many);
    const CheckpointRecord record = read_checkpoint(file_);
    EXPECT_EQ(record.run.outputs, many.times.size());
    expect_same(record.history, many);
  }
  EXPECT_THAT(read_checkpoint(file_).run.log, ElementsAre(1.0, 2.0, 2.0, 2.0));
}

TEST_F(CheckpointFile, RefusesEveryFlippedByteAndEveryCut) {
  CheckpointWriter(file_, make_manifest())
      .write({0.1, {1.0, 2.0}, {3.0}, 2}, cut(history_, 2));
  std::mt19937 random(2026);
  for (const fs::path& file : {file_, log_}) {
    const std::string bytes = read_bytes(file);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (1U << (random() % 8)));
      write(file, damaged);
      EXPECT_THROW((void)read_checkpoint(file_), InputError) << file << i;
      if (i % 16 != 0) continue;
      write(file, bytes.substr(0, i));
      EXPECT_THROW((void)read_checkpoint(file_), InputError) << file << i;
    }
    write(file, bytes);
  }
  EXPECT_NO_THROW((void)read_checkpoint(file_));
  fs::remove(log_);
  EXPECT_THROW((void)read_checkpoint(file_), InputError);
}

// A new run in the folder of one that was killed.
TEST_F(CheckpointFile, OfAnotherRunStandsUntilThereIsANewOne) {
  CheckpointWriter(file_, make_manifest())
      .write({0.1, {1.0}, {}, 2}, cut(history_, 2));
  CheckpointWriter second(file_, make_manifest());
  EXPECT_THAT(read_checkpoint(file_).run.numbers, ElementsAre(1.0));
  second.write({0.2, {2.0}, {}, 1}, cut(history_, 1));
  EXPECT_THAT(read_checkpoint(file_).run.numbers, ElementsAre(2.0));
  EXPECT_FALSE(fs::exists(log_));
  remove_checkpoint(file_);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(CheckpointFile, ThatCannotBeWrittenIsMadeUpForByTheNext) {
  CheckpointWriter writer(file_, make_manifest());
  writer.write({0.1, {1.0}, {1.0}, 1}, cut(history_, 1));
  fs::rename(file_, folder_.path() / "away");
  fs::create_directories(file_ / "in the way");
  EXPECT_THROW(writer.write({0.2, {2.0}, {2.0}, 2}, cut(history_, 2)),
               InputError);
  fs::remove_all(file_);
  writer.write({0.3, {3.0}, {3.0}, history_.times.size()}, history_);
  const CheckpointRecord record = read_checkpoint(file_);
  EXPECT_THAT(record.run.log, ElementsAre(1.0, 2.0, 3.0));
  expect_same(record.history, history_);
}

TEST_F(CheckpointFile, OfTheSameRunIsTheSameToTheByte) {
  const TemporaryFolder other;
  CheckpointWriter(file_, make_manifest()).write({0.1, {1.0}, {}, 2}, history_);
  CheckpointWriter(other.path() / "checkpoint.bin", make_manifest())
      .write({0.1, {1.0}, {}, 2}, history_);
  EXPECT_EQ(read_bytes(file_), read_bytes(other.path() / "checkpoint.bin"));
  EXPECT_EQ(read_bytes(log_), read_bytes(other.path() / "checkpoint-1.log"));
}

}  // namespace
}  // namespace limber::results::checkpoint_file_test
