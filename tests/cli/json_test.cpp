// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "cli/command.hpp"

namespace limber::test {
namespace {

using testing::HasSubstr;

const std::string kBeam = LIMBER_SOURCE_DIR "/meshes/beam579.msh";
const std::string kExample = LIMBER_SOURCE_DIR "/examples/report_beam.toml";

void expect_json(const CommandResult& result,
                 const std::vector<std::string>& keys) {
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(is_one_json_object(result.out)) << result.out;
  for (const std::string& key : keys) {
    EXPECT_THAT(result.out, HasSubstr("\"" + key + "\":"));
  }
}

TEST(Json, OfModesHasThePromisedKeys) {
  const Workspace place;
  expect_json(place.limber("modes '" + kBeam +
                           "' --youngs-modulus 200e9 --poisson-ratio 0 "
                           "--density 8000 --count 3 --json"),
              {"nodes", "elements", "boundary_nodes", "mass", "center_of_mass",
               "inertia", "eigenvalues", "frequencies_hz"});
}

TEST(Json, OfRunHasThePromisedKeysAndLeavesResults) {
  const Workspace place;
  expect_json(place.limber("run '" + kExample + "' --out results --json"),
              {"steps", "newton_iterations", "seconds_offline",
               "seconds_online", "energy", "initial", "final", "dissipated",
               "work", "drift", "probes", "peak"});
  for (const char* name : {"summary.json", "probes.csv", "results.h5"}) {
    EXPECT_TRUE(std::filesystem::exists(place.folder() / "results" / name))
        << name;
  }
}

TEST(Json, OfCompareTabulatesDifferences) {
  const Workspace place;
  expect_json(
      place.limber("compare '" + kExample +
                   "' --fidelity rigid,coupled --out results --json"),
      {"reference", "levels", "difference", "rms", "max", "seconds_online"});
}

TEST(Json, OfInfoTellsTheKind) {
  const Workspace place;
  expect_json(place.limber("info '" + kBeam + "' --json"), {"kind", "nodes"});
  expect_json(place.limber("info '" + kExample + "' --json"), {"kind"});
}

}  // namespace
}  // namespace limber::test
