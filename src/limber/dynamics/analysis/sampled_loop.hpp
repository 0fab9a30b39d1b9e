// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/analysis/linear_model.hpp"
#include "limber/dynamics/analysis/stepped_motion.hpp"
#include "limber/dynamics/control/linear_law.hpp"
#include "limber/dynamics/system/controller.hpp"

namespace limber::dynamics {

/// An input of a linear model that a controller writes.
struct LoopInput {
  Eigen::Index value = 0;  ///< column of B and D
  Eigen::Index rate = -1;  ///< that of its rate; -1: none
  InputHold hold = InputHold::held;
};

/// An input of a linear model that the reference of a controller follows.
struct LoopReference {
  Eigen::Index input = -1;  ///< column of its value in B and D; -1: none
  double factor = 1.0;
};

/// A linear controller of a linear model.
struct LoopController {
  std::string name;
  double period = 0.0;  ///< > 0 [s]
  double offset = 0.0;  ///< of its samples [s]
  LinearLaw law;
  std::vector<Eigen::Index> measures;  ///< rows of C and D
  std::vector<LoopInput> writes;
  LoopReference reference = {};
  double reference_value = 0.0;  ///< at the state of the linear model
};

/// Equal steps by which a loop moves between its samples, in place of exact
/// motion.
struct LoopSteps {
  AlphaParameters parameters;
  double longest = 0.0;          ///< > 0 [s]
  Eigen::Index coordinates = 0;  ///< LinearSystem::coordinates of the plant
};

/// A linear model and its sampled controllers, as one discrete system.
///
/// Equation   x = (z, inputs, their slopes, states of the laws) just before the
///            samples at the beginning of a common period T;
///            x_(k+1) = A x_k + B w_k,   y_k = C x_k + D w_k
///            A, B: products of the maps of each sample, and of exp(M dt)
///            between samples, z' = A z + B u, u' its slope; w: inputs that
///            nothing writes, and references, held over T
/// Source     discretisation with hold by one exponential of the joint matrix
///            [@vanloan1978]; periodic systems by their monodromy matrix
/// Limits     dense; periods that have a common multiple of at most 64 of the
///            longest. Delays are states of the laws
class SampledLoop {
 public:
  /// @param plant stored by reference
  /// @param steps none: exact motion
  /// @throws InputError if the periods have no common multiple, or too many
  /// samples in it: their number times the cube of the size is at most 5e8.
  SampledLoop(const LinearModel& plant, std::vector<LoopController> controllers,
              const std::optional<LoopSteps>& steps = std::nullopt);

  [[nodiscard]] double period() const { return period_; }  ///< T [s]
  [[nodiscard]] const std::vector<LoopController>& controllers() const {
    return controllers_;
  }
  /// Of exact motion. States NAME, NAME.rate and CONTROLLER.state_1, ...;
  /// inputs those of the plant that no controller writes, then
  /// CONTROLLER.reference.
  [[nodiscard]] LinearModel find_model();

  /// A pole outside of the unit circle that the controllers move.
  struct Instability {
    std::complex<double> pole;  ///< of the period T
    double growth = 0.0;        ///< log |pole| / T [1/s]
    double frequency = 0.0;     ///< |arg pole| / (2 pi T), up to 1/2T [Hz]
    std::vector<std::size_t>
        loops;  ///< of controllers whose gains move it most
  };
  /// That of the largest such pole; none if there is none that grows by more
  /// than 1e-5 in a period, the round-off of free motion. Not of the plant's
  /// own instability, which no controller changes: a pole whose first
  /// derivative by all their gains, each in units of itself, is below a tenth
  /// of its growth.
  [[nodiscard]] std::optional<Instability> find_instability();

 private:
  // Columns of all that is in the joint state.
  struct Layout {
    Eigen::Index inputs = 0;
    Eigen::Index slopes = 0;
    Eigen::Index laws = 0;
    Eigen::Index external = 0;  // inputs that nothing writes
    Eigen::Index references = 0;
    Eigen::Index size = 0;
  };
  struct Sample {
    double time = 0.0;  // in the period [s]
    std::vector<std::size_t> controllers;
  };

  void find_layout();
  void find_samples();
  [[nodiscard]] const MatrixX& find_flow(double duration);
  [[nodiscard]] MatrixX find_exact_flow(double duration) const;
  [[nodiscard]] MatrixX find_stepped_flow(double duration) const;
  // Their columns of B.
  [[nodiscard]] MatrixX find_external_inputs() const;
  [[nodiscard]] MatrixX find_jump(const Sample& sample, std::size_t scaled,
                                  double gain) const;
  // Over a period, of the joint state; with one controller's outputs scaled.
  [[nodiscard]] MatrixX find_transition(std::size_t scaled = 0,
                                        double gain = 1.0);
  [[nodiscard]] MatrixX find_outputs() const;
  // A controller's measurements, reference and rate of the reference.
  [[nodiscard]] MatrixX find_seen(std::size_t controller,
                                  const MatrixX& outputs) const;
  // |d pole / d gain| of each controller.
  [[nodiscard]] std::vector<double> find_sensitivities(
      const MatrixX& A, const Eigen::VectorXcd& v, std::complex<double> pole);

  const LinearModel& plant_;
  std::optional<SteppedMotion> steps_;
  std::vector<LoopController> controllers_;
  double period_ = 0.0;
  std::vector<Sample> samples_;
  std::vector<LoopInput> written_;
  std::vector<Eigen::Index> external_;       // columns of B
  std::vector<Eigen::Index> first_written_;  // of each controller
  std::vector<Eigen::Index> first_law_;      // likewise
  Layout at_;
  std::map<double, MatrixX> flows_;  // by duration [s]
};

}  // namespace limber::dynamics
