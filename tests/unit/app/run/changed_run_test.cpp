// SPDX-License-Identifier: BSD-3-Clause
// Any change of a scenario or its robot between a run and its resumption is
// rejected as another run, or does not change the results in any bit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>

#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/runs/run_manifest.hpp"
#include "places.hpp"
#include "unit/app/run/changed_run_scene.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::app::changed_run_test {
namespace {

using scene::BuiltScene;
using scene::Scene;
using scene::test::SceneFolder;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string robot_text() {
  std::string text = kRobot;
  const std::string box = LIMBER_SOURCE_DIR "/meshes/box/box.geo";
  return text.replace(text.find("BOX"), 3, box);
}

/// A place in a text, and what may stand there instead: the first that can be
/// built counts.
struct Change {
  std::size_t at = 0;
  std::size_t length = 0;
  std::vector<std::string> by;
};

bool is_start_of_number(const std::string& text, std::size_t i) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           c == '.' || c == '-';
  };
  const bool has_digit =
      std::isdigit(static_cast<unsigned char>(text[i])) != 0 ||
      (text[i] == '-' &&
       std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0);
  return has_digit && !is_part(text[i - 1]);
}

/// Every number, a little different.
std::vector<Change> find_numbers(const std::string& text) {
  std::vector<Change> changes;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (!is_start_of_number(text, i)) continue;
    const std::size_t end = text.find_first_not_of("0123456789.e+-", i);
    const std::string word = text.substr(i, end - i);
    const double value = std::stod(word);
    Change change{i, word.size(), {}};
    if (word.find_first_of(".e") == std::string::npos) {
      const int whole = static_cast<int>(value);
      change.by = {std::to_string(whole + 1), std::to_string(whole - 1)};
    }
    for (const double factor : {1.25, 0.8}) {
      if (value == 0.0) break;
      change.by.push_back(fmt::format("{:.6e}", value * factor));
    }
    change.by.push_back(fmt::format("{:.6e}", value + 0.05));
    changes.push_back(change);
    i = end;
  }
  return changes;
}

/// Replacements of words.
std::vector<Change> find_words(const std::string& text) {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"'true'", "'false'"},
      {"= true", "= false"},
      {"\"generalized-alpha\"", "\"implicit-euler\""},
      {"\"coupled\"", "\"one-way\""},
      {"\"st-venant-kirchhoff\"", "\"neo-hookean\""},
      {"\"consistent\"", "\"lumped\""},
      {"\"world\"", "\"body\""},
      {"\"half-sine\"", "\"triangular\""},
      {"\"trapezoid\"", "\"smooth\""},
      {"kind = \"table\"", "kind = \"steps\""},
      {"\"zv\"", "\"zvd\""},
      {"\"displacement\"", "\"position\""},
      {"\"velocity\"", "\"position\""},
      {"\"force\"", "\"moment\""},
      {"side = \"M\"", "side = \"F\""},
      {"frame = \"F\"", "frame = \"world\""},
      {"coupler = \"wrist\"", "coupler = \"shoulder\""},
      {"name = \"tip\"", "name = \"top\""},
      {"\"push\"", "\"pull\""},
      {"interface = \"tip\"", "interface = \"root\""},
      {"link = \"hand\"", "link = \"sled\""},
      {"\"here\"", "\"there\""},
      {"type='revolute'", "type='continuous'"},
      {"'uniform'", "'equal'"},
      {"interface='tip'/>\n  <via", "interface='root'/>\n  <via"},
      {"<friction coulomb", "<!-- a note --><friction coulomb"},
      {"[gravity]", "# a note\n[gravity]"}};
  std::vector<Change> changes;
  for (const auto& [old, by] : pairs) {
    for (std::size_t at = text.find(old); at != std::string::npos;
         at = text.find(old, at + 1)) {
      changes.push_back({at, old.size(), {by}});
    }
  }
  return changes;
}

class ChangedRun : public ::testing::Test {
 protected:
  struct Built {
    BuiltScene scene;
    Manifest manifest;
  };

  Built build(const std::string& robot, const std::string& scenario) {
    const Scene scene = folder_.load(robot, scenario);
    Built built{
        scene::build_system(scene, make_reducer({}), folder_.path() / "cache"),
        {}};
    built.manifest = runs::make_manifest(scene, built.scene);
    return built;
  }

  /// All numbers that a run leaves at its outputs.
  static std::vector<double> run(const BuiltScene& built) {
    std::vector<double> numbers;
    dynamics::SystemState state = built.initial;
    dynamics::simulate(built.model, state, built.settings,
                       [&](const dynamics::SystemState& now,
                           const dynamics::EnergyBalance& energy) {
                         const auto row = scene::evaluate_all(built.probes,
                                                              built.model, now);
                         numbers.insert(numbers.end(), row.begin(), row.end());
                         numbers.push_back(energy.total());
                         numbers.push_back(energy.work);
                       });
    return numbers;
  }

  /// @returns the message, empty if the change has no effect
  std::vector<std::string> expect_reported(const Built& before,
                                           const Built& now,
                                           const std::string& what) {
    auto differences = find_differences(before.manifest, now.manifest);
    if (differences.empty()) {
      silent_.push_back(what);
      EXPECT_EQ(run(before.scene), run(now.scene)) << what;
    }
    return differences;
  }

  template <typename Build>
  void expect_all_reported(const std::string& text,
                           const std::vector<Change>& changes,
                           const Build& build_changed) {
    const Built before = build_changed(text);
    int tried = 0;
    for (const Change& change : changes) {
      for (const std::string& by : change.by) {
        std::string changed = text;
        changed.replace(change.at, change.length, by);
        try {
          const Built now = build_changed(changed);
          const std::size_t begin = text.rfind('\n', change.at - 30) + 1;
          expect_reported(before, now,
                          text.substr(begin, change.at - begin) + by);
        } catch (const InputError&) {
          continue;  // refused by the reader
        }
        ++tried;
        break;
      }
    }
    EXPECT_GT(tried, 0.8 * static_cast<double>(changes.size()));
  }

  std::vector<std::string> silent_;  // changes that change nothing

 private:
  SceneFolder folder_;
};

TEST_F(ChangedRun, OfTheSameFilesIsTheSameRun) {
  const Built one = build(robot_text(), kScenario);
  const Built other = build(robot_text(), kScenario);
  EXPECT_THAT(find_differences(one.manifest, other.manifest), IsEmpty());
}

TEST_F(ChangedRun, IsNamedForEveryNumberOfTheScenario) {
  expect_all_reported(
      kScenario, find_numbers(kScenario),
      [&](const std::string& t) { return build(robot_text(), t); });
  EXPECT_THAT(silent_,
              ElementsAre(HasSubstr("[advice]"), HasSubstr("checkpoint_")));
}

TEST_F(ChangedRun, IsNamedForEveryWordOfTheScenario) {
  expect_all_reported(
      kScenario, find_words(kScenario),
      [&](const std::string& t) { return build(robot_text(), t); });
}

TEST_F(ChangedRun, IsNamedForEveryNumberAndWordOfTheRobot) {
  std::vector<Change> changes = find_numbers(robot_text());
  const std::vector<Change> words = find_words(robot_text());
  changes.insert(changes.end(), words.begin(), words.end());
  expect_all_reported(robot_text(), changes, [&](const std::string& t) {
    return build(t, kScenario);
  });
}

TEST_F(ChangedRun, NamesTheCouplerAndItsOldAndNewStiffness) {
  std::string robot = robot_text();
  const Built before = build(robot, kScenario);
  const std::string old = "<spring stiffness='10'";
  robot.replace(robot.find(old), old.size(), "<spring stiffness='100'");
  EXPECT_THAT(
      find_differences(before.manifest, build(robot, kScenario).manifest),
      Contains("coupler 'shoulder', joint, element 1, spring, stiffness: "
               "10 -> 100 N/m, N m/rad"));
}

}  // namespace
}  // namespace limber::app::changed_run_test
