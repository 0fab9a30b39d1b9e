// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cstring>
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
constexpr Seal kSeal = {kKind, 6};

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

// The part between the ends.
History cut(const History& history, const std::vector<std::size_t>& from,
            const std::vector<std::size_t>& to) {
  History part;
  std::apply(
      [&](const auto&... lists) {
        std::size_t i = 0;
        const auto copy = [&](const auto& list) {
          const auto first = static_cast<std::ptrdiff_t>(from[i]);
          const auto last = static_cast<std::ptrdiff_t>(to[i++]);
          return std::decay_t<decltype(list)>(list.begin() + first,
                                              list.begin() + last);
        };
        part = History{copy(lists)...};
      },
      tie_fields(history));
  return part;
}

template <typename Value>
void move_to_end(std::vector<Value>& part, std::vector<Value>& all) {
  all.insert(all.end(), std::make_move_iterator(part.begin()),
             std::make_move_iterator(part.end()));
}

void move_to_end(History& part, History& all) {
  auto parts = tie_fields(part);
  std::apply(
      [&](auto&... lists) {
        std::apply([&](auto&... ends) { (move_to_end(lists, ends), ...); },
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
  const std::vector<std::string> blocks = read_blocks(record.log, record.part);
  if (blocks.empty()) throw InputError("its log is empty");
  record.manifest = Manifest(blocks.front());
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    auto entry = from_bytes<Entry>(blocks[i]);
    move_to_end(entry.run, record.run.log);
    move_to_end(entry.history, record.history);
  }
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
  log_->append(to_bytes(Entry{pending_, cut(history, ends_, ends)}));
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
