// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace limber::manifest_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Spring {
  double stiffness = 10.0;
  VectorX table = VectorX::LinSpaced(20, 0.0, 1.0);
};
constexpr auto fields_of(const Spring*) {
  return list_fields("spring", "stiffness [N/m]", "table [N]");
}

struct Stop {
  double lower = 0.0;
};
constexpr auto fields_of(const Stop*) {
  return list_fields("stop", "lower [m]");
}

struct Coupler {
  std::string name;
  std::variant<Spring, Stop> law;
  std::shared_ptr<const Stop> limit;
  std::function<void()> helper = {};
};
constexpr auto fields_of(const Coupler*) {
  return list_fields("coupler", "name", "law", "limit", nullptr);
}

using System = std::vector<Coupler>;

Manifest make(const System& system) {
  Manifest manifest;
  describe(manifest, "couplers", system);
  return manifest;
}

System make_system() {
  return {{"elbow", Spring{}, nullptr, {}}, {"wrist", Stop{}, nullptr, {}}};
}

std::vector<std::string> compare_with(const System& changed) {
  return find_differences(make(make_system()), make(changed));
}

TEST(Manifest, OfTheSameThingsHasNoDifferences) {
  EXPECT_THAT(compare_with(make_system()), IsEmpty());
  const Manifest manifest = make(make_system());
  EXPECT_THAT(find_differences(manifest, Manifest(manifest.text())), IsEmpty());
}

TEST(Manifest, NamesAChangedValueWithItsUnit) {
  System changed = make_system();
  std::get<Spring>(changed[0].law).stiffness = 100.0;
  EXPECT_THAT(compare_with(changed),
              ElementsAre("coupler 'elbow', spring, stiffness: 10 -> 100 N/m"));
}

TEST(Manifest, SeesTheLastBitOfANumberAlsoInALongList) {
  System changed = make_system();
  auto& spring = std::get<Spring>(changed[0].law);
  spring.stiffness = std::nextafter(10.0, 11.0);
  spring.table[7] = std::nextafter(spring.table[7], 1.0);
  EXPECT_THAT(compare_with(changed),
              ElementsAre("coupler 'elbow', spring, stiffness: 10 -> "
                          "10.000000000000002 N/m",
                          "coupler 'elbow', spring, table: other values (20 "
                          "numbers from 0 to 1)"));
}

TEST(Manifest, TellsOnceWhatIsNewAndWhatIsGone) {
  System changed = make_system();
  changed[0].law = Stop{};
  changed[1].name = "knee";
  EXPECT_THAT(
      compare_with(changed),
      ElementsAre("coupler 'elbow', stop is new", "coupler 'knee' is new",
                  "coupler 'elbow', spring is gone",
                  "coupler 'wrist' is gone"));
}

TEST(Manifest, TellsThatAnOrderHasChanged) {
  System changed = make_system();
  std::swap(changed[0], changed[1]);
  EXPECT_THAT(compare_with(changed),
              ElementsAre("the same entries in another order"));
}

TEST(Manifest, KeepsNamesApartWhateverIsInThem) {
  const System a = {{"x\tname\ty\n", Stop{}, nullptr, {}}};
  const System b = {{"x\\tname\\ty\\n", Stop{}, nullptr, {}}};
  EXPECT_FALSE(find_differences(make(a), make(b)).empty());
}

TEST(Manifest, DoesNotSayThatTwoOfOneNameAreOne) {
  System changed = make_system();
  changed[1] = changed[0];
  System other = changed;
  std::get<Spring>(other[1].law).stiffness = 11.0;
  EXPECT_FALSE(find_differences(make(changed), make(other)).empty());
}

}  // namespace
}  // namespace limber::manifest_test
