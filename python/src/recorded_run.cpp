// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_run.hpp"

namespace limber::python {
namespace {

using Block = RecordedRun::Block;

/// Fills a block by `row(i)`, of `columns` numbers, unless it is there.
template <typename Row>
const Block& gather(Block& block, std::size_t outputs, Eigen::Index columns,
                    const Row& row) {
  const auto count = static_cast<Eigen::Index>(outputs);
  if (block.rows() == count && block.cols() == columns) return block;
  block.resize(count, columns);
  for (Eigen::Index i = 0; i < count; ++i) {
    block.row(i) = row(static_cast<std::size_t>(i));
  }
  return block;
}

}  // namespace

const Block& RecordedRun::probes() {
  const auto& history = run.history;
  const auto columns = static_cast<Eigen::Index>(history.columns.size());
  return gather(probes_, history.probe_rows.size(), columns,
                [&](std::size_t i) -> Eigen::RowVectorXd {
                  const std::vector<double> row = history.probe_rows[i];
                  return Eigen::Map<const Eigen::RowVectorXd>(row.data(),
                                                              columns);
                });
}

const Block& RecordedRun::motion() {
  const auto bodies = static_cast<Eigen::Index>(run.built.model.bodies.size());
  Eigen::RowVectorXd row(kBodyValues * bodies);
  return gather(motion_, run.history.states.size(), row.size(),
                [&](std::size_t i) -> const Eigen::RowVectorXd& {
                  Eigen::Index at = 0;
                  const dynamics::SystemState state = run.history.states[i];
                  for (const dynamics::BodyState& body : state.bodies) {
                    const Quaternion& quat = body.quat_WB;
                    row.segment<kBodyValues>(at) << body.p_WB.transpose(),
                        quat.w(), quat.x(), quat.y(), quat.z(),
                        body.v_WB_W.transpose(), body.w_WB_B.transpose();
                    at += kBodyValues;
                  }
                  return row;
                });
}

const Block& RecordedRun::eta() {
  return gather(
      eta_, run.history.states.size(), run.built.model.modal_count,
      [&](std::size_t i) -> VectorX { return run.history.states[i].eta; });
}

const Block& RecordedRun::etadot() {
  return gather(
      etadot_, run.history.states.size(), run.built.model.modal_count,
      [&](std::size_t i) -> VectorX { return run.history.states[i].etadot; });
}

const std::vector<dynamics::EnergyBalance>& RecordedRun::energies() {
  const auto& recorded = run.history.energies;
  if (energies_.size() != recorded.size()) {
    energies_ = recorded.read(0, recorded.size());
  }
  return energies_;
}

}  // namespace limber::python
