// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "limber/flexbody/file/cache.hpp"
#include "unit/flexbody/file/small_recipe.hpp"
#include "unit/flexbody/files.hpp"
#include "unit/flexbody/small_body.hpp"

namespace limber::flexbody::test {

/// Uses a separate cache, and counts meshings and reductions. The mesh depends
/// on the file's content except for its comment.
class Cache : public ::testing::Test {
 protected:
  Cache() : recipe_(make_recipe(folder_.path() / "arm.msh")) {
    write_bytes(recipe_.mesh.file, "a mesh");
    write_bytes(library(), "Gmsh");
  }
  CachedBody ask() { return ask_in(cache()); }
  CachedBody ask_in(const std::filesystem::path& cache) {
    return load_or_reduce(recipe_, cache, reducer());
  }
  Reducer reducer() {
    return {"mesher", [this](const MeshSource& source) {
              ++meshes_;
              return MeshAtHand{make_record(source), [this](const Recipe& r) {
                                  ++reductions_;
                                  ReducedBody body = make_small_body(1);
                                  body.name = r.name;
                                  if (makes_stress_ && r.stress) {
                                    add_stress(body);
                                  }
                                  return body;
                                }};
            }};
  }
  [[nodiscard]] MeshRecord make_record(const MeshSource& source) const {
    const std::string text = read_bytes(source.file);
    return {"mesh of " + text.substr(0, text.find("//")),
            {"a notice"},
            {"found"},
            {stamp_content(source.file), stamp_version(library())},
            is_repeatable_};
  }
  [[nodiscard]] std::filesystem::path library() const {
    return folder_.path() / "libgmsh.so";
  }
  // The expected result.
  [[nodiscard]] ReducedBody expected() const {
    ReducedBody body = make_small_body(1);
    body.name = recipe_.name;
    body.content_key = key();
    return body;
  }
  [[nodiscard]] std::string key() const {
    return content_key(recipe_, make_record(recipe_.mesh).content);
  }
  // Of one point a row.
  static void add_stress(ReducedBody& body) {
    const auto rows = std::ssize(body.rows.tags);
    const Eigen::Index m = body.lambda.size();
    StressModes& modes = body.stress.emplace();
    for (std::size_t row = 0; row < body.rows.tags.size(); ++row) {
      modes.rows.push_back(row);
    }
    modes.materials.assign(body.rows.tags.size(), 0);
    modes.on_surface.assign(body.rows.tags.size(), 1);
    modes.Sigma_B = MatrixX::Ones(6 * rows, m);
    modes.averaging = MatrixX::Identity(m, m);
    modes.constants = Eigen::Vector2d(70e9, 0.3);
    modes.interface_rows.resize(body.interfaces.size());
  }
  // The entry was unusable: it is made again, and then used.
  void expect_made_anew() {
    const int before = reductions_;
    const CachedBody made = ask();
    EXPECT_FALSE(made.was_cached);
    EXPECT_EQ(find_difference(made.body, expected()), "");
    const CachedBody found = ask();
    EXPECT_TRUE(found.was_cached);
    EXPECT_EQ(find_difference(found.body, expected()), "");
    EXPECT_EQ(reductions_, before + 1);
  }
  [[nodiscard]] std::filesystem::path cache() const {
    return folder_.path() / "cache" / "limber";
  }
  [[nodiscard]] std::filesystem::path entry() const {
    return cache() / (key() + ".h5");
  }
  // Of the meshes, the only one.
  [[nodiscard]] std::filesystem::path mesh_entry() const {
    for (const auto& file : std::filesystem::directory_iterator(cache())) {
      if (file.path().extension() == ".mesh") return file.path();
    }
    return {};
  }
  // Requests the body twice, and returns the number of meshings of each; the
  // body was known.
  void expect_meshes(int first, int second) {
    for (const int expected : {first, second}) {
      const int before = meshes_;
      EXPECT_TRUE(ask().was_cached);
      EXPECT_EQ(meshes_ - before, expected);
    }
  }

  TemporaryFolder folder_;
  Recipe recipe_;
  bool is_repeatable_ = true;
  bool makes_stress_ = false;  // as the library does
  std::atomic<int> meshes_ = 0;
  std::atomic<int> reductions_ = 0;
};

}  // namespace limber::flexbody::test
