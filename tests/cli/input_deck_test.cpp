// SPDX-License-Identifier: BSD-3-Clause
// Meshes in input files of CalculiX through the command.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"

namespace limber::test::input_deck_test {
namespace {

using nlohmann::json;

constexpr const char* kMaterial =
    " --youngs-modulus 7e10 --poisson-ratio 0.3 --density 2700";

/// A bar of 1 m, 0.05 m and 0.03 m with 20 x 2 x 2 C3D20.
std::string write_bar() {
  constexpr std::array<int, 3> kCounts{20, 2, 2};
  constexpr std::array<double, 3> kSize{1.0, 0.05, 0.03};
  std::map<std::array<int, 3>, int> numbers;  // of places on half a grid
  std::string nodes;
  const auto find_node = [&](int i, int j, int k) {
    const auto [found, is_new] =
        numbers.try_emplace({i, j, k}, static_cast<int>(numbers.size()) + 1);
    if (is_new)
      nodes += fmt::format("{}, {:.15g}, {:.15g}, {:.15g}\n", found->second,
                           0.5 * i / kCounts[0] * kSize[0],
                           0.5 * j / kCounts[1] * kSize[1],
                           0.5 * k / kCounts[2] * kSize[2]);
    return found->second;
  };
  // Corners, then the bottom's, the top's and the upright edges' middles.
  constexpr std::array<std::array<int, 3>, 20> kPlaces{
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
       {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
       {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
       {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}};
  std::string elements;
  std::string root;
  int number = 0;
  for (int i = 0; i < kCounts[0]; ++i)
    for (int j = 0; j < kCounts[1]; ++j)
      for (int k = 0; k < kCounts[2]; ++k) {
        elements += std::to_string(++number);
        for (std::size_t n = 0; n < kPlaces.size(); ++n)
          elements += fmt::format(
              "{}{}", n == 10 ? ",\n " : ", ",
              find_node(2 * i + kPlaces[n][0], 2 * j + kPlaces[n][1],
                        2 * k + kPlaces[n][2]));
        elements += "\n";
        if (i == 0) root += fmt::format("{}, S6\n", number);
      }
  std::string at_root;
  for (const auto& [place, node] : numbers)
    if (place[0] == 0) at_root += fmt::format("{},\n", node);
  return "*NODE\n" + nodes + "*ELEMENT, TYPE=C3D20, ELSET=Bar\n" + elements +
         "*NSET, NSET=Root\n" + at_root + "*SURFACE, NAME=Wall\n" + root;
}

json list_modes(const Workspace& place, const std::string& more) {
  const CommandResult result =
      place.limber("modes bar.inp --json --count 3" + more + kMaterial);
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.out, nullptr, false);
}

// CalculiX 2.20 on this mesh: 967655.3 (rad/s)^2, 0.9676553E+06 in its print.
TEST(InputDeck, HasTheFrequenciesThatCalculixFinds) {
  const Workspace place;
  place.write("bar.inp", write_bar());
  const json free = list_modes(place, "");
  EXPECT_NEAR(free["eigenvalues"][0].get<double>() / 0.9676553e6, 1.0, 1e-7);
  EXPECT_NEAR(free["mass"].get<double>(), 2700.0 * 0.05 * 0.03, 1e-12);
  const json by_nodes = list_modes(place, " --clamp Root");
  const json by_faces = list_modes(place, " --clamp Wall");
  EXPECT_EQ(by_nodes["eigenvalues"], by_faces["eigenvalues"]);
  EXPECT_LT(by_nodes["eigenvalues"][0].get<double>(),
            0.1 * free["eigenvalues"][0].get<double>());
}

TEST(InputDeck, IsRefusedWithItsLine) {
  const Workspace place;
  place.write("bar.inp", write_bar() + "*ELEMENT, TYPE=MASS\n900, 1\n");
  const CommandResult result =
      place.limber(std::string("modes bar.inp") + kMaterial);
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.errors.find("elements MASS would be lost"),
            std::string::npos)
      << result.errors;
}

}  // namespace
}  // namespace limber::test::input_deck_test
