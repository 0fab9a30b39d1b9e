// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/typed_index.hpp"

/// Indices into the lists of a SystemModel.
namespace limber::dynamics {

using BodyIndex = TypedIndex<struct BodyTag>;
using AttachmentIndex = TypedIndex<struct AttachmentTag>;
using CouplerIndex = TypedIndex<struct CouplerTag>;
using TransmissionIndex = TypedIndex<struct TransmissionTag>;
using LoadIndex = TypedIndex<struct LoadTag>;
using PairIndex = TypedIndex<struct PairTag>;
using InputIndex = TypedIndex<struct InputTag>;
using ControllerIndex = TypedIndex<struct ControllerTag>;

/// Instead of a body: the world.
inline constexpr BodyIndex kWorld = BodyIndex(-1);

}  // namespace limber::dynamics
