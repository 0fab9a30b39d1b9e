// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/face_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber::contact {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Matrix4 = Eigen::Matrix4d;
using Vector4 = Eigen::Vector4d;
using Matrix32 = Eigen::Matrix<double, 3, 2>;
using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Vector2 = Eigen::Vector2d;

// A corner's weight up to which a place is on the opposite edge [-].
constexpr double kOnEdge = 1e-12;

Matrix32 find_tangents(const FacePatch& face, const FacePlace& at) {
  Matrix32 tangents;
  tangents << face.find_tangent_u(at), face.find_tangent_v(at);
  return tangents;
}

// way . second derivatives.
Matrix2 find_bend(const FacePatch& face, const Vector3& way) {
  Matrix2 bend;
  bend(0, 0) = way.dot(face.x_uu());
  bend(0, 1) = bend(1, 0) = way.dot(face.x_uv());
  bend(1, 1) = way.dot(face.x_vv());
  return bend;
}

FacePlace add(const FacePlace& at, const Vector2& step) {
  return {at.u + step.x(), at.v + step.y()};
}

// Returns a place that round-off has moved over an edge.
FacePlace clamp(FacePlace at) {
  at.u = std::clamp(at.u, 0.0, 1.0);
  at.v = std::clamp(at.v, 0.0, 1.0);
  const double over = at.u + at.v - 1.0;
  if (over > 0.0) {
    at.u -= 0.5 * over;
    at.v -= 0.5 * over;
    if (at.u < 0.0) at = {0.0, 1.0};
    if (at.v < 0.0) at = {1.0, 0.0};
  }
  return at;
}

// The fraction of a step that stays within the face.
double find_room(const FacePlace& at, const Vector2& step) {
  const auto weights = at.weights();
  const std::array<double, 3> rates = {-step.x() - step.y(), step.x(),
                                       step.y()};
  double room = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (rates[i] < 0.0) room = std::min(room, -weights[i] / rates[i]);
  }
  return std::max(room, 0.0);
}

// Columns: directions in (u, v) along which a place may move; zero for those
// that are held.
struct Ways {
  Matrix2 Z = Matrix2::Identity();
  [[nodiscard]] bool has(int i) const { return !Z.col(i).isZero(0.0); }
};

constexpr std::array<std::array<double, 2>, 3> kCornerPlaces = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};

// Corners whose weight is held at 0.
using Held = std::array<bool, 3>;

Ways find_ways(const Held& held) {
  std::array<std::size_t, 3> kept{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!held[i]) kept[count++] = i;
  }
  Ways ways;
  if (count == 3) return ways;
  ways.Z.setZero();
  if (count == 2) {
    for (int axis = 0; axis < 2; ++axis) {
      ways.Z(axis, 0) = kCornerPlaces[kept[1]][static_cast<std::size_t>(axis)] -
                        kCornerPlaces[kept[0]][static_cast<std::size_t>(axis)];
    }
  }
  return ways;
}

// The constraints of the edges and corners that a place is on.
Held find_held_by(const FacePlace& at) {
  const auto weights = at.weights();
  return {weights[0] <= kOnEdge, weights[1] <= kOnEdge, weights[2] <= kOnEdge};
}

// Of these only the constraints that a descent along this gradient would
// violate. @param gradient of the function to be minimised
Held find_held_by(const FacePlace& at, const Vector2& gradient) {
  const auto weights = at.weights();
  const std::array<double, 3> slopes = {0.0, gradient.x(), gradient.y()};
  double mean = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] > kOnEdge) mean += weights[i] * slopes[i];
  }
  Held held = find_held_by(at);
  for (std::size_t i = 0; i < 3; ++i) held[i] = held[i] && slopes[i] >= mean;
  return held;
}

// Holds constraints that a step violates at once. @returns whether any is.
bool hold(const FacePlace& at, const Vector2& step, Held& held) {
  const Held on = find_held_by(at);
  const std::array<double, 3> rates = {-step.x() - step.y(), step.x(),
                                       step.y()};
  bool is_new = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!on[i] || held[i] || !(rates[i] < 0.0)) continue;
    held[i] = is_new = true;
  }
  return is_new;
}

Matrix4 join(const Ways& A, const Ways& B) {
  Matrix4 Z = Matrix4::Zero();
  Z.topLeftCorner<2, 2>() = A.Z;
  Z.bottomRightCorner<2, 2>() = B.Z;
  return Z;
}

// Minimises |b + D n - a|^2 / 2 over both faces.
class OffsetDistance {
 public:
  OffsetDistance(const FacePatch& A, const FacePatch& B, const Vector3& offset)
      : A_(A), B_(B), offset_(offset) {}

  [[nodiscard]] Vector3 find_arm(const FacePlace& a, const FacePlace& b) const {
    return B_.find_point(b) + offset_ - A_.find_point(a);
  }

  void minimise(FacePlace& a, FacePlace& b) const {
    constexpr int kMostSteps = 25;
    constexpr double kSmallStep = 1e-7;
    for (int i = 0; i < kMostSteps; ++i) {
      if (improve(a, b) < kSmallStep) return;
    }
  }

 private:
  // @returns the length of the step.
  double improve(FacePlace& a, FacePlace& b) const {
    constexpr int kMostHalvings = 12;
    const Vector3 arm = find_arm(a, b);
    const Matrix32 J_A = find_tangents(A_, a);
    const Matrix32 J_B = find_tangents(B_, b);
    Vector4 gradient;
    gradient << -J_A.transpose() * arm, J_B.transpose() * arm;
    Held held_a = find_held_by(a, gradient.head<2>());
    Held held_b = find_held_by(b, gradient.tail<2>());
    Matrix4 flat;
    flat << J_A.transpose() * J_A, -J_A.transpose() * J_B,
        -J_B.transpose() * J_A, J_B.transpose() * J_B;
    Matrix4 H = flat;
    H.topLeftCorner<2, 2>() -= find_bend(A_, arm);
    H.bottomRightCorner<2, 2>() += find_bend(B_, arm);
    Vector4 step;
    bool is_blocked = true;
    while (is_blocked) {
      const Matrix4 Z = join(find_ways(held_a), find_ways(held_b));
      if (!solve(Z, H, gradient, 1e-9, step)) {
        solve(Z, flat, gradient, 1e-6, step);
      }
      const bool holds_a = hold(a, step.head<2>(), held_a);
      is_blocked = hold(b, step.tail<2>(), held_b) || holds_a;
    }
    double share =
        std::min(find_room(a, step.head<2>()), find_room(b, step.tail<2>()));
    const double before = arm.squaredNorm();
    for (int k = 0; k < kMostHalvings; ++k, share *= 0.5) {
      const FacePlace next_a = clamp(add(a, share * step.head<2>()));
      const FacePlace next_b = clamp(add(b, share * step.tail<2>()));
      if (find_arm(next_a, next_b).squaredNorm() > before * (1.0 + 1e-15)) {
        continue;
      }
      a = next_a;
      b = next_b;
      return share * step.norm();
    }
    return 0.0;
  }

  // Solves in the free directions. @returns whether H is positive definite.
  static bool solve(const Matrix4& Z, const Matrix4& H, const Vector4& gradient,
                    double ridge, Vector4& step) {
    Matrix4 reduced = Z.transpose() * H * Z;
    const double scale = H.diagonal().cwiseAbs().maxCoeff();
    for (int i = 0; i < 4; ++i) {
      if (Z.col(i).isZero(0.0)) reduced(i, i) = scale;
    }
    reduced.diagonal().array() += ridge * scale;
    const Eigen::LLT<Matrix4> factor(reduced);
    step = Z * factor.solve(-(Z.transpose() * gradient));
    return factor.info() == Eigen::Success && step.allFinite();
  }

  const FacePatch& A_;
  const FacePatch& B_;
  Vector3 offset_;
};

// Newton's method on places and normal, which stay on the edges and corners
// that they are on at the start.
class Stationary {
 public:
  enum class End { kWithin, kOutside, kFar, kSingular };

  Stationary(const FacePatch& A, const FacePatch& B, const Ways& ways_A,
             const Ways& ways_B)
      : A_(A), B_(B), ways_A_(ways_A), ways_B_(ways_B) {}

  // Ends if a place is outside of its face by more than the weight `far`.
  End solve(FacePairPlace& out, double far) const {
    constexpr int kMostSteps = 12;
    constexpr double kSmallStep = 1e-11;
    constexpr double kCloseStep = 1e-7;
    FacePlace a = out.on_A;
    FacePlace b = out.on_B;
    Vector3 n = out.normal;
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMostSteps; ++i) {
      const double step = improve(a, b, n);
      if (!std::isfinite(step)) return End::kSingular;
      if (find_outside(a) > far || find_outside(b) > far) return End::kFar;
      // Round-off prevents further progress.
      const bool stays = step < kCloseStep && step >= last;
      last = step;
      if (step > kSmallStep && !stays) continue;
      out = {.on_A = a, .on_B = b, .normal = n};
      return find_outside(a) > kOnEdge || find_outside(b) > kOnEdge
                 ? End::kOutside
                 : End::kWithin;
    }
    return End::kSingular;
  }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  static double find_outside(const FacePlace& at) {
    return std::max({-at.u, -at.v, at.u + at.v - 1.0});
  }

  // @returns the length of the step.
  double improve(FacePlace& a, FacePlace& b, Vector3& n) const {
    const Matrix32 T_A = find_tangents(A_, a);
    const Matrix32 T_B = find_tangents(B_, b);
    const double size = T_A.norm() + T_B.norm();
    const Vector3 arm = A_.find_point(a) - B_.find_point(b);
    const Matrix32 J_A = T_A * ways_A_.Z;
    const Matrix32 J_B = T_B * ways_B_.Z;
    Matrix23 T;  // rows: two directions across n
    T.row(0) = n.unitOrthogonal().transpose();
    T.row(1) = n.cross(Vector3(T.row(0).transpose())).transpose();
    const Matrix2 across_A = T * J_A;
    const Matrix2 across_B = T * J_B;
    Matrix6 M = Matrix6::Zero();
    M.block<2, 2>(0, 0) = ways_A_.Z.transpose() * find_bend(A_, n) * ways_A_.Z;
    M.block<2, 2>(2, 2) =
        -(ways_B_.Z.transpose() * find_bend(B_, n) * ways_B_.Z);
    M.block<2, 2>(0, 4) = across_A.transpose();
    M.block<2, 2>(2, 4) = -across_B.transpose();
    M.block<2, 2>(4, 0) = across_A;
    M.block<2, 2>(4, 2) = -across_B;
    M.block<2, 2>(4, 4) = -n.dot(arm) * Matrix2::Identity();
    Vector6 rest;
    rest << J_A.transpose() * n, -(J_B.transpose() * n), T * arm;
    for (int k = 0; k < 2; ++k) {
      if (!ways_A_.has(k)) M(k, k) = size;
      if (!ways_B_.has(k)) M(k + 2, k + 2) = size;
    }
    const Vector6 step = (M / size).partialPivLu().solve(-rest / size);
    a = add(a, ways_A_.Z * step.head<2>());
    b = add(b, ways_B_.Z * step.segment<2>(2));
    n = (n + T.transpose() * step.tail<2>()).normalized();
    return step.norm();
  }

  const FacePatch& A_;
  const FacePatch& B_;
  const Ways& ways_A_;
  const Ways& ways_B_;
};

// Whether the overlap has a maximum there, not a saddle: the least distance
// after B is moved off slightly.
bool is_largest(const FacePatch& A, const FacePatch& B, const FacePairPlace& at,
                double offset) {
  const Vector3 arm =
      B.find_point(at.on_B) + offset * at.normal - A.find_point(at.on_A);
  const Matrix32 J_A = find_tangents(A, at.on_A);
  const Matrix32 J_B = find_tangents(B, at.on_B);
  Matrix4 H;
  H << J_A.transpose() * J_A - find_bend(A, arm), -J_A.transpose() * J_B,
      -J_B.transpose() * J_A, J_B.transpose() * J_B + find_bend(B, arm);
  return H.llt().info() == Eigen::Success;
}

bool turn_to_each_other(const FacePatch& A, const FacePatch& B,
                        const FacePairPlace& at) {
  constexpr double kAway = 0.05;
  return A.find_normal(at.on_A).normalized().dot(at.normal) > kAway &&
         B.find_normal(at.on_B).normalized().dot(at.normal) < -kAway;
}

// Solves with the edges and corners that may hold either place.
std::optional<FacePairPlace> find_held(const FacePatch& A, const FacePatch& B,
                                       const Vector3& normal, double offset) {
  constexpr int kMostTurns = 8;
  constexpr double kSmallTurn = 1e-2;
  FacePairPlace out{.on_A = kFaceMiddle, .on_B = kFaceMiddle, .normal = normal};
  double turn = 1.0;
  for (int i = 0; i < kMostTurns && turn > kSmallTurn; ++i) {
    const OffsetDistance distance(A, B, offset * out.normal);
    distance.minimise(out.on_A, out.on_B);
    const Vector3 arm = distance.find_arm(out.on_A, out.on_B);
    const double length = arm.norm();
    if (!(length > 1e-3 * offset)) return std::nullopt;  // too deep
    turn = (out.normal - arm / length).norm();
    out.normal = arm / length;
  }
  const Ways ways_A = find_ways(find_held_by(out.on_A));
  const Ways ways_B = find_ways(find_held_by(out.on_B));
  FacePairPlace exact = out;
  const auto end = Stationary(A, B, ways_A, ways_B).solve(exact, 0.5);
  if (end == Stationary::End::kWithin) {
    exact.on_A = clamp(exact.on_A);
    exact.on_B = clamp(exact.on_B);
    return exact;
  }
  return turn > kSmallTurn ? std::nullopt : std::optional(out);
}

}  // namespace

std::optional<FacePairPlace> find_opposite(const FacePatch& A,
                                           const FacePatch& B,
                                           const Vector3& normal,
                                           double most_depth, bool is_inner) {
  constexpr double kOffset = 0.1;  // of an edge [-]
  constexpr double kFar = 0.5;     // weight
  using End = Stationary::End;
  const double edge = std::min(A.find_tangent_u(kFaceMiddle).norm(),
                               B.find_tangent_u(kFaceMiddle).norm());
  const double offset = kOffset * edge + 2.0 * most_depth;
  std::optional<FacePairPlace> out;
  bool must_hold = true;
  if (!A.is_straight() || !B.is_straight()) {
    const Ways free;
    FacePairPlace direct{
        .on_A = kFaceMiddle, .on_B = kFaceMiddle, .normal = normal};
    const End end = Stationary(A, B, free, free).solve(direct, kFar);
    if (is_inner && (end == End::kFar || end == End::kSingular)) {
      return std::nullopt;
    }
    if (end == End::kWithin && is_largest(A, B, direct, offset)) {
      out = direct;
      must_hold = false;
    }
  }
  if (must_hold) out = find_held(A, B, normal, offset);
  if (!out || !turn_to_each_other(A, B, *out)) return std::nullopt;
  out->depth =
      out->normal.dot(A.find_point(out->on_A) - B.find_point(out->on_B));
  return out;
}

std::optional<SegmentCrossing> find_crossing(const Vector3& a0,
                                             const Vector3& a1,
                                             const Vector3& b0,
                                             const Vector3& b1,
                                             const Vector3& normal) {
  constexpr double kParallel = 1e-6;
  const Vector3 a = a1 - a0;
  const Vector3 b = b1 - b0;
  const double area = normal.dot(a.cross(b));
  if (!(std::abs(area) > kParallel * a.norm() * b.norm())) return std::nullopt;
  const Vector3 arm = b0 - a0;
  const SegmentCrossing at{normal.dot(arm.cross(b)) / area,
                           normal.dot(arm.cross(a)) / area};
  if (at.s < 0.0 || at.s > 1.0 || at.t < 0.0 || at.t > 1.0) {
    return std::nullopt;
  }
  return at;
}

}  // namespace limber::contact
