// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "limber/flexbody/file/body_file.hpp"
#include "unit/flexbody/file/cache_fixture.hpp"

namespace limber::flexbody::test::cache_test {
namespace {

TEST_F(Cache, ReducesOnceAndThenFindsTheSameBody) { expect_made_anew(); }

TEST_F(Cache, GivesABodyTheNameOfWhoAsks) {
  (void)ask();
  recipe_.name = "fore arm";
  const CachedBody found = ask();
  EXPECT_TRUE(found.was_cached);
  EXPECT_EQ(found.body.name, "fore arm");
}

TEST_F(Cache, ReducesAgainForAnotherRecipe) {
  (void)ask();
  recipe_.basis.eigenmodes += 1;
  expect_made_anew();
  EXPECT_EQ(reductions_, 2);
}

// The body is reduced once, with the tables, whichever run comes first.
TEST_F(Cache, HasStressModesForALaterRunThatAsksForThem) {
  makes_stress_ = true;
  const CachedBody plain = ask();
  EXPECT_FALSE(plain.was_cached);
  EXPECT_FALSE(plain.body.stress);
  EXPECT_FALSE(ask().body.stress);
  recipe_.stress = true;
  const CachedBody stressed = ask();
  EXPECT_TRUE(stressed.was_cached);
  ASSERT_TRUE(stressed.body.stress);
  EXPECT_EQ(reductions_, 1);
  EXPECT_EQ(plain.body.content_key, stressed.body.content_key);
  recipe_.stress = false;
  EXPECT_TRUE(ask().was_cached);
}

// Of an earlier version, or of a body with second-order kinematics.
TEST_F(Cache, AddsStressModesToAnEntryWithout) {
  recipe_.manifold = true;
  makes_stress_ = true;
  EXPECT_FALSE(ask().body.stress);
  EXPECT_FALSE(read_body(entry()).stress);
  recipe_.stress = true;
  const CachedBody stressed = ask();
  EXPECT_FALSE(stressed.was_cached);
  EXPECT_TRUE(stressed.body.stress);
  EXPECT_TRUE(read_body(entry()).stress);
  EXPECT_TRUE(ask().was_cached);
  recipe_.stress = false;
  EXPECT_TRUE(ask().was_cached);
  EXPECT_EQ(reductions_, 2);
}

TEST_F(Cache, ReducesAgainForAnotherMesh) {
  (void)ask();
  write_bytes(recipe_.mesh.file, "another mesh");
  expect_made_anew();
}

TEST_F(Cache, MakesADamagedEntryAnew) {
  (void)ask();
  const std::string bytes = read_bytes(entry());
  std::string flipped = bytes;
  flipped[bytes.size() / 2] = static_cast<char>(~flipped[bytes.size() / 2]);
  for (const std::string& damaged :
       {std::string(), std::string("text"), bytes.substr(0, 300),
        bytes.substr(0, bytes.size() / 2), flipped}) {
    write_bytes(entry(), damaged);
    expect_made_anew();
  }
}

TEST_F(Cache, MakesAnEntryOfAnotherKeyAnew) {
  ReducedBody foreign = make_small_body(2);
  std::filesystem::create_directories(cache());
  write_body(foreign, entry());
  expect_made_anew();
}

TEST_F(Cache, LivesWithoutAFolderThatCanBeWritten) {
  // Below a file there is no folder, not even for the administrator.
  const auto impossible = recipe_.mesh.file / "cache";
  for (int i = 1; i <= 2; ++i) {
    const CachedBody made = ask_in(impossible);
    EXPECT_FALSE(made.was_cached);
    EXPECT_EQ(find_difference(made.body, expected()), "");
    EXPECT_EQ(reductions_, i);
  }
}

TEST_F(Cache, LivesWithAFolderInTheEntrysPlace) {
  std::filesystem::create_directories(entry());
  const CachedBody made = ask();
  EXPECT_FALSE(made.was_cached);
  EXPECT_EQ(find_difference(made.body, expected()), "");
}

TEST_F(Cache, PassesOnWhatReducingThrowsAndKeepsNothing) {
  const Reducer fail = {"mesher", [this](const MeshSource& source) {
                          return MeshAtHand{
                              make_record(source),
                              [](const Recipe&) -> ReducedBody {
                                throw NumericalError("no convergence");
                              }};
                        }};
  EXPECT_THROW((void)load_or_reduce(recipe_, cache(), fail), NumericalError);
  expect_made_anew();
}

TEST_F(Cache, GivesThreadsThatAskAtOnceTheSameBody) {
  for (int round = 0; round < 10; ++round) {
    std::filesystem::remove_all(cache());
    std::vector<std::string> differences(4, "no answer");
    std::vector<std::thread> threads;
    for (std::string& difference : differences) {
      threads.emplace_back([this, &difference] {
        difference = find_difference(ask().body, expected());
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(differences, ::testing::Each(""));
    EXPECT_TRUE(ask().was_cached);
    // The body, the name of its mesh file, and the record of its mesh.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(cache()), {}),
              3);
  }
}

TEST_F(Cache, RefusesEntriesThatOthersOwnOrCanWrite) {
  using std::filesystem::perms;
  for (const perms others : {perms::group_write, perms::others_write}) {
    (void)ask();
    std::filesystem::permissions(entry(), others,
                                 std::filesystem::perm_options::add);
    expect_made_anew();
  }
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  ASSERT_EQ(chown(entry().c_str(), 12345, 12345), 0);
  expect_made_anew();
}

TEST_F(Cache, FollowsNoLinkInAnEntrysPlace) {
  (void)ask();
  std::filesystem::rename(entry(), folder_.path() / "elsewhere");
  std::filesystem::create_symlink(folder_.path() / "elsewhere", entry());
  EXPECT_FALSE(ask().was_cached);
}

TEST_F(Cache, IsForItsOwnerAloneWhateverTheUmask) {
  const mode_t old = umask(0);
  (void)ask();
  umask(old);
  EXPECT_TRUE(ask().was_cached);
  struct stat info {};
  ASSERT_EQ(stat(cache().c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0700U);
}

}  // namespace
}  // namespace limber::flexbody::test::cache_test
