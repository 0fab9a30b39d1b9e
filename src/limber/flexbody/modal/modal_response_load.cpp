// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/modal_response_load.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

using Problems = std::vector<std::string>;

void append(Problems& problems, const Problems& more) {
  problems.insert(problems.end(), more.begin(), more.end());
}

Problems find_step_problems(const StepLoad& steps, Eigen::Index modes) {
  Problems problems = find_time_problems(steps.times, 0, "step load");
  if (steps.times.empty() && steps.values.size() == 0) return problems;
  if (steps.values.rows() != modes ||
      std::ssize(steps.times) != steps.values.cols()) {
    problems.push_back(fmt::format(
        "step load: values are {} x {}; expected a row for each of {} modes "
        "and a column for each of {} times",
        steps.values.rows(), steps.values.cols(), modes, steps.times.size()));
  }
  append(problems, find_value_problems(steps.values, "step load"));
  return problems;
}

Problems find_sinusoid_problems(const SinusoidalLoad& load, Eigen::Index modes,
                                const std::string& what) {
  Problems problems;
  if (!(load.omega >= 0.0) || !std::isfinite(load.omega)) {
    problems.push_back(fmt::format("{}: frequency is {:g} rad/s; expected >= 0",
                                   what, load.omega));
  }
  if (!std::isfinite(load.from) || !(load.until > load.from)) {
    problems.push_back(
        fmt::format("{}: lasts from {:g} s until {:g} s; expected a later end",
                    what, load.from, load.until));
  }
  if (load.cosine.size() != modes || load.sine.size() != modes) {
    problems.push_back(fmt::format(
        "{}: {} cosine and {} sine amplitudes; expected one for each of {} "
        "modes",
        what, load.cosine.size(), load.sine.size(), modes));
  }
  if (!load.cosine.allFinite() || !load.sine.allFinite()) {
    problems.push_back(fmt::format("{}: an amplitude is not finite", what));
  }
  return problems;
}

}  // namespace

void check(const ModalLoads& loads, Eigen::Index modes) {
  Problems problems = find_step_problems(loads.steps, modes);
  for (std::size_t i = 0; i < loads.sinusoids.size(); ++i) {
    append(problems, find_sinusoid_problems(loads.sinusoids[i], modes,
                                            fmt::format("sinusoid {}", i)));
  }
  refuse(std::move(problems));
}

Problems find_time_problems(const std::vector<double>& times, std::size_t least,
                            const std::string& what) {
  Problems problems;
  if (times.size() < least) {
    problems.push_back(fmt::format("{}: {} times; expected at least {}", what,
                                   times.size(), least));
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) {
      problems.push_back(fmt::format("{}: time {} is not finite", what, i));
    } else if (i > 0 && times[i] <= times[i - 1]) {
      problems.push_back(fmt::format(
          "{}: times must increase, but time {} is {:g} s after {:g} s", what,
          i, times[i], times[i - 1]));
    }
  }
  return problems;
}

Problems find_value_problems(const MatrixX& values, const std::string& what) {
  Problems problems;
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    if (!values.col(j).allFinite()) {
      problems.push_back(
          fmt::format("{}: a value at time {} is not finite", what, j));
    }
  }
  return problems;
}

void refuse(Problems problems) {
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace limber::flexbody
