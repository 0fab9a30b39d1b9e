// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/spilled_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <thread>

#include "limber/common/errors.hpp"
#include "support/temporary_folder.hpp"

namespace limber::spilled_list_test {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // [bytes]
using Rows = std::vector<std::vector<double>>;
using List = SpilledList<std::vector<double>>;

/// Of different lengths, some empty, one longer than a block.
Rows make_rows(std::size_t count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Rows rows;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double>& row = rows.emplace_back(i % 7 * (i % 5));
    for (double& x : row) x = uniform(random);
  }
  rows[count / 3].assign(200000, 0.5);
  rows[count / 2] = {std::numeric_limits<double>::quiet_NaN(), -0.0,
                     std::numeric_limits<double>::infinity()};
  return rows;
}

std::vector<std::uint64_t> bits(const std::vector<double>& row) {
  std::vector<std::uint64_t> all;
  for (const double x : row) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

void expect_same(const List& list, const Rows& rows) {
  ASSERT_EQ(list.size(), rows.size());
  std::size_t i = 0;
  for (const std::vector<double>& row : list) {
    ASSERT_EQ(bits(row), bits(rows[i])) << i;
    ++i;
  }
  std::mt19937 random(12);
  for (int k = 0; k < 1000; ++k) {
    const std::size_t at = random() % rows.size();
    ASSERT_EQ(bits(list[at]), bits(rows[at])) << at;
  }
}

TEST(SpilledList, GivesBackEachRowToTheBitInAnyOrder) {
  const Rows rows = make_rows(60000);
  const List list(rows);
  EXPECT_LT(list.held_bytes(), kBlock);
  expect_same(list, rows);
  EXPECT_EQ(list.front(), rows.front());
  EXPECT_EQ(list.back(), rows.back());
  EXPECT_THROW((void)list[rows.size()], ContractError);
}

TEST(SpilledList, HoldsABlockWhateverItsLength) {
  SpilledList<double> list;
  std::size_t most = 0;
  for (int i = 0; i < 2000000; ++i) {
    list.push_back(i);
    most = std::max(most, list.held_bytes());
  }
  EXPECT_LE(most, kBlock + 16);
  EXPECT_EQ(list[1234567], 1234567.0);
}

TEST(SpilledList, OfFewValuesIsInMemory) {
  const SpilledList<double> list = {1.0, 2.0, 3.0};
  EXPECT_EQ(list.held_bytes(), 3U * (sizeof(double) + sizeof(std::uint64_t)));
  EXPECT_EQ(list.read(1, 2), (std::vector<double>{2.0, 3.0}));
  EXPECT_TRUE(SpilledList<double>().empty());
}

TEST(SpilledList, OfWhichThereIsACopyGrowsApartFromIt) {
  Rows rows = make_rows(60000);
  List list(rows);
  List copy = list;
  Rows others = rows;
  for (int i = 0; i < 60000; ++i) {
    rows.push_back({1.0 * i, 2.0});
    list.push_back(rows.back());
    others.push_back({-1.0 * i, 3.0, 4.0});
    copy.push_back(others.back());
  }
  expect_same(list, rows);
  expect_same(copy, others);
}

TEST(SpilledList, IsReadByThreadsTogether) {
  const Rows rows = make_rows(60000);
  const List list(rows);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&] { expect_same(list, rows); });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(SpilledList, PassesThroughAnArchive) {
  const Rows rows = make_rows(3000);
  List list(rows);
  Archive out;
  out(list);
  Archive in(out.take_numbers());
  List read = {{9.0}};
  in(read);
  expect_same(read, rows);
}

/// Sets TMPDIR, in a suite with a process of its own.
class SpilledListIn : public ::testing::Test {
 protected:
  ~SpilledListIn() override { set_place(before_); }

  static void set_place(const std::string& folder) {
    setenv("TMPDIR", folder.c_str(), 1);
  }

  std::string before_ = std::filesystem::temp_directory_path();
  test::TemporaryFolder folder_;
};

TEST_F(SpilledListIn, AFolderLeavesNoFileThere) {
  set_place(folder_.path());
  const List list(make_rows(60000));
  EXPECT_LT(list.held_bytes(), kBlock);
  EXPECT_EQ(folder_.count_files(), 0);
}

TEST_F(SpilledListIn, AFolderThatIsNotThereStaysInMemory) {
  set_place(folder_.path() / "none");
  const Rows rows = make_rows(60000);
  const List list(rows);
  EXPECT_GT(list.held_bytes(), 4 * kBlock);
  expect_same(list, rows);
}

// The limit of a file's size stands for the disk's.
TEST_F(SpilledListIn, AFullDiskStaysInMemoryUntilThereIsRoom) {
  set_place(folder_.path());
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit limit = old;
  limit.rlim_cur = 2 * kBlock + 1000;
  setrlimit(RLIMIT_FSIZE, &limit);
  Rows rows = make_rows(60000);
  List list(rows);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_GT(list.held_bytes(), kBlock);
  expect_same(list, rows);
  for (int i = 0; i < 1000000; ++i) {
    rows.push_back({0.5 * i});
    list.push_back(rows.back());
  }
  EXPECT_LT(list.held_bytes(), kBlock);
  expect_same(list, rows);
}

}  // namespace
}  // namespace limber::spilled_list_test
