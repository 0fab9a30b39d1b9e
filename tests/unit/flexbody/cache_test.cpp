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

using Changes =
    std::vector<std::pair<std::string, std::function<void(Recipe&)>>>;

Changes list_mesh_and_material_changes() {
  return {
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

TEST(ContentKey, DiffersForEveryFieldThatShapesTheBody) {
  std::map<std::string, std::string> change_of = {
      {content_key(make_recipe("arm.msh"), "mesh"), "nothing"},
      {content_key(make_recipe("arm.msh"), "other mesh"), "mesh"}};
  for (const Changes& changes :
       {list_mesh_and_material_changes(), list_interface_changes(),
        list_load_and_basis_changes(), list_automatic_changes()}) {
    for (const auto& [name, change] : changes) {
      Recipe recipe = make_recipe("arm.msh");
      change(recipe);
      const auto [at, is_new] =
          change_of.emplace(content_key(recipe, "mesh"), name);
      EXPECT_TRUE(is_new) << name << " and " << at->second;
    }
  }
}

TEST(ContentKey, IgnoresTheBodysNameAndHowTheMeshWasMade) {
  Recipe other = make_recipe("elsewhere.geo");
  other.name = "fore arm";
  other.mesh.size = 0.3;
  EXPECT_EQ(content_key(make_recipe("arm.msh"), "mesh"),
            content_key(other, "mesh"));
}

TEST(RecipeKey, IsOneForAskersOfOneFileInOneWay) {
  const Recipe recipe = make_recipe("arm.msh");
  Recipe same = recipe;
  same.name = "fore arm";
  EXPECT_EQ(recipe_key(recipe), recipe_key(same));
  const std::vector<std::function<void(Recipe&)>> changes = {
      [](Recipe& r) { r.mesh.file = "arm.geo"; },
      [](Recipe& r) { r.mesh.size = 0.2; }, [](Recipe& r) { r.mesh.order = 1; },
      [](Recipe& r) { r.mesh.unit = 1.0; },
      [](Recipe& r) { r.basis.eigenmodes = 11; }};
  for (const auto& change : changes) {
    Recipe other = recipe;
    change(other);
    EXPECT_NE(recipe_key(recipe), recipe_key(other));
  }
}

// Asks a cache of its own, and counts how often it had to mesh and to reduce.
// The mesh is what the file says, without its comment.
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
                                  return body;
                                }};
            }};
  }
  [[nodiscard]] MeshRecord make_record(const MeshSource& source) const {
    const std::string text = read_bytes(source.file);
    return {"mesh of " + text.substr(0, text.find("//")),
            {"a notice"},
            {stamp_content(source.file), stamp_version(library())},
            is_repeatable_};
  }
  [[nodiscard]] std::filesystem::path library() const {
    return folder_.path() / "libgmsh.so";
  }
  // What every answer must be.
  [[nodiscard]] ReducedBody expected() const {
    ReducedBody body = make_small_body(1);
    body.name = recipe_.name;
    body.content_key = key();
    return body;
  }
  [[nodiscard]] std::string key() const {
    return content_key(recipe_, make_record(recipe_.mesh).content);
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
    return cache() / (key() + ".h5");
  }
  // Of the meshes, the only one.
  [[nodiscard]] std::filesystem::path mesh_entry() const {
    for (const auto& file : std::filesystem::directory_iterator(cache())) {
      if (file.path().extension() == ".mesh") return file.path();
    }
    return {};
  }
  // Asks twice, and tells how many meshes each needed; the body was known.
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
  std::atomic<int> meshes_ = 0;
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
    // The body and the record of its mesh.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(cache()), {}),
              2);
  }
}

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
