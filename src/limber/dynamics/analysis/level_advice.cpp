// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/level_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

/// Fraction of the buckling load that the estimate cannot resolve [-].
constexpr double kNearBuckling = 0.1;

void check_setting(const std::optional<double>& value, const char* what,
                   const char* unit) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return;
  throw InputError(
      fmt::format("advice: the {} is {:g} {}; expected a positive number", what,
                  *value, unit));
}

/// Shift of the upper frequency of a pair of modes by their Coriolis coupling 2
/// b: s^4 - (a + c + 4 b^2) s^2 + a c = 0.
double shift_pair(double lambda_k, double lambda_l, double b) {
  const double spread = std::abs(lambda_k - lambda_l);
  const double coupling = 4.0 * b * b;
  // (p^2 - 4 a c), p = a + c + 4 b^2, written without cancellation.
  const double root = std::sqrt(
      spread * spread + coupling * (2.0 * (lambda_k + lambda_l) + coupling));
  const double upper = std::max(lambda_k, lambda_l);
  const double risen = 0.5 * (coupling + root - spread);  // s^2 - upper
  return risen / (std::sqrt(upper + risen) + std::sqrt(upper));
}

/// Largest Coriolis coupling of two modes, Omega . beta_kl [rad/s].
double bound_coriolis(const BodyModel& body, const BodyPeaks& peaks, int k,
                      int l) {
  return peaks.Omega_B.dot(Vector3(body.inertia->beta(k).row(l)).cwiseAbs());
}

/// Effect of rotation on the modes' oscillation in `time` [s]: excitation of
/// mode k by mode l, limited by the difference of their frequencies, and
/// frequency shifts.
VectorX find_modal_drift(const BodyModel& body, const BodyPeaks& peaks,
                         double time) {
  const VectorX& lambda = require_eigenvalues(body, "advice on levels");
  const VectorX omega = lambda.cwiseSqrt();
  const double Omega = peaks.Omega.value;
  const auto bound = [](double fraction) { return std::min(fraction, 2.0); };
  VectorX drift(body.modes);
  for (int k = 0; k < body.modes; ++k) {
    drift[k] = bound(time * Omega * Omega / omega[k]) * peaks.oscillation[k];
    for (int l = 0; l < body.modes; ++l) {
      if (l == k) continue;
      const double b = bound_coriolis(body, peaks, k, l);
      const double apart = std::abs(lambda[k] - lambda[l]);
      const double exchanged = std::min(b * time, 4.0 * b * omega[l] / apart);
      drift[k] += bound(exchanged) * peaks.oscillation[l];
      if (2.0 * b > std::abs(omega[k] - omega[l])) continue;  // the same again
      const double shift = shift_pair(lambda[k], lambda[l], b);
      drift[k] += bound(time * shift) * peaks.oscillation[k];
    }
  }
  return drift;
}

/// Largest forces on the modes that one-way neglects: Coriolis forces and the
/// centrifugal force of the deformation.
VectorX bound_forces(const BodyModel& body, const BodyPeaks& peaks) {
  const Vector6 w_squared = half_square(peaks.Omega_B);
  const VectorX rates = require_eigenvalues(body, "advice on levels")
                            .cwiseSqrt()
                            .cwiseProduct(peaks.oscillation);
  VectorX forces = VectorX::Zero(body.modes);
  for (int k = 0; k < body.modes; ++k) {
    for (int l = 0; l < body.modes; ++l) {
      const Vector6 J2 = body.inertia->J2(k).row(l).cwiseAbs();
      forces[k] += 2.0 * bound_coriolis(body, peaks, k, l) * rates[l] +
                   w_squared.dot(J2) * peaks.modes[l];
    }
  }
  return forces;
}

/// Error of one-way in the modes' motion [m].
double find_modal_error(const BodyModel& body, const BodyPeaks& peaks) {
  if (peaks.Omega.value == 0.0) return 0.0;
  const VectorX drift =
      find_modal_drift(body, peaks, peaks.angle / peaks.Omega.value);
  const VectorX answer =
      bound_forces(body, peaks)
          .cwiseQuotient(require_eigenvalues(body, "advice on levels"));
  return peaks.mode_sizes.dot(answer + drift);
}

/// Fraction of the stiffness that axial load gives and `coupled` lacks, by
/// differences of its frequencies and deflections from those of the closed
/// forms (docs/theory/choosing.md). The frame of a held body has the rest.
double find_missing(const BodyPeaks& peaks) {
  return peaks.is_held ? 0.25 : 0.6;
}

/// Of each mode alone, by its dampers and its material [1/s].
VectorX find_damping_rates(const BodyModel& body) {
  VectorX rates = body.damping;
  for (Eigen::Index k = 0; k < rates.size(); ++k) {
    const double omega =
        std::sqrt(flexbody::rest_stiffness(body.elasticity)[k]);
    rates[k] +=
        omega *
        flexbody::find_dynamic_stiffness(body.maxwell, {0.0, omega}).imag();
  }
  return rates;
}

/// Damped oscillation has no later phase. @param time in which a phase shifts,
/// an integral of values up to `largest` [s] @param rate of damping [1/s]
double find_remembered(double time, double largest, double rate) {
  return rate > 0.0 ? std::min(time, 2.0 * largest / rate) : time;
}

/// Error of `coupled`: of static deformation, which tension lessens and
/// compression raises, and of the phase of oscillation.
double find_axial_error(const BodyModel& body, const BodyPeaks& peaks) {
  const double missing = find_missing(peaks);
  const double pulled = peaks.tension.value / (1.0 + peaks.tension.value);
  const double pushed = peaks.compression.value /
                        std::max(1.0 - peaks.compression.value, kNearBuckling);
  const double bent = missing * std::max(pulled, pushed) * peaks.total.value;
  const double most = std::max(peaks.tension.value, peaks.compression.value);
  const double time = find_remembered(peaks.axial_time, most,
                                      find_damping_rates(body).minCoeff());
  const double phase = 0.5 * missing * peaks.frequency * time;
  const double oscillation =
      std::min(peaks.mode_sizes.dot(peaks.oscillation), peaks.total.value);
  return bent + std::min(phase, 2.0) * oscillation;
}

/// Error of `nonlinear`: an axial mode is stiffer by three times the mean
/// strain, which shifts its phase.
double find_stretch_error(const BodyModel& body, const BodyPeaks& peaks) {
  const VectorX& lambda = require_eigenvalues(body, "advice on levels");
  const VectorX rates = find_damping_rates(body);
  double error = 0.0;
  for (int k = 0; k < body.modes; ++k) {
    const double time =
        find_remembered(peaks.strain_time, peaks.strain.value, rates[k]);
    const double phase = 1.5 * std::sqrt(lambda[k]) * time;
    error += peaks.mode_sizes[k] * peaks.stretch[k] * std::min(phase, 2.0);
  }
  return error;
}

/// "1.2e-06 m".
std::string metres(double value) { return fmt::format("{:.2g} m", value); }

/// Whether the user neglects an error, or it is a small fraction of the
/// deformation.
bool is_negligible(double error, const BodyPeaks& peaks,
                   const LevelLimits& limits) {
  return error <=
         std::max(limits.displacement, kLargestFraction * peaks.total.value);
}

/// Why linear elasticity is insufficient, or even `nonlinear`.
std::string explain_nonlinear(const BodyPeaks& peaks, const LevelLimits& limits,
                              const LevelAdvice& advice) {
  std::string text;
  const auto add = [&](const std::string& more) {
    text += (text.empty() ? "" : "; ") + more;
  };
  if (peaks.deformation.value > limits.linear_limit) {
    add(
        fmt::format("it deforms by {} at t = {:.6g} s, beyond the linear limit "
                    "of {}",
                    metres(peaks.deformation.value), peaks.deformation.time,
                    metres(limits.linear_limit)));
  }
  if (peaks.relative_rotation.value > kLargestRotation ||
      peaks.rotation.value > kLargestRotation) {
    add(fmt::format(
        "its interfaces rotate by {:.2g} rad, relative to one "
        "another by {:.2g} rad, beyond {:g} rad",
        peaks.rotation.value, peaks.relative_rotation.value, kLargestRotation));
  }
  const bool is_stretched =
      !is_negligible(advice.errors.nonlinear, peaks, limits);
  if (is_stretched) {
    add(fmt::format(
        "its mean strain reaches {:.2g}, which shifts the phase of its "
        "oscillation along itself: without it the error may reach {} of {}",
        peaks.strain.value, metres(advice.errors.nonlinear),
        metres(peaks.total.value)));
  } else if (!is_negligible(advice.errors.coupled, peaks, limits)) {
    add(fmt::format(
        "its axial load reaches {:.2g} of that at which it buckles under "
        "tension, {:.2g} under compression: without geometric stiffness the "
        "error may reach {} of {}",
        peaks.tension.value, peaks.compression.value,
        metres(advice.errors.coupled), metres(peaks.total.value)));
  }
  if (advice.level == Fidelity::full) {
    add(is_stretched ? "only level full is valid"
                     : "only level full is valid, or level nonlinear of the "
                       "link in more pieces");
  }
  return text;
}

/// Of its own nodes first: what it carries may move by much more.
std::string describe_deformation(const BodyPeaks& peaks,
                                 const LevelErrors& errors) {
  constexpr double kFarther = 1.2;
  const std::string own =
      fmt::format("it deforms by {}", metres(peaks.deformation.value));
  if (errors.rigid <= kFarther * peaks.deformation.value) return own;
  return fmt::format("{}, which moves the bodies attached to it by up to {}",
                     own, metres(errors.rigid));
}

std::string explain(const BodyModel& body, const BodyPeaks& peaks,
                    const LevelLimits& limits, const LevelAdvice& advice) {
  const std::string limit = metres(limits.displacement);
  const LevelErrors& e = advice.errors;
  switch (advice.level) {
    case Fidelity::rigid:
      if (body.modes == 0) return "it has no modes";
      return fmt::format("its modes move it by at most {}, within {}",
                         metres(e.rigid), limit);
    case Fidelity::uncoupled:
      if (body.clamped) {
        return fmt::format("it bends by {}, more than {}; it does not rotate",
                           metres(e.rigid), limit);
      }
      return fmt::format("{}; rotation changes that by {}, within {}",
                         describe_deformation(peaks, e), metres(e.uncoupled),
                         limit);
    case Fidelity::one_way:
      if (e.uncoupled <= limits.displacement) {
        return fmt::format(
            "nodal inertial forces reach {:.2g} N, more than {:.2g} N; the "
            "terms that one-way neglects move it by {}, within {}",
            peaks.force.value, limits.force.value_or(0.0), metres(e.one_way),
            limit);
      }
      return fmt::format(
          "inertial forces move it by {}, more than {}; the terms that one-way "
          "neglects, by {}",
          metres(e.uncoupled), limit, metres(e.one_way));
    case Fidelity::nonlinear:
    case Fidelity::full:
      return explain_nonlinear(peaks, limits, advice);
    case Fidelity::coupled:
      break;
  }
  return fmt::format(
      "{}, while it rotates by {:.2g} rad at up to {:.2g} rad/s: without "
      "coupling the error may reach {}, more than {}",
      describe_deformation(peaks, e), peaks.angle, peaks.Omega.value,
      metres(e.one_way), limit);
}

}  // namespace

void check(const AdviceSettings& settings) {
  check_setting(settings.displacement, "neglected displacement", "m");
  check_setting(settings.linear_limit, "linear limit", "m");
  check_setting(settings.force, "force limit", "N");
}

LevelLimits find_limits(const AdviceSettings& settings,
                        const flexbody::ReducedBody& body) {
  check(settings);
  const double size = body.size.maxCoeff();
  return {settings.displacement.value_or(kNeglectedFraction * size),
          settings.linear_limit.value_or(kLinearFraction * size),
          settings.force};
}

LevelErrors estimate_errors(const BodyModel& body, const BodyPeaks& peaks) {
  (void)require_eigenvalues(body, "advice on levels");
  LevelErrors errors;
  errors.rigid = peaks.total.value;
  if (body.modes == 0 || body.clamped) return errors;
  errors.nonlinear = find_stretch_error(body, peaks);
  errors.coupled = std::max(find_axial_error(body, peaks), errors.nonlinear);
  errors.one_way = find_modal_error(body, peaks) + peaks.turned_aside;
  errors.rigid += peaks.turned_aside;
  errors.uncoupled = kSudden * peaks.inertial.value + errors.one_way;
  return errors;
}

LevelAdvice advise(const BodyModel& body, const BodyPeaks& peaks,
                   const LevelLimits& limits) {
  LIMBER_EXPECT(body.reduced != nullptr);
  LevelAdvice advice;
  advice.errors = estimate_errors(body, peaks);
  const bool is_forced = limits.force && peaks.force.value > *limits.force;
  const auto is_small = [&](double error) {
    return error <= limits.displacement;
  };
  if (is_small(advice.errors.rigid) && !is_forced) {
    advice.level = Fidelity::rigid;
  } else if (is_small(advice.errors.uncoupled) && !is_forced) {
    advice.level = Fidelity::uncoupled;
  } else if (is_small(advice.errors.one_way)) {
    advice.level = Fidelity::one_way;
  }
  advice.is_beyond_linear = peaks.deformation.value > limits.linear_limit ||
                            peaks.relative_rotation.value > kLargestRotation;
  if (advice.is_beyond_linear ||
      (advice.level > Fidelity::rigid &&
       !is_negligible(advice.errors.coupled, peaks, limits))) {
    const bool is_too_far =
        peaks.rotation.value > kLargestRotation ||
        peaks.compression.value > kLargestLoad ||
        !is_negligible(advice.errors.nonlinear, peaks, limits);
    advice.level = is_too_far ? Fidelity::full : Fidelity::nonlinear;
  }
  advice.reason = explain(body, peaks, limits, advice);
  return advice;
}

}  // namespace limber::dynamics
