// SPDX-License-Identifier: BSD-3-Clause
#include "verification/example_audits.hpp"

namespace limber::verification::example_audits_slow {
namespace {

// A hundredth of what users are warned of.
TEST(ExampleAudit, ClosesToATenThousandthAsTheFilesAre) {
  for (const std::filesystem::path& file : find_examples()) {
    SCOPED_TRACE(file.filename());
    EXPECT_LE(audit_scene(scene::load_scene(file)).drift,
              0.01 * dynamics::kReportedDrift);
  }
}

}  // namespace
}  // namespace limber::verification::example_audits_slow
