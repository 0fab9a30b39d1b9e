// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/app/study/study_worker.hpp"
#include "limber/common/duration.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/run_manifest.hpp"
#include "limber/runs/unused_cache.hpp"

namespace limber::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Ends a run between two steps after a signal.
void stop_on_signal(std::string_view, double fraction) {
  if (fraction < 1.0 && find_received_signal() != 0) {
    throw dynamics::Interrupted("interrupted");
  }
}

void describe_values(Manifest& out, const study::Factor& factor) {
  if (const auto* listed = std::get_if<study::Listed>(&factor.values)) {
    out.add("values", fmt::format("{}", fmt::join(listed->values, ", ")));
  } else if (const auto* spread = std::get_if<study::Spread>(&factor.values)) {
    out.add("scale", spread->is_logarithmic ? "logarithmic" : "linear");
    out.add("from", spread->from);
    out.add("to", spread->to);
    out.add("count", static_cast<double>(spread->count.value_or(0)));
  } else {
    const study::Normal& normal = std::get<study::Normal>(factor.values);
    out.add("mean", normal.mean);
    out.add("deviation", normal.deviation);
  }
}

/// Writes the description of a response.
struct ResponseDescription {
  Manifest& out;
  void operator()(const study::ProbeResponse& probe) const {
    out.add("probe", probe.column);
    out.add("measure", static_cast<double>(probe.measure));
  }
  void operator()(const study::ContactResponse& contact) const {
    out.add("contact", contact.first + "/" + contact.second);
    out.add("measure", contact.is_impulse ? "impulse" : "peak");
  }
  void operator()(const study::SummaryResponse& summary) const {
    out.add("summary", summary.path);
  }
  void operator()(const study::ExpressionResponse& expression) const {
    out.add("expression", expression.formula);
  }
};

std::string describe_study(const study::Study& study) {
  Manifest out;
  out.within("study", [&] {
    out.add("design", to_string(study.design.kind));
    out.add("samples", static_cast<double>(study.design.samples));
    out.add("seed", static_cast<double>(study.design.seed));
    for (const scene::Setting& setting : study.settings) {
      out.add("setting " + setting.path, setting.value.value_or("removed"));
    }
    for (const study::Factor& factor : study.factors) {
      out.within("factor '" + factor.name + "'", [&] {
        out.add("paths", fmt::format("{}", fmt::join(factor.paths, ", ")));
        describe_values(out, factor);
      });
    }
    for (const study::Response& response : study.responses) {
      out.within("response '" + response.name + "'", [&] {
        std::visit(ResponseDescription{out}, response.source);
      });
    }
  });
  return out.text();
}

/// The runs in threads.
class Runner {
 public:
  Runner(const study::Design& design, const StudyBase& base,
         const StudyOptions& options, study::StudyFile& file)
      : design_(design),
        study_(file.record().study),
        options_(options),
        file_(file),
        worker_(study_, options.cache, base.built.known, stop_on_signal) {
    std::set<std::size_t> done;
    for (const study::StudyRow& row : file.read_rows()) done.insert(row.run);
    const study::StudyRecord& record = file.record();
    for (std::size_t run = record.shard; run < design.size();
         run += record.shards) {
      if (!done.contains(run)) left_.push_back(run);
    }
    before_ = done.size();
  }

  StudyCost run() {
    const Clock::time_point start = Clock::now();
    DeferredSignals signals;
    signals.begin();
    std::vector<std::thread> threads;
    const auto count =
        std::min(static_cast<std::size_t>(options_.jobs), left_.size());
    working_ = count;
    try {
      for (std::size_t i = 0; i < count; ++i) {
        threads.emplace_back([this] { work(); });
      }
      write_rows();
    } catch (...) {
      stops_ = true;
      for (std::thread& thread : threads) thread.join();
      throw;
    }
    for (std::thread& thread : threads) thread.join();
    clear_progress_bar();
    if (failure_) std::rethrow_exception(failure_);
    cost_.seconds = seconds_since(start);
    if (cost_.runs < left_.size()) {
      throw dynamics::Interrupted(
          fmt::format("interrupted after {} of {} runs; the same command "
                      "continues with the others",
                      before_ + cost_.runs, before_ + left_.size()));
    }
    return cost_;
  }

 private:
  void work() {
    try {
      while (!stops_ && find_received_signal() == 0) {
        const std::size_t next = next_++;
        if (next >= left_.size()) break;
        std::optional<study::StudyRow> row =
            worker_.make_row(left_[next], design_[left_[next]]);
        if (!row) break;
        const std::lock_guard lock(rows_mutex_);
        rows_.push_back(std::move(*row));
      }
    } catch (...) {
      const std::lock_guard lock(rows_mutex_);
      failure_ = std::current_exception();
      stops_ = true;
    }
    const std::lock_guard lock(rows_mutex_);
    --working_;
    ready_.notify_one();
  }

  void write_rows() {
    // A transaction waits for the disk: rows of short runs share one.
    constexpr auto kTogether = std::chrono::milliseconds(100);
    const Progress bar = make_progress_bar();
    for (bool is_done = false; !is_done;) {
      std::vector<study::StudyRow> rows;
      {
        std::unique_lock lock(rows_mutex_);
        ready_.wait_for(lock, kTogether, [this] { return working_ == 0; });
        rows.swap(rows_);
        is_done = working_ == 0 && rows.empty();
      }
      for (study::StudyRow& row : rows) {
        if (row.error.empty()) {
          evaluate_formulas(study_, row.factors, row.responses);
        }
        cost_.seconds_steps += row.seconds;
      }
      file_.add(rows);
      cost_.runs += rows.size();
      report(bar, fmt::format("all {} runs", left_.size()),
             left_.empty() ? 1.0
                           : static_cast<double>(cost_.runs) /
                                 static_cast<double>(left_.size()));
    }
  }

  const study::Design& design_;
  const study::Study& study_;
  const StudyOptions& options_;
  study::StudyFile& file_;
  StudyWorker worker_;
  std::vector<std::size_t> left_;
  std::size_t before_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stops_ = false;

  std::mutex rows_mutex_;  // of the next four
  std::condition_variable ready_;
  std::vector<study::StudyRow> rows_;
  std::size_t working_ = 0;
  std::exception_ptr failure_;

  StudyCost cost_;
};

}  // namespace

StudyBase make_base(const study::Study& study, const study::Design& design,
                    const std::filesystem::path& cache) {
  StudyBase base;
  base.scene =
      load_with_notes(study.scenario, to_overrides(study, design.front()));
  const Progress progress = make_progress_bar();
  base.built = scene::build_system(base.scene, make_reducer(progress), cache,
                                   make_full_maker(progress));
  runs::warn_of_unused_cache(cache, base.built);
  clear_progress_bar();
  print_more_notes(base.scene, base.built.notes);
  print_warnings(base.built.warnings);
  check_responses(study, base.scene, base.built,
                  [](const runs::Run& run) { return summarize(run); });
  base.manifest = describe_study(study) +
                  runs::make_manifest(base.scene, base.built).text();
  return base;
}

StudyCost run_study(const study::Design& design, const StudyBase& base,
                    const StudyOptions& options, study::StudyFile& file) {
  return Runner(design, base, options, file).run();
}

}  // namespace limber::app
