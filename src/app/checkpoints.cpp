// SPDX-License-Identifier: BSD-3-Clause
#include "app/checkpoints.hpp"

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "common/errors.hpp"
#include "dynamics/fingerprint.hpp"
#include "results/checkpoint_file.hpp"

namespace limber::app {
namespace {

// @param history empty but for its columns
dynamics::Checkpoint read_run(const std::filesystem::path& file,
                              const std::string& fingerprint,
                              results::History& history) {
  results::CheckpointRecord record = results::read_checkpoint(file);
  if (record.fingerprint != fingerprint) {
    throw InputError(fmt::format(
        "the checkpoint '{}' is of another run: the scenario, its robot or a "
        "mesh have changed since; run without --resume",
        file.string()));
  }
  history = std::move(record.history);
  return std::move(record.run);
}

}  // namespace

dynamics::Continuation make_continuation(const CheckpointPlan& plan,
                                         const scene::BuiltScene& built,
                                         results::History& history) {
  dynamics::Continuation continuation;
  if (plan.file.empty()) return continuation;
  const std::string fingerprint =
      dynamics::find_fingerprint(built.model, built.initial, built.settings);
  continuation.keeper.interval = plan.interval;
  continuation.keeper.keep = [file = plan.file, fingerprint,
                              &history](const dynamics::Checkpoint& run) {
    results::write_checkpoint(file, {fingerprint, run, history});
  };
  if (!plan.resumes) return continuation;
  if (std::filesystem::exists(plan.file)) {
    continuation.from = read_run(plan.file, fingerprint, history);
  } else {
    print_warnings({fmt::format(
        "there is no checkpoint '{}' to go on from; the run begins anew",
        plan.file.string())});
  }
  return continuation;
}

void remove_checkpoint(const CheckpointPlan& plan) {
  if (plan.file.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(plan.file, ignored);
}

}  // namespace limber::app
