// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/file/body_file_records.hpp"

#include <sstream>
#include <utility>
#include <vector>

namespace limber::flexbody {
namespace {

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

ModeMeasure read_measure(const BodyFileReader& reader) {
  try {
    return parse_measure(reader.in().read_text("selection/measure"));
  } catch (const InputError& error) {
    reader.fail(error.what());
  }
}

}  // namespace

// Flat lists: a load that changes often has thousands of cases.
void write_selection(Hdf5File& out,
                     const std::optional<SelectionRecord>& selection) {
  const SelectionRecord record = selection.value_or(SelectionRecord{});
  const auto count = static_cast<Eigen::Index>(record.cases.size());
  std::string names;
  MatrixX figures(count, 3);
  std::vector<std::int64_t> requested_counts;
  std::vector<std::int64_t> requested;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SelectedCase& item = record.cases[static_cast<std::size_t>(i)];
    names += item.name + '\n';
    figures.row(i) << item.reached, item.eigenmode_error, item.basis_error;
    requested_counts.push_back(static_cast<std::int64_t>(item.modes.size()));
    requested.insert(requested.end(), item.modes.begin(), item.modes.end());
  }
  out.write("selection/is_automatic",
            std::vector<std::int64_t>{selection ? 1 : 0}, "1",
            "1 if eigenmodes were chosen by load cases");
  out.write("selection/measure", std::string(to_string(record.measure)),
            "what fractions are of");
  out.write("selection/threshold", MatrixX::Constant(1, 1, record.threshold),
            "1", "fraction to reach");
  out.write("selection/candidates",
            std::vector<std::int64_t>{record.candidates}, "1",
            "eigenmodes to choose from");
  out.write("selection/modes",
            std::vector<std::int64_t>(record.modes.begin(), record.modes.end()),
            "1", "eigenmodes kept, from 0");
  out.write("selection/case_names", names, "load cases, one a line");
  out.write(
      "selection/case_figures", figures, "1",
      "a case a row: fraction reached, static error by eigenmodes, by basis");
  out.write("selection/case_mode_counts", requested_counts, "1",
            "eigenmodes that each case asks for");
  out.write("selection/case_modes", requested, "1",
            "these, case by case, from 0");
}

void write_locking(Hdf5File& out, const std::optional<MeshLocking>& locking) {
  if (!locking) return;
  out.write(
      "locking",
      MatrixX(Eigen::Vector2d(locking->frequency, locking->refined_frequency)),
      "Hz", "lowest frequency of the first-order mesh, and refined");
}

std::optional<MeshLocking> read_locking(const BodyFileReader& reader) {
  if (!reader.in().has("locking")) return std::nullopt;
  const MatrixX values = reader.matrix("locking", 2, 1);
  if (!(values.minCoeff() > 0.0))
    reader.fail("'locking' has a frequency that is not positive");
  return MeshLocking{values(0, 0), values(1, 0)};
}

void write_inertia_record(Hdf5File& out, const InertiaRecord& record) {
  if (!record.gap.empty())
    out.write("integrals/gap", record.gap,
              "why S1 and S2 are not known, and are zero");
  if (!record.notice.empty())
    out.write("integrals/notice", record.notice,
              "why S1 and S2 have a large error");
}

InertiaRecord read_inertia_record(const BodyFileReader& reader) {
  InertiaRecord record;
  if (reader.in().has("integrals/gap"))
    record.gap = reader.in().read_text("integrals/gap");
  if (reader.in().has("integrals/notice"))
    record.notice = reader.in().read_text("integrals/notice");
  return record;
}

void write_load_modes(Hdf5File& out,
                      const std::vector<LoadModesRecord>& records) {
  std::string names;
  std::vector<std::int64_t> counts;
  MatrixX left_out(std::ssize(records), 1);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const LoadModesRecord& record = records[i];
    names += record.name + '\n';
    counts.insert(counts.end(),
                  {record.directions, record.is_whole ? 1 : 0, record.taken});
    left_out(static_cast<Eigen::Index>(i), 0) = record.left_out;
  }
  out.write("load_modes/names", names, "files of nodal forces, one a line");
  out.write("load_modes/counts", counts, "1",
            "three a file: directions found, 1 if that is all, modes taken");
  out.write("load_modes/left_out", left_out, "1",
            "fraction of the static answers that is in no mode");
}

void write_field(Hdf5File& out, const std::string& at,
                 const std::optional<ProjectedField>& projected,
                 const std::string& unit) {
  const ProjectedField field = projected.value_or(ProjectedField{});
  out.write(at + "is_given", std::vector<std::int64_t>{projected ? 1 : 0}, "1",
            "1 if the body was reduced with such a field");
  out.write(at + "eta", MatrixX(field.eta), unit,
            "modal coordinates, Phi' M u");
  out.write(
      at + "shares",
      MatrixX(Eigen::Vector2d(field.rigid_fraction, field.missed_fraction)),
      "1", "left out: rigid motion, deformation outside the basis");
  out.write(at + "key", field.key, "digest of the field");
}

std::optional<SelectionRecord> read_selection(const BodyFileReader& reader) {
  if (reader.integer("selection/is_automatic") == 0) return std::nullopt;
  SelectionRecord record;
  record.measure = read_measure(reader);
  record.threshold = reader.matrix("selection/threshold", 1, 1)(0, 0);
  record.candidates = static_cast<int>(reader.integer("selection/candidates"));
  const auto modes = reader.sizes("selection/modes", -1);
  record.modes.assign(modes.begin(), modes.end());
  const std::vector<std::string> names =
      split_lines(reader.in().read_text("selection/case_names"));
  const auto count = static_cast<std::int64_t>(names.size());
  const MatrixX figures = reader.matrix("selection/case_figures", count, 3);
  const auto requested_counts =
      reader.sizes("selection/case_mode_counts", count);
  const auto requested = reader.sizes("selection/case_modes", -1);
  std::size_t at = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (requested_counts[i] > requested.size() - at)
      reader.fail("'selection/case_modes' is truncated");
    const auto row = static_cast<Eigen::Index>(i);
    SelectedCase item{
        names[i], {}, figures(row, 0), figures(row, 1), figures(row, 2)};
    for (const std::size_t end = at + requested_counts[i]; at < end; ++at)
      item.modes.push_back(static_cast<int>(requested[at]));
    record.cases.push_back(std::move(item));
  }
  return record;
}

std::vector<LoadModesRecord> read_load_modes(const BodyFileReader& reader) {
  const std::vector<std::string> names =
      split_lines(reader.in().read_text("load_modes/names"));
  const auto count = static_cast<std::int64_t>(names.size());
  const auto counts = reader.sizes("load_modes/counts", 3 * count);
  const MatrixX left_out = reader.matrix("load_modes/left_out", count, 1);
  std::vector<LoadModesRecord> records;
  for (std::size_t i = 0; i < names.size(); ++i) {
    records.push_back({names[i], static_cast<int>(counts[3 * i]),
                       counts[3 * i + 1] == 1,
                       static_cast<int>(counts[3 * i + 2]),
                       left_out(static_cast<Eigen::Index>(i), 0)});
  }
  return records;
}

std::optional<ProjectedField> read_field(const BodyFileReader& reader,
                                         const std::string& at,
                                         Eigen::Index m) {
  if (reader.integer(at + "is_given") == 0) return std::nullopt;
  const MatrixX fractions = reader.matrix(at + "shares", 2, 1);
  return ProjectedField{reader.matrix(at + "eta", m, 1), fractions(0, 0),
                        fractions(1, 0), reader.in().read_text(at + "key")};
}

}  // namespace limber::flexbody
