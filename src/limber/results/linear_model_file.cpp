// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/linear_model_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "limber/common/errors.hpp"
#include "limber/common/escape_texts.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/results/mat_file.hpp"
#include "limber/results/npz_file.hpp"

namespace limber::results {
namespace {

using Json = nlohmann::ordered_json;
using dynamics::LinearSignal;

template <typename File>
void add_signals(File& file, const std::string& what,
                 const std::vector<LinearSignal>& signals) {
  std::vector<std::string> names;
  std::vector<std::string> units;
  for (const LinearSignal& signal : signals) {
    names.push_back(signal.name);
    units.push_back(signal.unit);
  }
  file.add(what + "_names", names);
  file.add(what + "_units", units);
}

MatrixX values_of(const std::vector<LinearSignal>& signals) {
  MatrixX values(std::ssize(signals), 1);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    values(static_cast<Eigen::Index>(i), 0) = signals[i].value;
  }
  return values;
}

MatrixX column(const std::vector<double>& values) {
  return Eigen::Map<const VectorX>(values.data(), std::ssize(values));
}

/// @param file any writer of named matrices and lists of texts
template <typename File>
void add_all(File& file, const LinearRecord& record) {
  const dynamics::LinearModel& model = record.model;
  file.add("A", model.A);
  file.add("B", model.B);
  file.add("C", model.C);
  file.add("D", model.D);
  add_signals(file, "input", model.inputs);
  add_signals(file, "output", model.outputs);
  add_signals(file, "state", model.states);
  file.add("u0", values_of(model.inputs));
  file.add("y0", values_of(model.outputs));
  file.add("time", MatrixX::Constant(1, 1, record.time));
  if (record.period > 0.0) {
    file.add("period", MatrixX::Constant(1, 1, record.period));
  }
  file.add("axes_angular_velocity", column(record.axes_angular_velocity));
  if (!record.hankel.empty()) {
    file.add("hankel_singular_values", column(record.hankel));
    file.add("error_bound", MatrixX::Constant(1, 1, record.bound));
  }
  file.add("scenario", std::vector<std::string>{record.scenario});
  file.add("about", std::vector<std::string>{record.about});
  file.add("warnings", record.warnings);
}

/// A matrix is a list of its rows.
class JsonFile {
 public:
  void add(const std::string& name, const MatrixX& matrix) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      Json row = Json::array();
      for (const double value : matrix.row(i)) row.push_back(value);
      rows.push_back(std::move(row));
    }
    json_[name] = std::move(rows);
  }
  void add(const std::string& name, const std::vector<std::string>& texts) {
    json_[name] = texts;
  }
  [[nodiscard]] std::string text() const {
    return escape_texts(json_).dump(1) + "\n";
  }

 private:
  Json json_ = Json::object();
};

}  // namespace

void check_linear_model_ending(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".mat" || ending == ".npz" || ending == ".json") return;
  throw InputError(
      fmt::format("'{}' does not end in .mat (MATLAB, Octave, SciPy), .npz "
                  "(NumPy) or .json, which selects the format",
                  file.string()));
}

void write_linear_model(const std::filesystem::path& file,
                        const LinearRecord& record) {
  check_linear_model_ending(file);
  if (file.extension() == ".mat") {
    MatFile mat;
    add_all(mat, record);
    write_whole(file, mat.finish());
  } else if (file.extension() == ".npz") {
    NpzFile npz;
    add_all(npz, record);
    write_whole(file, npz.bytes());
  } else {
    JsonFile json;
    add_all(json, record);
    write_whole(file, json.text());
  }
}

}  // namespace limber::results
