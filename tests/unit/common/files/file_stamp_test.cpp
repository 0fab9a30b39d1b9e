// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/file_stamp.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "unit/flexbody/files.hpp"

namespace limber::file_stamp_test {
namespace {

using flexbody::test::TemporaryFolder;
using flexbody::test::write_bytes;

class Stamp : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const {
    return folder_.path() / "file";
  }
  TemporaryFolder folder_;
};

TEST_F(Stamp, OfContentHoldsUntilAByteChanges) {
  write_bytes(file(), "abc");
  const FileStamp stamp = stamp_content(file());
  EXPECT_TRUE(is_unchanged(stamp));
  write_bytes(file(), "abc");  // rewritten with the same content
  EXPECT_TRUE(is_unchanged(stamp));
  write_bytes(file(), "abd");
  EXPECT_FALSE(is_unchanged(stamp));
  std::filesystem::remove(file());
  EXPECT_FALSE(is_unchanged(stamp));
}

TEST_F(Stamp, OfAnAbsentFileHoldsUntilItAppears) {
  for (const FileStamp& stamp :
       {stamp_content(file()), stamp_presence(file()), stamp_version(file())}) {
    EXPECT_TRUE(is_unchanged(stamp));
    write_bytes(file(), "");
    EXPECT_FALSE(is_unchanged(stamp));
    std::filesystem::remove(file());
  }
}

TEST_F(Stamp, OfPresenceIgnoresContent) {
  write_bytes(file(), "abc");
  const FileStamp stamp = stamp_presence(file());
  write_bytes(file(), "other");
  EXPECT_TRUE(is_unchanged(stamp));
  std::filesystem::remove(file());
  EXPECT_FALSE(is_unchanged(stamp));
}

TEST_F(Stamp, OfAVersionChangesWithTheFile) {
  write_bytes(file(), "abc");
  const FileStamp stamp = stamp_version(file());
  EXPECT_TRUE(is_unchanged(stamp));
  write_bytes(file(), "abcd");
  EXPECT_FALSE(is_unchanged(stamp));
}

TEST_F(Stamp, NeverWaitsForAPipe) {
  ASSERT_EQ(mkfifo(file().c_str(), 0600), 0);
  EXPECT_EQ(stamp_content(file()).mark, "there");
}

}  // namespace
}  // namespace limber::file_stamp_test
