// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace limber {
class Manifest;
}

namespace limber::dynamics {

struct SystemModel;
struct SystemState;

/// Course of an input between two samples of its controller.
enum class InputHold {
  held,    ///< jumps to what was written, and stays
  linear,  ///< reaches what was written one period later, without a jump
};
[[nodiscard]] std::string_view to_string(InputHold hold);

/// A named value that one controller writes, and drives and loads follow
/// (joints::InputSignal, InputFunction).
struct Input {
  std::string name;
  double initial = 0.0;  ///< before the first sample [unit of the input]
  InputHold hold = InputHold::held;
};

/// Read-only view of a system for a controller at a sample.
struct ControllerView {
  double t = 0.0;   ///< [s]
  long sample = 0;  ///< k, counted from 0 at the offset
  const SystemModel& model;
  const SystemState& state;          ///< inputs as they are before the sample
  std::span<const double> measured;  ///< by ControllerModel::measures
};

/// A control law. Runs share it, possibly in several threads, so `sample` must
/// depend on its arguments only.
class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  /// Called once a sample.
  /// @param memory its values kept between samples (ControllerModel::memory),
  /// which it may change
  /// @param written output, one value for each of ControllerModel::writes [unit
  /// of the input]
  /// @throws anything derived from std::exception to end the run.
  virtual void sample(const ControllerView& view, std::span<double> memory,
                      std::span<double> written) const = 0;

  /// Adds everything except arguments that its output depends on: compared when
  /// a run resumes from a checkpoint.
  virtual void describe(Manifest& out) const = 0;

  /// Whether it keeps data between samples outside of its memory. A run with
  /// such a law cannot be repeated: no checkpoints and no verified tolerance
  /// are possible.
  [[nodiscard]] virtual bool has_hidden_memory() const { return false; }
};

/// A value that a controller measures, as a function of the state, since the
/// library does not know every measured quantity.
struct Measurement {
  std::string name;
  std::string of;  ///< what identifies `measure` where checkpoints compare it
  /// Depends on its arguments alone [any unit].
  std::function<double(const SystemModel&, const SystemState&)> measure;
};

/// A controller in a system. Samples are taken at offset + k period, k = 0, 1,
/// ..., from the start to the end of a run, both included, after the step that
/// ends there; those before the start are skipped.
///
/// Limits     the law takes no time: its output acts from the sample on
struct ControllerModel {
  std::string name;
  double period = 0.0;      ///< > 0 [s]
  double offset = 0.0;      ///< of the first sample [s]
  std::vector<int> writes;  ///< indices of inputs
  std::vector<Measurement> measures = {};
  std::vector<double> memory = {};  ///< at the start [its own units]
  std::shared_ptr<const Controller> law;

  /// Time of sample k [s].
  [[nodiscard]] double find_time(long k) const {
    return offset + static_cast<double>(k) * period;
  }
  /// The first sample at t or later, or earlier by no more than `same` [s].
  [[nodiscard]] long find_first(double t, double same) const;
};

/// A law given as a function, described by a text only.
class FunctionController : public Controller {
 public:
  using Function = std::function<void(const ControllerView&, std::span<double>,
                                      std::span<double>)>;
  enum class Memory { in_state, hidden };

  /// @param identity text for describe(), to change with the function
  FunctionController(std::string identity, Function function,
                     Memory memory = Memory::in_state);

  void sample(const ControllerView& view, std::span<double> memory,
              std::span<double> written) const override;
  void describe(Manifest& out) const override;
  [[nodiscard]] bool has_hidden_memory() const override;

 private:
  std::string identity_;
  Function function_;
  Memory memory_;
};

}  // namespace limber::dynamics
