// SPDX-License-Identifier: BSD-3-Clause
#include "duration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "limber/common/errors.hpp"

namespace limber::bench {
namespace {

constexpr double kSettled = 1e3;    // steps after which the blow is over
constexpr double kAccurate = 0.01;  // of the energy that passed through

struct Row {
  double steps = 0.0;
  double energy = 0.0;
  double momentum = 0.0;
};

// Compares each output with the first after the blow.
class Audit {
 public:
  explicit Audit(double step) : step_(step) {}

  void add(double t, const dynamics::EnergyBalance& now) {
    if (t == 0.0) start_ = now;
    if (t == 0.0 || std::round(t / step_) < kSettled) return;
    if (!is_settled_) settled_ = now;
    is_settled_ = true;
    const double passed =
        std::max({start_.total(), now.total(), std::abs(now.work)});
    const double open =
        now.total() + now.dissipated - start_.total() - now.work;
    rows_.push_back({std::round(t / step_), std::abs(open) / passed,
                     (now.angular_momentum - settled_.angular_momentum).norm() /
                         settled_.angular_momentum.norm()});
  }

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

 private:
  double step_;
  bool is_settled_ = false;
  dynamics::EnergyBalance start_;
  dynamics::EnergyBalance settled_;
  std::vector<Row> rows_;
};

std::string write_rows(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("{} {} {}\n", row.steps, row.energy, row.momentum);
  }
  return text;
}

std::string tell(const std::vector<Row>& rows, Class kind,
                 const std::string& text) {
  return fmt::format("{} {}\n{}{}", rows.size(), static_cast<int>(kind),
                     write_rows(rows), text);
}

std::string judge_rows(const std::vector<Row>& rows) {
  const double energy = rows.back().energy;
  if (!std::isfinite(energy) || !std::isfinite(rows.back().momentum)) {
    return tell(rows, Class::failed, "an output is not finite");
  }
  if (energy > 10.0) return tell(rows, Class::failed, "garbage");
  if (energy < kAccurate) return tell(rows, Class::accurate, "");
  return tell(rows, Class::inaccurate, "stable but inaccurate");
}

}  // namespace

Cell make_long_cell(dynamics::IntegratorKind integrator) {
  Cell cell;
  cell.bodies = 2;
  cell.spin = 0.05;
  cell.damping = 0.0;
  cell.stiffness = 1e7;
  cell.step = 1e-5;
  cell.integrator = integrator;
  return cell;
}

std::string run_long(const Cell& cell, const Beams& beams, double steps) {
  Audit audit(cell.step);
  try {
    Scene scene = make_scene(cell, beams);
    scene.settings.end_time = steps * cell.step;
    scene.settings.output_times = {0.0};
    for (double n = kSettled; n <= 1.0001 * steps; n *= std::sqrt(10.0)) {
      const double t =
          std::min(scene.settings.end_time, std::round(n) * cell.step);
      scene.settings.output_times.push_back(t);
    }
    dynamics::simulate(scene.model, scene.state, scene.settings,
                       [&](const dynamics::SystemState& now,
                           const dynamics::EnergyBalance& energy) {
                         audit.add(now.t, energy);
                       });
    return judge_rows(audit.rows());
  } catch (const InputError& error) {
    return tell(audit.rows(), Class::refused, error.what());
  } catch (const NumericalError& error) {
    return tell(audit.rows(), Class::refused, error.what());
  } catch (const std::exception& error) {
    return tell(audit.rows(), Class::failed, error.what());
  }
}

Duration read_duration(const Cell& cell, const Ending& ending) {
  Duration duration;
  duration.integrator = cell.integrator;
  duration.verdict.seconds = ending.seconds;
  if (ending.kind != Ending::Kind::done) {
    duration.verdict.text =
        ending.kind == Ending::Kind::hung ? "hung" : "crashed";
    return duration;
  }
  std::istringstream stream(ending.answer);
  std::size_t rows = 0;
  int kind = 0;
  stream >> rows >> kind;
  duration.verdict.kind = static_cast<Class>(kind);
  for (std::size_t i = 0; i < rows; ++i) {
    std::string steps, energy, momentum;  // any of them may be nan
    stream >> steps >> energy >> momentum;
    duration.steps.push_back(std::stod(steps));
    duration.energy.push_back(std::stod(energy));
    duration.momentum.push_back(std::stod(momentum));
  }
  stream.get();
  std::getline(stream, duration.verdict.text, '\0');
  if (rows > 0) duration.verdict.error = duration.energy.back();
  return duration;
}

}  // namespace limber::bench
