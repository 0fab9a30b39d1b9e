// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "unit/flexbody/files.hpp"

namespace limber::input_file_test {
namespace {

namespace fs = std::filesystem;
using flexbody::test::find_input_error;
using flexbody::test::TemporaryFolder;
using flexbody::test::write_bytes;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr InputKind kSmall = {"small file", 2048};

std::string refusal(const fs::path& file) {
  return find_input_error([&] { (void)read_input(file, kSmall); });
}

TEST(InputFile, GivesAllBytesOfARegularFile) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i % 251);
  write_bytes(folder.path() / "f", bytes);
  EXPECT_EQ(read_input(folder.path() / "f", {"file", 1 << 20}), bytes);
  write_bytes(folder.path() / "empty", "");
  EXPECT_EQ(read_input(folder.path() / "empty", kSmall), "");
}

TEST(InputFile, DoesNotWaitForAPipe) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal(pipe),
              AllOf(HasSubstr("pipe: cannot read"), HasSubstr("small file"),
                    HasSubstr("expected a regular file")));
  EXPECT_THAT(find_input_error([&] { (void)Hdf5File::open(pipe); }),
              HasSubstr("it is a pipe"));
}

TEST(InputFile, RefusesDevicesAndFolders) {
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("it is a device"));
  EXPECT_THAT(refusal("/"), HasSubstr("it is a folder"));
  EXPECT_THAT(find_input_error([] { (void)Hdf5File::open("/dev/zero"); }),
              HasSubstr("it is a device"));
}

TEST(InputFile, TellsWhyAFileCannotBeOpened) {
  EXPECT_THAT(refusal("/no/such/file"), HasSubstr("No such file or directory"));
}

TEST(InputFile, RefusesMoreBytesThanItsKindHas) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "large";
  write_bytes(file, std::string(2048, 'x'));
  EXPECT_EQ(refusal(file), "");
  write_bytes(file, std::string(3072, 'x'));
  EXPECT_THAT(refusal(file), AllOf(HasSubstr("it has 0.00293 MiB"),
                                   HasSubstr("at most 0.001953 MiB")));
}

// Files of /proc say that they have no bytes.
TEST(InputFile, StopsAtTheLimitWhateverTheFileSaysOfItsSize) {
  std::ifstream known("/proc/self/smaps");
  if (!known) GTEST_SKIP() << "no /proc";
  EXPECT_THAT(refusal("/proc/self/smaps"), HasSubstr("at most"));
}

}  // namespace
}  // namespace limber::input_file_test
