// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "limber/common/stack_array.hpp"
#include "limber/contact/shapes/straight_line.hpp"

/// Sums over points of a surface within another body, by lines or flats of one
/// normal.
namespace limber::contact {

using Weights10 = Eigen::Matrix<double, 10, 1>;
using Slopes = Eigen::Matrix<double, 10, 6>;

// 1, r and r r': xx, yy, zz, xy, xz, yz
inline Weights10 find_powers(const Vector3& r) {
  Weights10 powers;
  powers[0] = 1.0;
  powers.segment<3>(1) = r;
  powers.segment<3>(4) = r.cwiseAbs2();
  powers[7] = r.x() * r.y();
  powers[8] = r.x() * r.z();
  powers[9] = r.y() * r.z();
  return powers;
}

// Of the depth at r, by a motion (u, theta) about o.
inline Vector6 find_rate(const Depth& depth, const Vector3& r) {
  Vector6 g;
  g.head<3>() = depth.gradient;
  g.tail<3>() = r.cross(depth.gradient);
  return g;
}

inline Matrix3 unfold(const Eigen::Matrix<double, 6, 1>& s) {
  Matrix3 square;
  square << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return square;
}

/// Of a line, or a flat, of one normal: with p the powers of r about o
struct LineSums {
  Weights10 cubed = Weights10::Zero();  ///< int 4 t^3 p
  Slopes by_motion = Slopes::Zero();    ///< int 12 t^2 p g'
  Vector3 flux = Vector3::Zero();       ///< int phi grad t

  void add(const Depth& depth, const Vector3& r, double weight) {
    const double t2 = depth.t * depth.t;
    const Weights10 powers = find_powers(r);
    flux += weight * depth.flux;
    cubed += (4.0 * weight * t2 * depth.t) * powers;
    const Vector6 g = find_rate(depth, r);
    by_motion += ((12.0 * weight * t2) * powers) * g.transpose();
  }
};

/// Sums over the surface of `hard`.
struct SurfaceSums {
  double flux = 0.0;
  std::array<Weights10, 3> cubed;   // int 4 t^3 n_k p dS
  std::array<Slopes, 3> by_motion;  // int 12 t^2 n_k p g' dS

  SurfaceSums() {
    cubed.fill(Weights10::Zero());
    by_motion.fill(Slopes::Zero());
  }

  [[nodiscard]] static LineSums begin_line() { return {}; }
  void add(const LineSums& line, const Vector3& area) {
    flux += line.flux.dot(area);
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = area[static_cast<Eigen::Index>(k)];
      if (n == 0.0) continue;
      cubed[k] += n * line.cubed;
      by_motion[k] += n * line.by_motion;
    }
  }

  [[nodiscard]] Vector6 find_wrench() const {
    Matrix3 first;  // by rows n r'
    Vector6 wrench;
    for (int k = 0; k < 3; ++k) {
      const Weights10& sums = cubed[static_cast<std::size_t>(k)];
      wrench[k] = sums[0];
      first.row(k) = sums.segment<3>(1).transpose();
    }
    wrench.tail<3>() = find_moment(first);
    return wrench;
  }

  // int 12 t^2 (n, r x n) g' dS
  [[nodiscard]] Matrix6 find_stiffness() const {
    Matrix6 all;
    for (int i = 0; i < 6; ++i) {
      Matrix3 first;
      for (int k = 0; k < 3; ++k) {
        const Slopes& sums = by_motion[static_cast<std::size_t>(k)];
        all(k, i) = sums(0, i);
        first.row(k) = sums.block<3, 1>(1, i).transpose();
      }
      all.col(i).tail<3>() = find_moment(first);
    }
    return all;
  }

  // r x n of n r'
  [[nodiscard]] static Vector3 find_moment(const Matrix3& first) {
    return {first(2, 1) - first(1, 2), first(0, 2) - first(2, 0),
            first(1, 0) - first(0, 1)};
  }
};

/// SurfaceSums that keep their points, up to a number, for sums of them again.
class KeptSums {
 public:
  struct Point {
    Depth depth;
    Vector3 r = Vector3::Zero();
    double weight = 0.0;             // along its line
    Vector3 area = Vector3::Zero();  // that it stands for
  };
  struct Line {
    KeptSums& all;
    std::size_t first;  // point
    LineSums sums = {};

    void add(const Depth& depth, const Vector3& r, double weight) {
      sums.add(depth, r, weight);
      all.keep({.depth = depth, .r = r, .weight = weight});
    }
  };

  [[nodiscard]] Line begin_line() { return {*this, points_.all().size()}; }
  void add(const Line& line, const Vector3& area) {
    sums_.add(line.sums, area);
    for (Point& point : points_.all().subspan(line.first)) {
      point.area = point.weight * area;
    }
  }

  [[nodiscard]] const SurfaceSums& sums() const { return sums_; }
  [[nodiscard]] bool has_all_points() const { return has_all_; }
  [[nodiscard]] std::span<const Point> points() const { return points_.all(); }

 private:
  static constexpr std::size_t kMost = 2048;

  void keep(const Point& point) {
    has_all_ = has_all_ && points_.all().size() < kMost;
    if (has_all_) points_.add() = point;
  }

  SurfaceSums sums_;
  bool has_all_ = true;
  StackArray<Point, kMost> points_;
};

/// int 24 t (a . p) g g' dS, with the area along n.
class BendSums {
 public:
  BendSums(const Weights10& a, const Vector3& n) : a_(a), n_(n) {}

  struct Line {
    Weights10 a;
    Matrix6 bend = Matrix6::Zero();

    void add(const Depth& depth, const Vector3& r, double weight) {
      const Vector6 g = find_rate(depth, r);
      const double by = 24.0 * weight * depth.t * a.dot(find_powers(r));
      bend += (by * g) * g.transpose();
    }
  };

  [[nodiscard]] Line begin_line() const { return {a_}; }
  void add(const Line& line, const Vector3& area) {
    bend_ += n_.dot(area) * line.bend;
  }
  void add(std::span<const KeptSums::Point> points) {
    Line all = begin_line();
    for (const KeptSums::Point& point : points) {
      all.add(point.depth, point.r, n_.dot(point.area));
    }
    bend_ += all.bend;
  }
  [[nodiscard]] const Matrix6& bend() const { return bend_; }

 private:
  Weights10 a_;
  Vector3 n_;
  Matrix6 bend_ = Matrix6::Zero();
};

}  // namespace limber::contact
