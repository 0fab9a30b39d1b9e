// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "flexbody/body_file.hpp"
#include "flexbody/geometry_files.hpp"
#include "unit/flexbody/files.hpp"
#include "unit/flexbody/small_body.hpp"

namespace limber::flexbody::test {
namespace {

using ::testing::HasSubstr;

// A recipe in which every list has an entry; its mesh is never meshed.
Recipe make_recipe(const std::filesystem::path& mesh) {
  Recipe recipe;
  recipe.name = "upper arm";
  recipe.mesh = {mesh, 0.1, 2, 0.001};
  recipe.materials = {{"steel", {210e9, 0.3, 7800.0}}};
  recipe.clamped_groups = {"base"};
  recipe.interfaces = {{"root", GroupNodes{"root"}, Weighting::uniform, true}};
  recipe.load_patterns = {
      {"root", Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)}};
  return recipe;
}

class ContentKey : public ::testing::Test {
 protected:
  ContentKey() { write_bytes(mesh(), "a mesh"); }
  [[nodiscard]] std::filesystem::path mesh() const {
    return folder_.path() / "arm.msh";
  }
  TemporaryFolder folder_;
};

using Changes =
    std::vector<std::pair<std::string, std::function<void(Recipe&)>>>;

Changes list_mesh_and_material_changes() {
  return {
      {"size", [](Recipe& r) { r.mesh.size = 0.2; }},
      {"order", [](Recipe& r) { r.mesh.order = 1; }},
      {"unit", [](Recipe& r) { r.mesh.unit = 1.0; }},
      {"region", [](Recipe& r) { r.materials[0].group = "iron"; }},
      {"E", [](Recipe& r) { r.materials[0].material.youngs_modulus = 70e9; }},
      {"nu", [](Recipe& r) { r.materials[0].material.poisson_ratio = 0.31; }},
      {"rho", [](Recipe& r) { r.materials[0].material.density = 2700.0; }},
      {"second material",
       [](Recipe& r) {
         r.materials.push_back({"", {1e9, 0.0, 1.0}});
       }},
      {"no material", [](Recipe& r) { r.materials.clear(); }},
      {"clamped", [](Recipe& r) { r.clamped_groups[0] = "bases"; }},
      {"second clamped",
       [](Recipe& r) {
         r.clamped_groups = {"ba", "se"};
       }},
      {"none clamped", [](Recipe& r) { r.clamped_groups.clear(); }},
  };
}

Changes list_interface_changes() {
  const auto select = [](const NodeSelection& nodes) {
    return [nodes](Recipe& r) { r.interfaces[0].nodes = nodes; };
  };
  const Vector3 p(1.0, 2.0, 3.0);
  const Vector3 q(1.0, 2.0, 4.0);
  return {
      {"interface", [](Recipe& r) { r.interfaces[0].name = "foot"; }},
      {"weighting",
       [](Recipe& r) { r.interfaces[0].weighting = Weighting::equal; }},
      {"static modes", [](Recipe& r) { r.interfaces[0].static_modes = false; }},
      {"group", select(GroupNodes{"other"})},
      {"tag 1", select(TaggedNode{1})},
      {"tag 2", select(TaggedNode{2})},
      {"nearest p", select(NearestNode{p})},
      {"nearest q", select(NearestNode{q})},
      {"box p q", select(BoxNodes{p, q})},
      {"box q p", select(BoxNodes{q, p})},
      {"plane", select(PlaneNodes{p, q.normalized(), 0.0})},
      {"plane elsewhere", select(PlaneNodes{q, q.normalized(), 0.0})},
      {"plane turned", select(PlaneNodes{p, p.normalized(), 0.0})},
      {"plane widened", select(PlaneNodes{p, q.normalized(), 0.1})},
      {"cylinder", select(CylinderNodes{p, q, 1.0, 0.0})},
      {"cylinder backwards", select(CylinderNodes{q, p, 1.0, 0.0})},
      {"cylinder longer", select(CylinderNodes{p, 2.0 * q, 1.0, 0.0})},
      {"cylinder widened", select(CylinderNodes{p, q, 1.5, 0.0})},
      {"tube", select(CylinderNodes{p, q, 1.0, 0.5})},
      {"second interface",
       [](Recipe& r) {
         r.interfaces.push_back({"tip", GroupNodes{"tip"}});
       }},
      {"no interface", [](Recipe& r) { r.interfaces.clear(); }},
  };
}

Changes list_load_and_basis_changes() {
  return {
      {"loaded", [](Recipe& r) { r.load_patterns[0].interface = "tip"; }},
      {"force", [](Recipe& r) { r.load_patterns[0].force[2] = 3.5; }},
      {"moment", [](Recipe& r) { r.load_patterns[0].moment[0] = 4.5; }},
      {"second load",
       [](Recipe& r) { r.load_patterns.push_back(r.load_patterns[0]); }},
      {"no load", [](Recipe& r) { r.load_patterns.clear(); }},
      {"eigenmodes", [](Recipe& r) { r.basis.eigenmodes = 11; }},
      {"interface modes", [](Recipe& r) { r.basis.interface_modes = false; }},
      {"load modes", [](Recipe& r) { r.basis.load_modes = false; }},
      {"terms", [](Recipe& r) { r.basis.terms = 2; }},
      {"tolerance", [](Recipe& r) { r.basis.drop_tolerance = 1e-9; }},
      {"all rows", [](Recipe& r) { r.rows = parse_rows({"all"}); }},
      {"few rows", [](Recipe& r) { r.rows = parse_rows({"interfaces"}); }},
      {"a group's rows", [](Recipe& r) { r.rows = parse_rows({"side"}); }},
  };
}

Changes list_automatic_changes() {
  const auto choose = [](const AutomaticModes& automatic) {
    return [automatic](Recipe& r) { r.basis.automatic = automatic; };
  };
  const auto force = [](const NodalForces& forces) {
    return [forces](Recipe& r) { r.nodal_forces = {forces}; };
  };
  const MatrixX row = MatrixX::Ones(1, 2);
  return {
      {"automatic", choose({})},
      {"threshold", choose({0.8})},
      {"measure", choose({0.9, ModeMeasure::report})},
      {"candidates", choose({0.9, ModeMeasure::compliance, 61})},
      {"case alone", [](Recipe& r) { r.load_patterns[0].static_mode = false; }},
      {"forces", force({"f", {0.0, 1.0}, row})},
      {"other forces", force({"f", {0.0, 1.0}, 2.0 * row})},
      {"forces at other times", force({"f", {0.0, 2.0}, row})},
      {"forces of another name", force({"g", {0.0, 1.0}, row})},
      {"displacement",
       [](Recipe& r) { r.initial_displacement.values = VectorX::Ones(3); }},
      {"velocity",
       [](Recipe& r) { r.initial_velocity.values = VectorX::Ones(3); }},
      {"another velocity",
       [](Recipe& r) { r.initial_velocity.values = VectorX::Zero(3); }},
      {"forces of another shape", force({"f", {0.0}, row.transpose()})},
  };
}

TEST_F(ContentKey, DiffersForEveryFieldThatShapesTheBody) {
  std::map<std::string, std::string> change_of = {
      {content_key(make_recipe(mesh())), "nothing"}};
  for (const Changes& changes :
       {list_mesh_and_material_changes(), list_interface_changes(),
        list_load_and_basis_changes(), list_automatic_changes()}) {
    for (const auto& [name, change] : changes) {
      Recipe recipe = make_recipe(mesh());
      change(recipe);
      const auto [at, is_new] = change_of.emplace(content_key(recipe), name);
      EXPECT_TRUE(is_new) << name << " and " << at->second;
    }
  }
}

TEST_F(ContentKey, IgnoresTheBodysNameAndTheMeshsPlace) {
  const Recipe recipe = make_recipe(mesh());
  const auto elsewhere = folder_.path() / "copy.msh";
  std::filesystem::copy(mesh(), elsewhere);
  Recipe other = make_recipe(elsewhere);
  other.name = "fore arm";
  EXPECT_EQ(content_key(recipe), content_key(other));
}

TEST_F(ContentKey, DiffersForEveryByteOfTheMesh) {
  std::string bytes = "a mesh";
  std::map<std::string, std::string> bytes_of;
  for (char& byte : bytes) {
    byte = static_cast<char>(byte + 1);
    write_bytes(mesh(), bytes);
    bytes_of.emplace(content_key(make_recipe(mesh())), bytes);
  }
  write_bytes(mesh(), bytes + '\0');
  bytes_of.emplace(content_key(make_recipe(mesh())), bytes + '\0');
  EXPECT_EQ(bytes_of.size(), 7U);
}

TEST_F(ContentKey, DiffersForTheKindOfTheMeshFile) {
  const auto step = folder_.path() / "arm.step";
  std::filesystem::copy(mesh(), step);
  EXPECT_NE(content_key(make_recipe(mesh())), content_key(make_recipe(step)));
}

TEST_F(ContentKey, FollowsTheFilesThatAScriptIncludes) {
  const auto script = folder_.path() / "arm.geo";
  std::filesystem::create_directory(folder_.path() / "parts");
  write_bytes(script, "Include \"parts/beam.geo\";\n");
  write_bytes(folder_.path() / "parts/beam.geo",
              "Include \"../arm.geo\"; Merge \"data.step\";\n");
  write_bytes(folder_.path() / "parts/data.step", "one");
  const std::string key = content_key(make_recipe(script));
  EXPECT_EQ(content_key(make_recipe(script)), key);
  write_bytes(folder_.path() / "parts/data.step", "two");
  EXPECT_NE(content_key(make_recipe(script)), key);
}

TEST_F(ContentKey, AcceptsAScriptWhoseIncludesAreCutShort) {
  const auto script = folder_.path() / "arm.geo";
  for (const std::string text :
       {"\"quoted\" Include", "Include \"", "Merge \"missing.step\";"}) {
    write_bytes(script, text);
    EXPECT_EQ(content_key(make_recipe(script)).size(), 32U);
  }
  write_bytes(script, "Merge \"" + std::string(100000, 'x') + "\";");
  EXPECT_EQ(content_key(make_recipe(script)).size(), 32U);
}

TEST_F(ContentKey, OfAMissingMeshIsAnInputErrorThatNamesIt) {
  for (const char* name : {"missing.msh", "missing.geo"}) {
    const auto missing = folder_.path() / name;
    EXPECT_THAT(
        find_input_error([&] { (void)content_key(make_recipe(missing)); }),
        HasSubstr(missing.string()));
  }
}

TEST_F(ContentKey, FollowsWhateverASecondFileIsNamedBy) {
  const auto script = folder_.path() / "ARM.GEO";
  const auto part = folder_.path() / "part.txt";
  for (const std::string text :
       {"Merge 'part.txt';", "Include \"part.txt\";",
        "v() = ShapeFromFile(\"part.txt\");", "l() = ListFromFile('part.txt');",
        "Field[1].FileName = \"part.txt\";", "If(FileExists(\"part.txt\"))",
        "Include /* a */ \"part.txt\" // b\n;"}) {
    write_bytes(script, text);
    write_bytes(part, "one");
    const std::string key = content_key(make_recipe(script));
    EXPECT_EQ(content_key(make_recipe(script)), key) << text;
    write_bytes(part, "two");
    const std::string other = content_key(make_recipe(script));
    EXPECT_NE(other, key) << text;
    std::filesystem::remove(part);
    EXPECT_NE(content_key(make_recipe(script)), other) << text;
    EXPECT_TRUE(find_geometry_files(script).is_complete) << text;
  }
}

TEST_F(ContentKey, KnowsWhenAScriptPutsNamesTogether) {
  const auto script = folder_.path() / "arm.geo";
  for (const std::string text :
       {"Include Sprintf(\"a%g\", 1);", "Include Str(\"a\", \"b\");",
        "Merge name;", "Include \"a\" + x;", "l() = ListFromFile(name);",
        "Field[1].FileName = Str(\"a\");", "Plugin(Skin).Run;",
        "MergeWithBoundingBox StrCat(\"a\", \"b\");"}) {
    write_bytes(script, text);
    EXPECT_FALSE(find_geometry_files(script).is_complete) << text;
  }
  for (const std::string text :
       {"", "Point(1) = {0, 0, 0};", "// Include Sprintf(\"a\");",
        "/* Merge name; */", "x = \"Include name\";", "Include \"a\";"}) {
    write_bytes(script, text);
    EXPECT_TRUE(find_geometry_files(script).is_complete) << text;
  }
}

// Asks a cache of its own, and counts how often it had to reduce.
class Cache : public ::testing::Test {
 protected:
  Cache() : recipe_(make_recipe(folder_.path() / "arm.msh")) {
    write_bytes(recipe_.mesh.file, "a mesh");
  }
  CachedBody ask() { return ask_in(cache()); }
  CachedBody ask_in(const std::filesystem::path& cache) {
    return load_or_reduce(recipe_, cache, [this](const Recipe& recipe) {
      ++reductions_;
      ReducedBody body = make_small_body(1);
      body.name = recipe.name;
      return body;
    });
  }
  // What every answer must be.
  [[nodiscard]] ReducedBody expected() const {
    ReducedBody body = make_small_body(1);
    body.name = recipe_.name;
    body.content_key = content_key(recipe_);
    return body;
  }
  // The entry was unusable: it is made anew, and then used.
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
    return cache() / (content_key(recipe_) + ".h5");
  }

  TemporaryFolder folder_;
  Recipe recipe_;
  std::atomic<int> reductions_ = 0;
};

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
  const auto fail = [](const Recipe&) -> ReducedBody {
    throw NumericalError("no convergence");
  };
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
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(cache()), {}),
              1);
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

// Sets a variable of the environment, or takes it away, for a while.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) const {
    if (value) {
      setenv(name_, value, 1);
    } else {
      unsetenv(name_);
    }
  }
  const char* name_;
  std::optional<std::string> old_;
};

TEST(DefaultCacheFolder, IsTheFirstOfLimbersXdgsAndHomes) {
  const Variable home("HOME", "/home/me");
  const Variable no_xdg("XDG_CACHE_HOME", nullptr);
  const Variable no_own("LIMBER_CACHE", nullptr);
  EXPECT_EQ(default_cache_folder(), "/home/me/.cache/limber");
  const Variable xdg("XDG_CACHE_HOME", "/xdg");
  EXPECT_EQ(default_cache_folder(), "/xdg/limber");
  const Variable own("LIMBER_CACHE", "/own");
  EXPECT_EQ(default_cache_folder(), "/own");
}

TEST(DefaultCacheFolder, IsNotGuessedWhereThereIsNoHome) {
  const Variable no_xdg("XDG_CACHE_HOME", nullptr);
  const Variable no_own("LIMBER_CACHE", nullptr);
  for (const char* home : {static_cast<const char*>(nullptr), "", "relative"}) {
    const Variable set("HOME", home);
    EXPECT_THAT(find_input_error([] { (void)default_cache_folder(); }),
                HasSubstr("--cache"));
  }
}

}  // namespace
}  // namespace limber::flexbody::test
