// SPDX-License-Identifier: BSD-3-Clause
#include "results/checkpoint_file.hpp"

#include <fmt/format.h>

#include "common/archive.hpp"
#include "common/digest.hpp"
#include "common/errors.hpp"
#include "common/hdf5_file.hpp"
#include "common/whole_file.hpp"
#include "dynamics/archives.hpp"

namespace limber::results {

void exchange(Archive& archive, ProbeColumn& column) {
  archive(column.name, column.unit);
}

void exchange(Archive& archive, History& history) {
  archive(history.columns, history.times, history.probe_rows, history.states,
          history.energies, history.events);
}

namespace {

const std::string kFormat = "limber checkpoint";
constexpr std::int64_t kVersion = 2;

bool has_format(const Hdf5File& in) {
  return in.has("format") && in.read_text("format") == kFormat;
}

MatrixX to_column(const std::vector<double>& numbers) {
  return Eigen::Map<const VectorX>(numbers.data(), std::ssize(numbers));
}

std::vector<double> to_numbers(const MatrixX& column) {
  return {column.data(), column.data() + column.size()};
}

std::string find_digest(const MatrixX& run, const MatrixX& history) {
  Digest digest;
  digest.add(run);
  digest.add(history);
  return digest.text();
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file,
                      const CheckpointRecord& record) {
  Archive archive;
  History history = record.history;
  archive(history);
  const MatrixX run = to_column(record.run.numbers);
  const MatrixX rest = to_column(archive.numbers());
  write_whole(file, [&](const std::filesystem::path& part) {
    Hdf5File out = Hdf5File::create(part);
    out.write("format", kFormat, "what this file is");
    out.write("version", std::vector<std::int64_t>{kVersion}, "1",
              "layout of this file");
    out.write("fingerprint", record.fingerprint, "of the run");
    out.write("digest", find_digest(run, rest), "XXH3 of run and history");
    out.write("time", MatrixX::Constant(1, 1, record.run.time), "s",
              "how far the run was");
    out.write("run", run, "1", "the run between two steps");
    out.write("history", rest, "1", "what it had left behind by then");
    out.close();
  });
}

bool is_checkpoint_file(const std::filesystem::path& file) {
  return has_format(Hdf5File::open(file));
}

CheckpointRecord read_checkpoint(const std::filesystem::path& file) {
  const Hdf5File in = Hdf5File::open(file);
  if (!has_format(in)) {
    throw InputError(
        fmt::format("'{}' is no checkpoint of a run", file.string()));
  }
  const auto version = in.read_integers("version");
  if (version.size() != 1 || version[0] != kVersion) {
    throw InputError(fmt::format(
        "the checkpoint '{}' is of another version of Limber; run without "
        "--resume",
        file.string()));
  }
  const MatrixX run = in.read_matrix("run");
  const MatrixX rest = in.read_matrix("history");
  if (in.read_text("digest") != find_digest(run, rest)) {
    throw InputError(fmt::format(
        "the checkpoint '{}' is damaged; run without --resume", file.string()));
  }
  CheckpointRecord record;
  record.fingerprint = in.read_text("fingerprint");
  const MatrixX time = in.read_matrix("time");
  record.run.time = time.size() > 0 ? time(0) : 0.0;
  record.run.numbers = to_numbers(run);
  Archive archive(to_numbers(rest));
  archive(record.history);
  return record;
}

}  // namespace limber::results
