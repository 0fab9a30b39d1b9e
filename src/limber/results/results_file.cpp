// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/results_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/files/hdf5_file.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/results/path_step.hpp"

namespace limber::results {
namespace {

const std::string kFormat = "limber results";

using dynamics::EnergyBalance;
using dynamics::SystemState;

Eigen::Index count(const History& history) {
  return static_cast<Eigen::Index>(history.times.size());
}

void write_probes(Hdf5File& out, const History& history) {
  for (std::size_t c = 0; c < history.columns.size(); ++c) {
    MatrixX values(count(history), 1);
    for (std::size_t i = 0; i < history.times.size(); ++i) {
      values(static_cast<Eigen::Index>(i), 0) = history.probe_rows[i][c];
    }
    out.write("probes/" + to_path_step(history.columns[c].name), values,
              history.columns[c].unit, "probe at each output time");
    if (const double error = history.columns[c].error; !std::isnan(error)) {
      out.write("errors/" + to_path_step(history.columns[c].name),
                MatrixX(MatrixX::Constant(1, 1, error)),
                history.columns[c].unit, "estimated error of the curve");
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

void write_body_states(Hdf5File& out, const dynamics::BodyModel& body,
                       std::size_t b, const History& history) {
  MatrixX position(count(history), 3);
  MatrixX rotation(count(history), 4);
  MatrixX velocity(count(history), 3);
  MatrixX spin(count(history), 3);
  MatrixX eta(count(history), body.modes);
  MatrixX etadot(count(history), body.modes);
  for (Eigen::Index i = 0; i < count(history); ++i) {
    const SystemState& state = history.states[static_cast<std::size_t>(i)];
    const dynamics::BodyState& rigid = state.bodies[b];
    position.row(i) = rigid.p_WB;
    rotation.row(i) << rigid.quat_WB.w(), rigid.quat_WB.x(), rigid.quat_WB.y(),
        rigid.quat_WB.z();
    velocity.row(i) = rigid.v_WB_W;
    spin.row(i) = rigid.w_WB_B;
    eta.row(i) = state.eta.segment(body.offset, body.modes);
    etadot.row(i) = state.etadot.segment(body.offset, body.modes);
  }
  const std::string at = "bodies/" + to_path_step(body.name) + "/";
  out.write(at + "fidelity", std::string(to_string(body.fidelity)),
            "level of the body");
  out.write(at + "p_WB", position, "m", "centre of mass, world frame");
  out.write(at + "quat_WB", rotation, "1", "body to world, w x y z");
  out.write(at + "v_WB_W", velocity, "m/s", "velocity, world frame");
  out.write(at + "w_WB_B", spin, "rad/s", "angular velocity, body frame");
  out.write(at + "eta", eta, "kg^1/2 m", "modal coordinates");
  out.write(at + "etadot", etadot, "kg^1/2 m/s", "modal velocities");
}

void write_energies(Hdf5File& out, const History& history) {
  const auto write = [&](const char* name, const char* meaning, auto field) {
    MatrixX values(count(history), 1);
    for (Eigen::Index i = 0; i < count(history); ++i) {
      values(i, 0) = history.energies[static_cast<std::size_t>(i)].*field;
    }
    out.write(std::string("energy/") + name, values, "J", meaning);
  };
  write("kinetic_rigid", "m v^2/2 + w' J w/2", &EnergyBalance::kinetic_rigid);
  write("kinetic_modal", "w' H etadot + etadot^2/2",
        &EnergyBalance::kinetic_modal);
  write("elastic", "potential of the modes, eta' diag(lambda) eta/2 if linear",
        &EnergyBalance::elastic);
  write("coupler", "stored in couplers", &EnergyBalance::coupler);
  write("dissipated", "since the start", &EnergyBalance::dissipated);
  write("work", "of loads, gravity and drives since the start",
        &EnergyBalance::work);

  MatrixX linear(count(history), 3);
  MatrixX angular(count(history), 3);
  for (Eigen::Index i = 0; i < count(history); ++i) {
    const EnergyBalance& e = history.energies[static_cast<std::size_t>(i)];
    linear.row(i) = e.linear_momentum;
    angular.row(i) = e.angular_momentum;
  }
  out.write("momentum/linear", linear, "kg m/s", "world frame");
  out.write("momentum/angular", angular, "kg m^2/s", "about the world origin");
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
  MatrixX times(count(history), 1);
  for (Eigen::Index i = 0; i < count(history); ++i) {
    times(i, 0) = history.times[static_cast<std::size_t>(i)];
  }
  out.write("time", times, "s", "output times");
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    write_body_states(out, model.bodies[b], b, history);
  }
  write_probes(out, history);
  write_energies(out, history);
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
