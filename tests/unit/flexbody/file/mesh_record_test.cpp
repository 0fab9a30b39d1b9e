// SPDX-License-Identifier: BSD-3-Clause
// When the cache makes a mesh again, and when its record is enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include "unit/flexbody/file/cache_fixture.hpp"

namespace limber::flexbody::test::mesh_record_test {
namespace {

TEST_F(Cache, MakesNoMeshWhileNoFileHasChanged) {
  (void)ask();
  expect_meshes(0, 0);
  write_bytes(recipe_.mesh.file, "a mesh");  // touched alone
  expect_meshes(0, 0);
}

TEST_F(Cache, MakesAMeshAnewAfterAChangeAndFindsItsBody) {
  (void)ask();
  write_bytes(recipe_.mesh.file, "a mesh// with a comment");
  expect_meshes(1, 0);
  std::filesystem::remove(library());
  write_bytes(library(), "Gmsh of another version");
  expect_meshes(1, 0);
  recipe_.mesh.size = 0.2;  // to the same end
  expect_meshes(1, 0);
  EXPECT_EQ(reductions_, 1);
}

TEST_F(Cache, MakesAMeshThatIsNotRepeatableInEachRun) {
  is_repeatable_ = false;
  (void)ask();
  expect_meshes(1, 1);
  EXPECT_EQ(reductions_, 1);
}

TEST_F(Cache, AsksAnotherMesherForAMeshOfItsOwn) {
  (void)ask();
  for (const auto& [mesher, meshes] :
       {std::pair("another", 1), std::pair("another", 0), std::pair("", 0)}) {
    Reducer other = reducer();
    other.mesher = mesher;
    const int before = meshes_;
    EXPECT_TRUE(load_or_reduce(recipe_, cache(), other).was_cached);
    EXPECT_EQ(meshes_ - before, meshes) << mesher;
  }
}

TEST_F(Cache, SharesABodyAmongFilesOfOneMesh) {
  (void)ask();
  const auto other = folder_.path() / "arm.geo";
  write_bytes(other, "a mesh// by another program");
  recipe_.mesh.file = other;
  EXPECT_TRUE(ask().was_cached);
  EXPECT_EQ(reductions_, 1);
}

TEST_F(Cache, TellsTheNoticesOfAMeshThatItDidNotMake) {
  EXPECT_THAT(ask().notices, ::testing::ElementsAre("a notice"));
  EXPECT_THAT(ask().notices, ::testing::ElementsAre("a notice"));
  EXPECT_EQ(meshes_, 1);
}

TEST_F(Cache, DoesNotTakeADamagedRecordOfAMesh) {
  (void)ask();
  const std::string bytes = read_bytes(mesh_entry());
  const std::size_t at = bytes.find("mesh of");
  ASSERT_NE(at, std::string::npos);
  std::string other_mesh = bytes;
  other_mesh[at] = 'M';
  for (const std::string& damaged :
       {std::string(), std::string("text"), bytes.substr(0, at), other_mesh}) {
    write_bytes(mesh_entry(), damaged);
    expect_meshes(1, 0);
  }
}

TEST_F(Cache, DoesNotTakeTheRecordOfAnotherRequest) {
  (void)ask();
  const auto first = mesh_entry();
  const std::string bytes = read_bytes(first);
  std::filesystem::remove(first);
  recipe_.mesh.size = 0.2;
  (void)ask();
  write_bytes(mesh_entry(), bytes);
  expect_meshes(1, 0);
}

TEST_F(Cache, DoesNotTakeARecordThatOthersOwnOrCanWrite) {
  using std::filesystem::perms;
  (void)ask();
  for (const perms others : {perms::group_write, perms::others_write}) {
    std::filesystem::permissions(mesh_entry(), others,
                                 std::filesystem::perm_options::add);
    expect_meshes(1, 0);
  }
  const auto elsewhere = folder_.path() / "elsewhere";
  const auto entry = mesh_entry();
  std::filesystem::rename(entry, elsewhere);
  std::filesystem::create_symlink(elsewhere, entry);
  expect_meshes(1, 0);
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  ASSERT_EQ(chown(mesh_entry().c_str(), 12345, 12345), 0);
  expect_meshes(1, 0);
}

// Files that are named from a folder depend on where it is.
TEST_F(Cache, NoticesThatALinkLeadsElsewhere) {
  const auto link = folder_.path() / "link";
  for (const char* name : {"one", "two"}) {
    std::filesystem::create_directory(folder_.path() / name);
    write_bytes(folder_.path() / name / "arm.msh", "a mesh");
  }
  recipe_.mesh.file = link / "arm.msh";
  std::filesystem::create_symlink("one", link);
  (void)ask();
  std::filesystem::remove(link);
  std::filesystem::create_symlink("two", link);
  expect_meshes(1, 0);
}

}  // namespace
}  // namespace limber::flexbody::test::mesh_record_test
