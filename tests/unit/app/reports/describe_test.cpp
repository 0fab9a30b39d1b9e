// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/describe.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "limber/results/checkpoint_file.hpp"

namespace limber::app::describe_test {
namespace {

TEST(Describe, TellsThatAFileIsACheckpointAndOfWhichTime) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("limber_checkpoint_" + std::to_string(getpid()) + ".bin");
  Manifest manifest;
  manifest.add("of", "a run");
  results::CheckpointWriter(file, manifest).write({0.25, {1.0, 2.0}}, {});
  const Json json = describe_checkpoint(file);
  results::remove_checkpoint(file);
  EXPECT_EQ(json["kind"].get<std::string>(), "checkpoint");
  EXPECT_EQ(json["time"].get<double>(), 0.25);
  EXPECT_EQ(json["outputs"].get<int>(), 0);
}

}  // namespace
}  // namespace limber::app::describe_test
