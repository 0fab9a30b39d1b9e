// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/results/checkpoint_file.hpp"

namespace limber::runs {
namespace {

// Most differences listed; the first ones usually cause the rest.
constexpr std::size_t kMostListed = 5;

void check_is_same_run(const std::filesystem::path& file,
                       const Manifest& before, const Manifest& now) {
  std::vector<std::string> differences = find_differences(before, now);
  if (differences.empty()) return;
  const std::size_t count = differences.size();
  if (count > kMostListed) {
    differences.resize(kMostListed);
    differences.push_back(fmt::format("and {} more", count - kMostListed));
  }
  throw InputError(
      fmt::format("the checkpoint '{}' belongs to another run: {}; run without "
                  "--resume, or restore the original input",
                  file.string(), fmt::join(differences, "; ")));
}

// Whether anything of this name exists.
bool is_there(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::symlink_status(file, error).type() !=
         std::filesystem::file_type::not_found;
}

// Writes checkpoints during the run.
class Keeper {
 public:
  using MakeWriter = std::function<results::CheckpointWriter()>;
  // `make_writer` is called at the first checkpoint.
  Keeper(MakeWriter make_writer, const results::History& history,
         const Warn& warn, std::vector<std::string>& warnings)
      : make_writer_(std::move(make_writer)),
        history_(history),
        warn_(warn),
        warnings_(warnings) {}

  void go_on_with(results::CheckpointWriter writer) {
    writer_.emplace(std::move(writer));
  }

  void keep(const dynamics::Checkpoint& run) {
    try {
      if (!writer_) writer_.emplace(make_writer_());
      writer_->write(run, history_);
    } catch (const InputError& error) {
      if (std::exchange(has_warned_, true)) return;
      warnings_.push_back(
          fmt::format("no checkpoint at t = {:.9g} s: {}; the run continues",
                      run.time, error.what()));
      if (warn_) warn_(warnings_.back());
    }
  }

 private:
  MakeWriter make_writer_;
  std::optional<results::CheckpointWriter> writer_;
  const results::History& history_;
  const Warn& warn_;
  std::vector<std::string>& warnings_;
  bool has_warned_ = false;
};

}  // namespace

dynamics::Continuation make_continuation(
    const CheckpointPlan& plan, const std::function<Manifest()>& describe,
    results::History& history, const Warn& warn,
    std::vector<std::string>& warnings) {
  dynamics::Continuation continuation;
  if (plan.file.empty()) return continuation;
  const auto keeper = std::make_shared<Keeper>(
      [file = plan.file, describe] {
        return results::CheckpointWriter(file, describe());
      },
      history, warn, warnings);
  continuation.keeper.interval = plan.interval;
  continuation.keeper.keep = [keeper](const dynamics::Checkpoint& run) {
    keeper->keep(run);
  };
  if (!plan.resumes) return continuation;
  if (!is_there(plan.file)) {
    // Not one of the summary, which is that of the run from the beginning.
    if (warn) {
      warn(
          fmt::format("there is no checkpoint '{}' to resume from; the run "
                      "starts from the beginning",
                      plan.file.string()));
    }
    return continuation;
  }
  results::CheckpointRecord record = results::read_checkpoint(plan.file);
  check_is_same_run(plan.file, record.manifest, describe());
  keeper->go_on_with(results::CheckpointWriter(plan.file, record));
  history = std::move(record.history);
  continuation.from = std::move(record.run);
  return continuation;
}

}  // namespace limber::runs
