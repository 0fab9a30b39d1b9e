// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// Exact friction of Hertz's area under any history of its load.
namespace limber::contact::test {

/// 2000 rings of equal width, each a pair of springs that carry 2 E* times its
/// width at depth - x^2 / R, kappa of that tangentially, and slip at mu g times
/// their load: the Cattaneo-Mindlin-Jaeger solution by the method of
/// dimensionality reduction [Popov and Hess 2015].
class Rings {
 public:
  struct Surface {
    double radius = 0.0;    ///< R [m]
    double modulus = 0.0;   ///< E* [Pa]
    double ratio = 0.0;     ///< kappa [-]
    double friction = 0.0;  ///< mu [-]
  };
  Rings(const Surface& surface, double most_depth)
      : surface_(surface), springs_(2000, 0.0) {
    width_ = std::sqrt(surface.radius * most_depth * 1.02) /
             static_cast<double>(springs_.size());
  }

  /// @return the tangential force against the motion [N]
  /// @param grip normal force with damping over the elastic one [-]
  double move(double depth, double way, double grip) {
    double sum = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const double x = (static_cast<double>(i) + 0.5) * width_;
      const double most = surface_.friction * grip / surface_.ratio *
                          std::max(depth - x * x / surface_.radius, 0.0);
      springs_[i] = std::clamp(springs_[i] + way, -most, most);
      sum += springs_[i];
      square += springs_[i] * springs_[i];
    }
    const double k = 2.0 * surface_.ratio * surface_.modulus * width_;
    stored_ = 0.5 * k * square;
    return k * sum;
  }
  [[nodiscard]] double energy() const { return stored_; }

 private:
  Surface surface_;
  double width_ = 0.0;
  double stored_ = 0.0;
  std::vector<double> springs_;
};

}  // namespace limber::contact::test
