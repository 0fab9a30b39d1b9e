// SPDX-License-Identifier: BSD-3-Clause
// Reads every file in corpus/ as the fuzzers do: seeds, inputs that reached new
// code, and former findings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "fuzz/readers.hpp"
#include "places.hpp"
#include "unit/flexbody/files.hpp"

namespace limber::fuzz::replay_test {
namespace {

using Clock = std::chrono::steady_clock;

class Corpus : public ::testing::TestWithParam<Reader> {
 protected:
  [[nodiscard]] std::filesystem::path folder() const {
    return std::filesystem::path(LIMBER_SOURCE_DIR) / "tests/fuzz/corpus" /
           GetParam().name;
  }
};

TEST_P(Corpus, IsTakenOrRefusedByAnInputErrorInTime) {
  int taken = 0;
  int refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    SCOPED_TRACE(entry.path());
    const std::string bytes = flexbody::test::read_bytes(entry.path());
    const auto start = Clock::now();
    EXPECT_NO_THROW(++(takes(GetParam(), bytes) ? taken : refused));
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
  }
  // A whole body in the corpus would be of an older layout one day.
  const bool needs_good_one = GetParam().name != "body";
  EXPECT_TRUE(taken > 0 || !needs_good_one) << "the corpus has no good file";
  EXPECT_GT(refused, 0) << "the corpus has no bad file";
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus, ::testing::ValuesIn(all_readers()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace limber::fuzz::replay_test
