// SPDX-License-Identifier: BSD-3-Clause
// Files that refer to other ones, written with the HDF5 library itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "support/foreign_hdf5.hpp"
#include "support/temporary_folder.hpp"

namespace limber::hdf5_inside_test {
namespace {

using limber::test::ForeignHdf5;
using limber::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

void write_file(const std::filesystem::path& file, double value) {
  Hdf5File out = Hdf5File::create(file);
  out.write("a/b/matrix", MatrixX::Constant(2, 2, value), "m", "numbers");
  out.write("a/b/list", std::vector<std::int64_t>{1, 2}, "1", "numbers");
  out.write("a/b/text", std::string("a word"), "a word");
  out.close();
}

class Hdf5InsideTest : public ::testing::Test {
 protected:
  Hdf5InsideTest() {
    write_file(own(), 1.0);
    write_file(other(), 2.0);
    std::ofstream(secret()) << std::string(100, 'x');
  }
  [[nodiscard]] std::filesystem::path own() const {
    return folder_.path() / "own.h5";
  }
  [[nodiscard]] std::filesystem::path other() const {
    return folder_.path() / "other.h5";
  }
  [[nodiscard]] std::filesystem::path secret() const {
    return folder_.path() / "secret.txt";
  }
  void expect_refused(const std::string& name,
                      const std::string& reason) const {
    try {
      (void)Hdf5File::open(own());
      ADD_FAILURE() << name << " is accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(own().string()),
                                      HasSubstr("'" + name + "' " + reason)));
    }
  }

 private:
  TemporaryFolder folder_;
};

constexpr const char* kLink = "is a link to another file";
constexpr const char* kOutside = "keeps its values in another file";
constexpr const char* kView = "is a virtual data set";
const std::vector<std::string> kSets = {"a/b/matrix", "a/b/list", "a/b/text"};

TEST_F(Hdf5InsideTest, RefusesALinkToAnotherFile) {
  for (const std::string& name : kSets) {
    write_file(own(), 1.0);
    ForeignHdf5(own()).link_outside(name, other().string(), "/" + name);
    expect_refused(name, kLink);
  }
}

// A link that leads nowhere is refused alike: the other file is not looked for.
TEST_F(Hdf5InsideTest, RefusesAGroupThatIsALinkToAnyFile) {
  for (const std::string& to : {other().string(), std::string("none.h5")}) {
    write_file(own(), 1.0);
    ForeignHdf5(own()).link_outside("a/b", to, "/a/b");
    expect_refused("a/b", kLink);
  }
}

TEST_F(Hdf5InsideTest, RefusesALinkToAnotherFileBehindALinkInside) {
  ForeignHdf5(own()).link_outside("a/b/list", other().string(), "/a/b");
  ForeignHdf5(own()).link_inside("a/b/matrix", "/a/b/list/matrix");
  expect_refused("a/b/list", kLink);
}

TEST_F(Hdf5InsideTest, RefusesAnExternalLinkBackToItself) {
  {
    const ForeignHdf5 file(own());
    file.move("a/b/matrix", "a/moved");
    file.move("a/b/list", "a/b/matrix");
    file.link_outside("a/b/matrix", own().string(), "/a/moved");
  }
  expect_refused("a/b/matrix", kLink);
}

TEST_F(Hdf5InsideTest, RefusesValuesInBytesOfAnotherFile) {
  for (const std::string& name : kSets) {
    write_file(own(), 1.0);
    ForeignHdf5(own()).store_outside(name, secret().string());
    expect_refused(name, kOutside);
  }
}

TEST_F(Hdf5InsideTest, RefusesAViewOfOtherDataSets) {
  for (const std::string& source : {other().string(), std::string(".")}) {
    write_file(own(), 1.0);
    ForeignHdf5(own()).map_virtually("a/b/matrix", source, "/a/b/matrix");
    expect_refused("a/b/matrix", kView);
  }
}

// Groups may hold each other; each is visited once.
TEST_F(Hdf5InsideTest, LooksThroughGroupsThatHoldEachOther) {
  {
    const ForeignHdf5 file(own());
    file.link_again("/a", "a/b/up");
    file.store_outside("a/b/text", secret().string());
  }
  expect_refused("a/b/text", kOutside);
}

TEST_F(Hdf5InsideTest, FollowsLinksWithinTheFile) {
  {
    const ForeignHdf5 file(own());
    file.move("a/b", "moved");
    file.move("moved/list", "a/b");
    file.link_inside("a/b", "/moved");
  }
  const Hdf5File in = Hdf5File::open(own());
  EXPECT_TRUE(in.has("a/b/matrix"));
  EXPECT_THAT(in.list("a/b"), ElementsAre("matrix", "text"));
  EXPECT_EQ(in.read_matrix("a/b/matrix"), MatrixX::Ones(2, 2));
}

}  // namespace
}  // namespace limber::hdf5_inside_test
