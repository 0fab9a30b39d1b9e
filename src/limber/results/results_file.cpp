// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/results_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/hdf5_rows.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/results/path_step.hpp"

namespace limber::results {
namespace {

const std::string kFormat = "limber results";

using dynamics::EnergyBalance;
using dynamics::SystemState;

/// What is stored of one output.
struct Output {
  double time;
  std::vector<double> probes;
  SystemState state;
  EnergyBalance energy;
};

/// Matrices with a row an output, written together in one pass over these.
class OutputRows {
 public:
  using Row = Eigen::Map<Eigen::RowVectorXd>;
  using Fill = std::function<void(const Output&, Row)>;

  OutputRows(Hdf5File& out, const History& history)
      : out_(out), history_(history) {}

  void add(const std::string& name, Eigen::Index columns,
           const std::string& unit, const std::string& meaning, Fill fill) {
    const Eigen::Index rows = std::ssize(history_.times);
    matrices_.push_back(
        {{out_, name, rows, columns, unit, meaning}, std::move(fill)});
  }

  void write() {
    for (std::size_t i = 0; i < history_.times.size(); ++i) {
      const Output output{history_.times[i], history_.probe_rows[i],
                          history_.states[i], history_.energies[i]};
      for (Matrix& matrix : matrices_) {
        matrix.fill(output, matrix.rows.next());
      }
    }
    for (Matrix& matrix : matrices_) matrix.rows.close();
  }

 private:
  struct Matrix {
    Hdf5Rows rows;
    Fill fill;
  };

  Hdf5File& out_;
  const History& history_;
  std::vector<Matrix> matrices_;
};

void add_probes(Hdf5File& out, const History& history, OutputRows& rows) {
  for (std::size_t c = 0; c < history.columns.size(); ++c) {
    const ProbeColumn& column = history.columns[c];
    rows.add("probes/" + to_path_step(column.name), 1, column.unit,
             "probe at each output time",
             [c](const Output& output, OutputRows::Row row) {
               row[0] = output.probes[c];
             });
    if (!std::isnan(column.error)) {
      out.write("errors/" + to_path_step(column.name),
                MatrixX(MatrixX::Constant(1, 1, column.error)), column.unit,
                "estimated error of the curve");
    }
  }
}

// Of all steps, beside the outputs.
void write_extremes(Hdf5File& out, const History& history,
                    const dynamics::RunRecord& record) {
  for (std::size_t c = 0; c < record.peaks.size(); ++c) {
    const dynamics::Extreme& peak = record.peaks[c];
    MatrixX values(1, 2);
    values << peak.value, peak.time;
    out.write("peaks/" + to_path_step(history.columns[c].name), values,
              history.columns[c].unit + ", s",
              "value of largest magnitude of all steps, and its time");
  }
  const Envelopes& envelopes = record.envelopes;
  if (envelopes.is_empty()) return;
  const MatrixX edges = Eigen::Map<const VectorX>(envelopes.edges.data(),
                                                  std::ssize(envelopes.edges));
  out.write("envelope_edges", edges, "s", "ends of intervals");
  for (std::size_t c = 0; c < history.columns.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    MatrixX values(envelopes.least.rows(), 2);
    values << envelopes.least.col(column), envelopes.most.col(column);
    out.write("envelopes/" + to_path_step(history.columns[c].name), values,
              history.columns[c].unit,
              "smallest and largest value in each interval; NaN: none");
  }
}

void add_body(Hdf5File& out, const dynamics::BodyModel& body, std::size_t b,
              OutputRows& rows) {
  const std::string at = "bodies/" + to_path_step(body.name) + "/";
  out.write(at + "fidelity", std::string(to_string(body.fidelity)),
            "level of the body");
  const auto add = [&](const char* name, Eigen::Index columns, const char* unit,
                       const char* meaning, auto value) {
    rows.add(at + name, columns, unit, meaning,
             [b, value](const Output& output, OutputRows::Row row) {
               row = value(output.state.bodies[b]);
             });
  };
  const auto add_modal = [&](const char* name, const char* unit,
                             const char* meaning, VectorX SystemState::*all) {
    rows.add(at + name, body.modes, unit, meaning,
             [&body, all](const Output& output, OutputRows::Row row) {
               row = (output.state.*all).segment(body.offset, body.modes);
             });
  };
  using dynamics::BodyState;
  add("p_WB", 3, "m", "centre of mass, world frame",
      [](const BodyState& rigid) { return rigid.p_WB; });
  add("quat_WB", 4, "1", "body to world, w x y z", [](const BodyState& rigid) {
    const Quaternion& q = rigid.quat_WB;
    return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  });
  add("v_WB_W", 3, "m/s", "velocity, world frame",
      [](const BodyState& rigid) { return rigid.v_WB_W; });
  add("w_WB_B", 3, "rad/s", "angular velocity, body frame",
      [](const BodyState& rigid) { return rigid.w_WB_B; });
  add_modal("eta", "kg^1/2 m", "modal coordinates", &SystemState::eta);
  add_modal("etadot", "kg^1/2 m/s", "modal velocities", &SystemState::etadot);
}

void add_energies(OutputRows& rows) {
  const auto add = [&](const char* name, const char* meaning, auto field) {
    rows.add(std::string("energy/") + name, 1, "J", meaning,
             [field](const Output& output, OutputRows::Row row) {
               row[0] = output.energy.*field;
             });
  };
  add("kinetic_rigid", "m v^2/2 + w' J w/2", &EnergyBalance::kinetic_rigid);
  add("kinetic_modal", "w' H etadot + etadot^2/2",
      &EnergyBalance::kinetic_modal);
  add("elastic", "potential of the modes, eta' diag(lambda) eta/2 if linear",
      &EnergyBalance::elastic);
  add("coupler", "stored in couplers", &EnergyBalance::coupler);
  add("dissipated", "since the start", &EnergyBalance::dissipated);
  add("work", "of loads, gravity and drives since the start",
      &EnergyBalance::work);
  rows.add("momentum/linear", 3, "kg m/s", "world frame",
           [](const Output& output, OutputRows::Row row) {
             row = output.energy.linear_momentum;
           });
  rows.add("momentum/angular", 3, "kg m^2/s", "about the world origin",
           [](const Output& output, OutputRows::Row row) {
             row = output.energy.angular_momentum;
           });
}

// A line an event.
std::string join(const History& history, std::string dynamics::Event::*text) {
  std::string lines;
  for (const dynamics::Event& event : history.events) {
    std::string line = event.*text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    lines += line + '\n';
  }
  return lines;
}

void write_events(Hdf5File& out, const History& history) {
  MatrixX times(std::ssize(history.events), 1);
  MatrixX rates(times.rows(), 1);
  for (Eigen::Index i = 0; i < times.rows(); ++i) {
    const dynamics::Event& event = history.events[static_cast<std::size_t>(i)];
    times(i, 0) = event.time;
    rates(i, 0) = event.rate;
  }
  out.write("events/time", times, "s", "when each event happened");
  out.write("events/rate", rates, "m/s or rad/s",
            "how fast the joint's coordinate, the line's length or the latch's "
            "distance changed; of a load 0");
  out.write("events/source", join(history, &dynamics::Event::source),
            "coupler, tendon or load, a line an event");
  out.write("events/what", join(history, &dynamics::Event::what),
            "what happened, a line an event");
}

std::vector<std::string> list_names(const Hdf5File& in, const char* group) {
  std::vector<std::string> names = in.list(group);
  for (std::string& name : names) name = from_path_step(name);
  return names;
}

void write_content(Hdf5File& out, const dynamics::SystemModel& model,
                   const History& history) {
  out.write("format", kFormat, "what this file is");
  out.write("version", std::vector<std::int64_t>{kResultsFileVersion}, "1",
            "layout of this file");
  OutputRows rows(out, history);
  rows.add(
      "time", 1, "s", "output times",
      [](const Output& output, OutputRows::Row row) { row[0] = output.time; });
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    add_body(out, model.bodies[b], b, rows);
  }
  add_probes(out, history, rows);
  add_energies(rows);
  rows.write();
  write_events(out, history);
}

}  // namespace

void write_results(const std::filesystem::path& file,
                   const dynamics::SystemModel& model, const History& history,
                   const Scenery* scenery, const dynamics::RunRecord* record) {
  write_whole(file, [&](const std::filesystem::path& part) {
    Hdf5File out = Hdf5File::create(part);
    write_content(out, model, history);
    if (record != nullptr) write_extremes(out, history, *record);
    if (scenery != nullptr) write_scenery(out, *scenery, model, history);
    out.close();
  });
}

bool is_results_file(const std::filesystem::path& file) {
  const Hdf5File in = Hdf5File::open(file);
  return in.has("format") && in.read_text("format") == kFormat;
}

ResultsContents read_contents(const std::filesystem::path& file) {
  if (!is_results_file(file)) {
    throw InputError(
        fmt::format("'{}' is not a results file of Limber's", file.string()));
  }
  const Hdf5File in = Hdf5File::open(file);
  const MatrixX times = in.read_matrix("time");
  ResultsContents contents;
  contents.outputs = times.rows();
  // Files of older versions have no events.
  if (in.has("events")) contents.events = in.read_matrix("events/time").rows();
  if (times.size() > 0) {
    contents.start = times(0, 0);
    contents.end = times(times.rows() - 1, 0);
  }
  contents.bodies = list_names(in, "bodies");
  contents.probes = list_names(in, "probes");
  return contents;
}

}  // namespace limber::results
