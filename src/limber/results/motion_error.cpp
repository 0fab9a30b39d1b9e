// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/motion_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/piece_names.hpp"
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
struct NodalField {
  VectorX difference;
  VectorX reference;
  double points = 0.0;
  double scale = 0.0;  ///< size of the subtracted terms [m]

  explicit NodalField(std::size_t times)
      : difference(VectorX::Zero(static_cast<Eigen::Index>(times))),
        reference(difference) {}

  void add(const NodalField& other) {
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
  NodalField displacement;
  NodalField rigid;
  NodalField deformation;

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

void check_nodes(const BodyModel& one, const BodyModel& other) {
  LIMBER_EXPECT((one.reduced == nullptr) == (other.reduced == nullptr));
  if (one.reduced == nullptr) return;
  LIMBER_EXPECT(one.reduced->rows.tags == other.reduced->rows.tags);
}

/// The fields of one body.
class Comparer {
 public:
  Comparer(const Motion& motion, BodyIndex own, const Motion& reference,
           BodyIndex body)
      : motion_(motion),
        own_(own),
        reference_(reference),
        body_(body),
        start_(find_pose(reference.states.front(), body)),
        fields_(reference.states.size()) {
    check_nodes(motion.model.bodies[static_cast<std::size_t>(own)],
                model_body());
  }

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
    NodalField& rigid = fields_.rigid;
    rigid.points = 1.0;
    for (Eigen::Index j = 0; j < rigid.reference.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Pose now = find_pose(reference_.states[at], body_);
      rigid.reference[j] = find_mean_square(cloud, now, start_);
      rigid.difference[j] =
          find_mean_square(cloud, find_pose(motion_.states[at], own_), now);
    }
    rigid.scale += std::sqrt(cloud.spread_B.trace()) +
                   std::sqrt(rigid.reference.maxCoeff());
  }

  void compare_nodes(const BodyModel& body) {
    const Eigen::Index nodes = body.reduced->rows.x_B.cols();
    const double size = body.reduced->size.norm() + fields_.rigid.scale;
    for (NodalField* field : {&fields_.displacement, &fields_.deformation}) {
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
    const auto take = [&](NodalField& field) {
      const auto at = static_cast<Eigen::Index>(first);
      field.reference.segment(at, columns) = u_ref.colwise().squaredNorm();
      u -= u_ref;
      field.difference.segment(at, columns) = u.colwise().squaredNorm();
    };
    const std::vector<SystemState> own = motion_.states.read(first, count);
    const std::vector<SystemState> other = reference_.states.read(first, count);
    calc_node_displacements(motion_.model, own_, own, start_, u);
    calc_node_displacements(reference_.model, body_, other, start_, u_ref);
    take(fields_.displacement);
    calc_node_deformations(motion_.model, own_, own, u);
    calc_node_deformations(reference_.model, body_, other, u_ref);
    take(fields_.deformation);
  }

  const Motion& motion_;
  BodyIndex own_;
  const Motion& reference_;
  BodyIndex body_;
  Pose start_;
  Fields fields_;
};

/// A body of both, or a link that is whole in one and in pieces in the other.
struct Counterparts {
  std::string name;
  std::vector<BodyIndex> own;
  std::vector<BodyIndex> reference;

  [[nodiscard]] bool are_single() const {
    return own.size() == 1 && reference.size() == 1;
  }
};

/// The nodes of a link's bodies.
class LinkNodes {
 public:
  LinkNodes(const Motion& motion, const std::vector<BodyIndex>& bodies)
      : motion_(motion) {
    for (const BodyIndex body : bodies) {
      const auto& model = motion.model.bodies[static_cast<std::size_t>(body)];
      const flexbody::NodeRows& rows = model.reduced->rows;
      parts_.push_back(
          {body, 3 * rows.x_B.cols(), find_pose(motion.states.front(), body)});
      size_ = std::max(size_, model.reduced->size.norm());
      for (const auto tag : rows.tags) {
        first_row_.emplace(static_cast<std::int64_t>(tag), rows_);
        rows_ += 3;
      }
    }
  }

  /// First row of each node, by its tag.
  [[nodiscard]] const std::map<std::int64_t, Eigen::Index>& first_row() const {
    return first_row_;
  }
  /// Displacements in the world [m].
  [[nodiscard]] MatrixX find_displacements(std::size_t first,
                                           std::size_t count) const {
    MatrixX u(rows_, static_cast<Eigen::Index>(count));
    const std::vector<SystemState> states = motion_.states.read(first, count);
    Eigen::Index from = 0;
    for (const Part& part : parts_) {
      if (part.rows > 0) {
        calc_node_displacements(motion_.model, part.body, states, part.start,
                                u.middleRows(from, part.rows));
      }
      from += part.rows;
    }
    return u;
  }
  /// Size of the subtracted terms [m].
  [[nodiscard]] double scale() const {
    double scale = 0.0;
    for (const Part& part : parts_) {
      scale = std::max(scale, size_ + part.start.p.norm());
    }
    return scale;
  }

 private:
  struct Part {
    BodyIndex body;
    Eigen::Index rows;
    Pose start;
  };

  const Motion& motion_;
  std::vector<Part> parts_;
  std::map<std::int64_t, Eigen::Index> first_row_;
  Eigen::Index rows_ = 0;
  double size_ = 0.0;
};

/// Displacements of the nodes that both have: a link in pieces has no frame of
/// its own, by which its rigid motion and its deformation could be compared.
Fields compare_pieces(const Motion& motion, const Motion& reference,
                      const Counterparts& bodies) {
  const LinkNodes own(motion, bodies.own);
  const LinkNodes other(reference, bodies.reference);
  std::vector<Eigen::Index> own_rows;
  std::vector<Eigen::Index> other_rows;
  for (const auto& [tag, row] : other.first_row()) {
    const auto found = own.first_row().find(tag);
    if (found == own.first_row().end()) continue;
    for (int c = 0; c < 3; ++c) {
      own_rows.push_back(found->second + c);
      other_rows.push_back(row + c);
    }
  }
  Fields fields(reference.states.size());
  NodalField& field = fields.displacement;
  field.points = static_cast<double>(own_rows.size()) / 3.0;
  field.scale = other.scale();
  for (std::size_t first = 0; first < reference.states.size();
       first += kBlock) {
    const std::size_t count = std::min(kBlock, reference.states.size() - first);
    const MatrixX u =
        own.find_displacements(first, count)(own_rows, Eigen::all);
    const MatrixX u_ref =
        other.find_displacements(first, count)(other_rows, Eigen::all);
    const auto at = static_cast<Eigen::Index>(first);
    const auto columns = static_cast<Eigen::Index>(count);
    field.reference.segment(at, columns) = u_ref.colwise().squaredNorm();
    field.difference.segment(at, columns) = (u - u_ref).colwise().squaredNorm();
  }
  return fields;
}

std::vector<BodyIndex> find_body(const dynamics::SystemModel& model,
                                 const std::string& name) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].name == name) return {static_cast<BodyIndex>(b)};
  }
  return {};
}

/// The bodies LINK.1, LINK.2, ... of a link in pieces.
std::vector<BodyIndex> find_pieces(const dynamics::SystemModel& model,
                                   const std::string& link) {
  std::vector<BodyIndex> pieces;
  for (;;) {
    const auto next =
        find_body(model, name_piece(link, static_cast<int>(pieces.size())));
    if (next.empty()) return pieces;
    pieces.push_back(next.front());
  }
}

std::vector<Counterparts> list_counterparts(
    const dynamics::SystemModel& own, const dynamics::SystemModel& reference) {
  std::vector<Counterparts> all;
  std::size_t used = 0;
  for (std::size_t b = 0; b < reference.bodies.size(); ++b) {
    const std::string& name = reference.bodies[b].name;
    Counterparts one{name, find_body(own, name), {static_cast<BodyIndex>(b)}};
    if (one.own.empty()) one.own = find_pieces(own, name);
    if (one.own.empty()) {
      one.name = find_whole(name);
      one.own = find_body(own, one.name);
      one.reference = find_pieces(reference, one.name);
      LIMBER_EXPECT(!one.own.empty());
      if (one.reference.front() != static_cast<BodyIndex>(b)) continue;
    }
    used += one.own.size();
    all.push_back(std::move(one));
  }
  LIMBER_EXPECT(used == own.bodies.size());
  return all;
}

constexpr double kSameTime = 1e-12;  // [-]

void check(const Motion& motion, const Motion& reference) {
  LIMBER_EXPECT(motion.states.size() == reference.states.size());
  LIMBER_EXPECT(!reference.states.empty());
  for (std::size_t j = 0; j < reference.states.size(); ++j) {
    // An output may be moved by round-off onto a change of the step.
    LIMBER_EXPECT(std::abs(motion.states[j].t - reference.states[j].t) <=
                  kSameTime * std::abs(reference.states[j].t));
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
  for (const Counterparts& bodies :
       list_counterparts(motion.model, reference.model)) {
    const BodyModel& body =
        reference.model
            .bodies[static_cast<std::size_t>(bodies.reference.front())];
    if (!bodies.are_single()) {
      const Fields fields = compare_pieces(motion, reference, bodies);
      result.bodies.push_back({bodies.name, true, fields.find_error()});
      all.add(fields);
      continue;
    }
    const Fields fields = Comparer(motion, bodies.own.front(), reference,
                                   bodies.reference.front())
                              .run();
    result.bodies.push_back(
        {bodies.name, body.reduced != nullptr, fields.find_error()});
    all.add(fields);
  }
  result.error = all.find_error();
  return result;
}

}  // namespace limber::results
