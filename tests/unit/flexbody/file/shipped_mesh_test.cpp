// SPDX-License-Identifier: BSD-3-Clause
// Bodies that came with Limber: when one is taken in place of a reduction.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "unit/flexbody/file/cache_fixture.hpp"

namespace limber::flexbody::test::shipped_mesh_test {
namespace {

namespace fs = std::filesystem;

/// A folder with the body of `arm.msh`, as it comes with Limber; the cache of
/// the user is empty.
class ShippedBody : public Cache {
 protected:
  ShippedBody() {
    (void)ask_in(shipped());
    EXPECT_TRUE(
        ship_mesh_record(make_record(recipe_.mesh), recipe_.mesh, shipped()));
    for (const auto& file : fs::directory_iterator(shipped())) {
      if (file.path().extension() == ".mesh") fs::remove(file.path());
    }
    meshes_ = 0;
    reductions_ = 0;
  }
  [[nodiscard]] fs::path shipped() const { return folder_.path() / "shipped"; }
  CachedBody ask_with_shipped() {
    return load_or_reduce(recipe_, cache(), reducer(), {}, shipped());
  }
  /// The body is the expected one, however it was found.
  void expect(bool is_shipped) {
    const CachedBody found = ask_with_shipped();
    EXPECT_EQ(found.was_cached, is_shipped);
    EXPECT_EQ(meshes_, is_shipped ? 0 : 1);
    EXPECT_EQ(reductions_, is_shipped ? 0 : 1);
    EXPECT_EQ(find_difference(found.body, expected()), "");
  }
};

TEST_F(ShippedBody, NeedsNeitherAMeshNorAReduction) { expect(true); }

TEST_F(ShippedBody, IsFoundWhereverTheMeshIsAndWhateverPrograms) {
  const fs::path elsewhere = folder_.path() / "elsewhere";
  fs::create_directory(elsewhere);
  fs::rename(recipe_.mesh.file, elsewhere / "arm.msh");
  fs::remove(library());
  recipe_.mesh.file = elsewhere / "arm.msh";
  EXPECT_TRUE(ask_with_shipped().was_cached);
  EXPECT_EQ(meshes_ + reductions_, 0);
}

TEST_F(ShippedBody, IsNotTakenForAChangedMesh) {
  write_bytes(recipe_.mesh.file, "another mesh");
  expect(false);
}

TEST_F(ShippedBody, IsNotTakenForAnotherSizeOfElements) {
  recipe_.mesh.size = 0.2;
  expect(false);
}

TEST_F(ShippedBody, IsNotTakenForAnotherBasis) {
  recipe_.basis.eigenmodes += 1;
  expect(false);
}

TEST_F(ShippedBody, IsNotTakenIfItIsDamagedOrOthersCanWriteIt) {
  const fs::path body = shipped() / (key() + ".h5");
  fs::permissions(body, fs::perms::others_write, fs::perm_options::add);
  expect(false);
  fs::remove_all(cache());
  meshes_ = reductions_ = 0;
  write_bytes(body, "text");
  expect(false);
}

TEST_F(ShippedBody, KeepsItsTimeWhenItIsUsed) {
  const fs::path body = shipped() / (key() + ".h5");
  const auto before = fs::last_write_time(body) - std::chrono::hours(1);
  fs::last_write_time(body, before);
  expect(true);
  EXPECT_EQ(fs::last_write_time(body), before);
}

TEST_F(ShippedBody, DependsOnTheFilesBesideItsMesh) {
  const fs::path part = folder_.path() / "part.geo";
  MeshRecord record = make_record(recipe_.mesh);
  record.files.push_back(stamp_presence(part));
  ASSERT_TRUE(ship_mesh_record(record, recipe_.mesh, shipped()));
  EXPECT_TRUE(find_shipped_mesh(recipe_.mesh, shipped()));
  write_bytes(part, "now it is there");
  EXPECT_FALSE(find_shipped_mesh(recipe_.mesh, shipped()));
}

TEST_F(ShippedBody, HasNoRecordOfAMeshThatReadsFilesElsewhere) {
  MeshRecord record = make_record(recipe_.mesh);
  record.files.push_back(stamp_content("/etc/hostname"));
  EXPECT_FALSE(ship_mesh_record(record, recipe_.mesh, shipped()));
  record = make_record(recipe_.mesh);
  record.is_repeatable = false;
  EXPECT_FALSE(ship_mesh_record(record, recipe_.mesh, shipped()));
}

}  // namespace
}  // namespace limber::flexbody::test::shipped_mesh_test
