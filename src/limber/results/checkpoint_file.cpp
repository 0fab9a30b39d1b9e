// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/sealed_file.hpp"
#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/monitors/event.hpp"

namespace limber::results {

constexpr auto fields_of(const ProbeColumn*) {
  return list_fields("column", "name", "unit", "error");
}

constexpr auto fields_of(const History*) {
  return list_fields("history", "columns", "times [s]", "probe rows", "states",
                     "energies", "events");
}

namespace {

constexpr std::string_view kKind = "limber checkpoint";
constexpr Seal kSeal = {kKind, 7};

// Content of the checkpoint file.
struct Head {
  double time = 0.0;
  std::vector<double> numbers;
  std::string log;  // name of the file beside it
  std::uint64_t length = 0;
  std::string digest;
};

constexpr auto fields_of(const Head*) {
  return list_fields("checkpoint", "time [s]", "numbers", "log", "length",
                     "digest");
}

// A block of the log; the first block is the manifest.
struct Entry {
  std::vector<double> run;
  History history;  // since the previous entry
};

constexpr auto fields_of(const Entry*) {
  return list_fields("entry", "run", "history");
}

template <typename Thing>
std::string to_bytes(Thing thing) {
  Archive archive;
  archive(thing);
  const std::vector<double>& numbers = archive.numbers();
  return {reinterpret_cast<const char*>(numbers.data()),
          numbers.size() * sizeof(double)};
}

template <typename Thing>
Thing from_bytes(const std::string& bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  Archive archive(std::move(numbers));
  Thing thing;
  archive(thing);
  return thing;
}

// Two logs are used alternately: a new run does not touch the log of the
// checkpoint that it replaces.
std::filesystem::path find_log(const std::filesystem::path& file, int turn) {
  std::filesystem::path log = file;
  log.replace_filename(fmt::format("{}-{}.log", file.stem().string(), turn));
  return log;
}

Head read_head(const std::filesystem::path& file) {
  return from_bytes<Head>(read_sealed(file, kSeal));
}

std::filesystem::path choose_log(const std::filesystem::path& file) {
  const std::filesystem::path first = find_log(file, 1);
  try {
    if (first.filename() == read_head(file).log) return find_log(file, 2);
  } catch (const InputError&) {  // no checkpoint to preserve
  }
  return first;
}

std::vector<std::size_t> find_ends(const History& history) {
  std::vector<std::size_t> ends;
  for_each_field(history, [&](const char*, const auto& list) {
    ends.push_back(list.size());
  });
  return ends;
}

// Ends of the history's lists that a checkpoint after `outputs` has. Events are
// told at the end of a run.
std::vector<std::size_t> find_ends(const History& history,
                                   std::size_t outputs) {
  LIMBER_EXPECT(outputs <= history.times.size());
  return {history.columns.size(), outputs, outputs, outputs, outputs,
          history.events.size()};
}

// Elements between the ends.
template <typename List>
List cut(const List& list, std::size_t from, std::size_t to) {
  List part;
  for (std::size_t i = from; i < to; ++i) part.push_back(list[i]);
  return part;
}

History cut(const History& history, const std::vector<std::size_t>& from,
            const std::vector<std::size_t>& to) {
  return std::apply(
      [&](const auto&... lists) {
        std::size_t i = 0;
        const auto copy = [&](const auto& list) {
          const std::size_t k = i++;
          return cut(list, from[k], to[k]);
        };
        return History{copy(lists)...};
      },
      tie_fields(history));
}

// The ends of at most some more elements of each list.
std::vector<std::size_t> go_on(const std::vector<std::size_t>& from,
                               const std::vector<std::size_t>& to) {
  constexpr std::size_t kMost = 64;
  std::vector<std::size_t> ends;
  for (std::size_t k = 0; k < from.size(); ++k) {
    ends.push_back(std::min(from[k] + kMost, to[k]));
  }
  return ends;
}

void append(const History& part, History& all) {
  auto parts = tie_fields(part);
  std::apply(
      [&](const auto&... lists) {
        std::apply(
            [&](auto&... ends) {
              const auto add = [](const auto& list, auto& end) {
                for (const auto& value : list) end.push_back(value);
              };
              (add(lists, ends), ...);
            },
            tie_fields(all));
      },
      parts);
}

CheckpointRecord read_record(const std::filesystem::path& file) {
  Head head = read_head(file);
  CheckpointRecord record;
  record.log = file;
  record.log.replace_filename(std::filesystem::path(head.log).filename());
  record.part = {head.length, head.digest};
  record.run = {head.time, std::move(head.numbers)};
  bool is_first = true;
  visit_blocks(record.log, record.part, [&](const std::string& block) {
    if (std::exchange(is_first, false)) {
      record.manifest = Manifest(block);
      return;
    }
    const auto entry = from_bytes<Entry>(block);
    record.run.log.insert(record.run.log.end(), entry.run.begin(),
                          entry.run.end());
    append(entry.history, record.history);
  });
  if (is_first) throw InputError("its log is empty");
  record.run.outputs = record.history.times.size();
  return record;
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::filesystem::path file,
                                   Manifest manifest)
    : file_(std::move(file)),
      manifest_(std::move(manifest)),
      ends_(find_ends({})) {}

CheckpointWriter::CheckpointWriter(std::filesystem::path file,
                                   const CheckpointRecord& record)
    : file_(std::move(file)),
      manifest_(record.manifest),
      log_file_(record.log),
      ends_(find_ends(record.history)) {
  log_ = std::make_unique<AppendFile>(record.log, record.part);
}

void CheckpointWriter::begin_log() {
  log_file_ = choose_log(file_);
  log_ = std::make_unique<AppendFile>(log_file_);
  try {
    log_->append(manifest_.text());
  } catch (const InputError&) {
    log_.reset();
    throw;
  }
}

void CheckpointWriter::write(const dynamics::Checkpoint& run,
                             const History& history) {
  pending_.insert(pending_.end(), run.log.begin(), run.log.end());
  const bool is_first = !log_;
  if (is_first) begin_log();
  const std::vector<std::size_t> ends = find_ends(history, run.outputs);
  // In blocks of bounded size, at least one.
  std::vector<std::size_t> written = ends_;
  bool is_begun = false;
  log_->append([&]() -> std::optional<std::string> {
    if (is_begun && written == ends) return std::nullopt;
    const std::vector<std::size_t> until = go_on(written, ends);
    const Entry entry{is_begun ? std::vector<double>() : pending_,
                      cut(history, written, until)};
    is_begun = true;
    written = until;
    return to_bytes(entry);
  });
  pending_.clear();
  ends_ = ends;
  const FilePart part = log_->part();
  write_sealed(file_, kSeal,
               to_bytes(Head{run.time, run.numbers, log_file_.filename(),
                             part.length, part.digest}));
  if (!is_first) return;
  const int other = log_file_ == find_log(file_, 1) ? 2 : 1;
  std::error_code ignored;
  std::filesystem::remove(find_log(file_, other), ignored);
}

void remove_checkpoint(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  for (const int turn : {1, 2}) {
    std::filesystem::remove(find_log(file, turn), ignored);
  }
}

bool is_checkpoint_file(const std::filesystem::path& file) {
  return has_seal(file, kKind);
}

CheckpointRecord read_checkpoint(const std::filesystem::path& file) {
  try {
    return read_record(file);
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "cannot resume from the checkpoint '{}': {}; run without --resume",
        file.string(), error.what()));
  }
}

}  // namespace limber::results
