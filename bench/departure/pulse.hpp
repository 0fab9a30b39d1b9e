// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "full_modes.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/reduction/meshed_body.hpp"

/// The report's beam under a smooth pulse at its tip: how many vectors of which
/// kind represent its response.
namespace limber::bench::departure {

enum class Source { krylov, eigenmodes, mixed };
inline constexpr std::array<Source, 3> kSources = {
    Source::krylov, Source::eigenmodes, Source::mixed};
[[nodiscard]] std::string to_string(Source source);

inline constexpr int kMostVectors = 10;

/// Errors of 1 to kMostVectors vectors, a row a source of kSources [-].
using Errors = Eigen::Matrix<double, 3, kMostVectors>;

/// The beam free or clamped at z = 0, pushed along x by a force spread evenly
/// over z = 5 m, and all its modes.
class PushedBeam {
 public:
  explicit PushedBeam(bool is_clamped);

  [[nodiscard]] double first_period() const;  ///< of all modes' first [s]
  [[nodiscard]] Eigen::Index mode_count() const { return full_.lambda.size(); }

  /// Under a pulse sin^4(pi t / duration): root mean square, over the tip's
  /// nodes and from the pulse's start to ten first periods after its end, of
  /// the distance from the deformation by all modes, relative to that of the
  /// deformation itself. Both exact in time.
  /// @param duration [s]
  [[nodiscard]] Errors find_errors(double duration) const;

 private:
  [[nodiscard]] flexbody::ReducedBasis make_basis(Source source,
                                                  int count) const;
  [[nodiscard]] MatrixX respond(const flexbody::ReducedBasis& basis,
                                double duration) const;

  FullModes full_;
  flexbody::MeshedBody body_;
  VectorX load_;  // on the free nodes [N]
  std::vector<Eigen::Index> tip_;
  std::vector<std::vector<flexbody::ReducedBasis>> bases_;  // by source, count
};

}  // namespace limber::bench::departure
