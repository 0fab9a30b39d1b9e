// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/motion_error.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::results {
namespace {

using dynamics::BodyIndex;
using dynamics::BodyModel;
using dynamics::BodyState;
using dynamics::SystemState;

/// Positions are sums and differences of a few numbers of their scale.
constexpr double kRoundoff = 1e-13;
/// States per block, to bound the memory for the nodes of a large mesh.
constexpr std::size_t kBlock = 64;

/// Sums of squares over the points of one field, a column a time.
struct Field {
  VectorX difference;
  VectorX reference;
  double points = 0.0;
  double scale = 0.0;  ///< size of the subtracted terms [m]

  explicit Field(std::size_t times)
      : difference(VectorX::Zero(static_cast<Eigen::Index>(times))),
        reference(difference) {}

  void add(const Field& other) {
    difference += other.difference;
    reference += other.reference;
    points += other.points;
    scale = std::max(scale, other.scale);
  }

  [[nodiscard]] FieldError find_error() const {
    if (points == 0.0 || difference.size() == 0) return {};
    return {std::sqrt(difference.mean() / points),
            std::sqrt(difference.maxCoeff() / points),
            std::sqrt(reference.mean() / points), kRoundoff * scale};
  }
};

struct Fields {
  Field displacement;
  Field rigid;
  Field deformation;

  explicit Fields(std::size_t times)
      : displacement(times), rigid(times), deformation(times) {}

  void add(const Fields& other) {
    displacement.add(other.displacement);
    rigid.add(other.rigid);
    deformation.add(other.deformation);
  }

  [[nodiscard]] MotionError find_error() const {
    return {displacement.find_error(), rigid.find_error(),
            deformation.find_error()};
  }
};

/// Mean and covariance of a body's points, which determine the mean square of
/// any rigid displacement.
struct Cloud {
  Vector3 middle_B = Vector3::Zero();  ///< [m]
  Matrix3 spread_B = Matrix3::Zero();  ///< mean of y y', y relative to it [m^2]
};

Cloud find_cloud(const BodyModel& body) {
  Cloud cloud;
  if (body.reduced == nullptr) {
    // J = tr(S) I - S with S the second moment of the mass.
    cloud.spread_B =
        (0.5 * body.J0.trace() * Matrix3::Identity() - body.J0) / body.mass;
    return cloud;
  }
  const Matrix3X& x_B = body.reduced->rows.x_B;
  if (x_B.cols() == 0) return cloud;
  cloud.middle_B = x_B.rowwise().mean();
  const Matrix3X y_B = x_B.colwise() - cloud.middle_B;
  cloud.spread_B = y_B * y_B.transpose() / static_cast<double>(x_B.cols());
  return cloud;
}

/// Mean square of the points' distances between two poses of their body:
/// |p_A - p_B + (R_A - R_B) middle|^2 + tr((R_A - R_B) spread (R_A - R_B)').
double find_mean_square(const Cloud& cloud, const Pose& a, const Pose& b) {
  const Matrix3 R = a.R - b.R;
  const Vector3 p = a.p - b.p + R * cloud.middle_B;
  return p.squaredNorm() + (R * cloud.spread_B * R.transpose()).trace();
}

Pose find_pose(const SystemState& state, BodyIndex body) {
  const BodyState& now = state.bodies[static_cast<std::size_t>(body)];
  return {now.quat_WB.toRotationMatrix(), now.p_WB};
}

/// The fields of one body.
class Comparer {
 public:
  Comparer(const Motion& motion, const Motion& reference, BodyIndex body)
      : motion_(motion),
        reference_(reference),
        body_(body),
        start_(find_pose(reference.states.front(), body)),
        fields_(reference.states.size()) {}

  Fields run() {
    compare_frames();
    const BodyModel& body = model_body();
    if (body.reduced != nullptr) compare_nodes(body);
    return fields_;
  }

 private:
  [[nodiscard]] const BodyModel& model_body() const {
    return reference_.model.bodies[static_cast<std::size_t>(body_)];
  }

  void compare_frames() {
    const BodyModel& body = model_body();
    fields_.rigid.scale = start_.p.norm();
    if (body.clamped) return;  // it cannot move
    const Cloud cloud = find_cloud(body);
    Field& rigid = fields_.rigid;
    rigid.points = 1.0;
    for (Eigen::Index j = 0; j < rigid.reference.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Pose now = find_pose(reference_.states[at], body_);
      rigid.reference[j] = find_mean_square(cloud, now, start_);
      rigid.difference[j] =
          find_mean_square(cloud, find_pose(motion_.states[at], body_), now);
    }
    rigid.scale += std::sqrt(cloud.spread_B.trace()) +
                   std::sqrt(rigid.reference.maxCoeff());
  }

  void compare_nodes(const BodyModel& body) {
    const Eigen::Index nodes = body.reduced->rows.x_B.cols();
    const double size = body.reduced->size.norm() + fields_.rigid.scale;
    for (Field* field : {&fields_.displacement, &fields_.deformation}) {
      field->points = static_cast<double>(nodes);
      field->scale = size;
    }
    for (std::size_t first = 0; first < reference_.states.size();
         first += kBlock) {
      compare_block(first, std::min(kBlock, reference_.states.size() - first),
                    nodes);
    }
  }

  void compare_block(std::size_t first, std::size_t count, Eigen::Index nodes) {
    const auto columns = static_cast<Eigen::Index>(count);
    MatrixX u(3 * nodes, columns);
    MatrixX u_ref(3 * nodes, columns);
    const auto take = [&](Field& field) {
      const auto at = static_cast<Eigen::Index>(first);
      field.reference.segment(at, columns) = u_ref.colwise().squaredNorm();
      u -= u_ref;
      field.difference.segment(at, columns) = u.colwise().squaredNorm();
    };
    const auto part = [&](const Motion& motion) {
      return motion.states.subspan(first, count);
    };
    calc_node_displacements(motion_.model, body_, part(motion_), start_, u);
    calc_node_displacements(reference_.model, body_, part(reference_), start_,
                            u_ref);
    take(fields_.displacement);
    calc_node_deformations(motion_.model, body_, part(motion_), u);
    calc_node_deformations(reference_.model, body_, part(reference_), u_ref);
    take(fields_.deformation);
  }

  const Motion& motion_;
  const Motion& reference_;
  BodyIndex body_;
  Pose start_;
  Fields fields_;
};

constexpr double kSameTime = 1e-12;  // [-]

void check(const Motion& motion, const Motion& reference) {
  LIMBER_EXPECT(motion.model.bodies.size() == reference.model.bodies.size());
  LIMBER_EXPECT(motion.states.size() == reference.states.size());
  LIMBER_EXPECT(!reference.states.empty());
  for (std::size_t j = 0; j < reference.states.size(); ++j) {
    // An output may be moved by round-off onto a change of the step.
    LIMBER_EXPECT(std::abs(motion.states[j].t - reference.states[j].t) <=
                  kSameTime * std::abs(reference.states[j].t));
  }
  for (std::size_t b = 0; b < reference.model.bodies.size(); ++b) {
    const BodyModel& one = motion.model.bodies[b];
    const BodyModel& other = reference.model.bodies[b];
    LIMBER_EXPECT(one.name == other.name);
    LIMBER_EXPECT((one.reduced == nullptr) == (other.reduced == nullptr));
    if (one.reduced == nullptr) continue;
    LIMBER_EXPECT(one.reduced->rows.tags == other.reduced->rows.tags);
  }
}

}  // namespace

std::optional<double> FieldError::relative() const {
  if (!(reference > roundoff)) return std::nullopt;
  return rms / reference;
}

std::optional<double> FieldError::relative_max() const {
  if (!(reference > roundoff)) return std::nullopt;
  return max / reference;
}

SystemMotionError calc_motion_error(const Motion& motion,
                                    const Motion& reference) {
  check(motion, reference);
  SystemMotionError result;
  Fields all(reference.states.size());
  const auto& bodies = reference.model.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Fields fields =
        Comparer(motion, reference, static_cast<BodyIndex>(b)).run();
    result.bodies.push_back(
        {bodies[b].name, bodies[b].reduced != nullptr, fields.find_error()});
    all.add(fields);
  }
  result.error = all.find_error();
  return result;
}

}  // namespace limber::results
