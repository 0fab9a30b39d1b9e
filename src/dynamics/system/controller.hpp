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

/// What an input does between two samples of its controller.
enum class InputHold {
  held,    ///< jumps to what was written, and stays
  linear,  ///< reaches what was written one period later, without a jump
};
[[nodiscard]] std::string_view to_string(InputHold hold);

/// A named number that one controller writes, and drives and loads follow
/// (joints::InputSignal, InputFunction).
struct Input {
  std::string name;
  double initial = 0.0;  ///< before the first sample [unit of the input]
  InputHold hold = InputHold::held;
};

/// What a controller sees of a system at a sample.
struct ControllerView {
  double t = 0.0;   ///< [s]
  long sample = 0;  ///< k, counted from 0 at the offset
  const SystemModel& model;
  const SystemState& state;          ///< inputs as they are before the sample
  std::span<const double> measured;  ///< by ControllerModel::measures
};

/// A control law. It is shared by runs, perhaps in several threads, so that
/// `sample` depends on its arguments alone.
class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  /// Called once a sample.
  /// @param memory what it keeps between samples (ControllerModel::memory); it
  /// may change it
  /// @param written to be filled: one for each of ControllerModel::writes [unit
  /// of the input]
  /// @throws anything derived from std::exception to end the run.
  virtual void sample(const ControllerView& view, std::span<double> memory,
                      std::span<double> written) const = 0;

  /// All that its output depends on beside its arguments: what goes on from a
  /// checkpoint compares it.
  virtual void describe(Manifest& out) const = 0;

  /// Whether it keeps anything between samples that is not in its memory. A run
  /// with such a law cannot be repeated: it takes no checkpoints and no passes
  /// to a tolerance.
  [[nodiscard]] virtual bool has_hidden_memory() const { return false; }
};

/// A number that a controller measures. Not all that is measured can be told
/// from the state by this library: whoever knows brings a function.
struct Measurement {
  std::string name;
  std::string of;  ///< what identifies `measure` where checkpoints compare it
  /// Depends on its arguments alone [any unit].
  std::function<double(const SystemModel&, const SystemState&)> measure;
};

/// A controller in a system. Samples are taken at offset + k period, k = 0, 1,
/// ..., from the start to the end of a run, both included, after the step that
/// ends there; those before the start are left out.
///
/// Limits     time is continuous between samples: the law itself takes none
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

/// A law that is a function, for one that has nothing to describe but a text.
class FunctionController : public Controller {
 public:
  using Function = std::function<void(const ControllerView&, std::span<double>,
                                      std::span<double>)>;
  enum class Memory { in_state, hidden };

  /// @param identity what describe() says: change it whenever the function does
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
