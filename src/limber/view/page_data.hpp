// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "limber/view/recording.hpp"

namespace limber::view {

/// The data of the page: zlib's compression of the length of a header (4 bytes,
/// little-endian), the header (JSON) and, from the next multiple of 8 on,
/// arrays. The header refers to an array by {"at", "count", "type"}; the first
/// bytes of all elements come first, then their second bytes, ..., which
/// compresses better.
///
/// Equation   x_B = origin + scale i, Phi_k = scale_k i_k, i 16-bit integers:
///            |error| <= sqrt(3) / 2 (scale + sum_k scale_k |eta_k|), which the
///            header states of each body as `error` [m]
///
/// `most` and `box` of a result are its Extremes. Places of bodies `p` are
/// those of the world in double precision; touches and the box count from the
/// Home: `offset` and, if it `travels`, the mean of all `p`.
/// @param recordings the first is shown, others are its ghosts
[[nodiscard]] std::string make_page_data(std::span<const Recording> recordings);

/// The same, not compressed.
[[nodiscard]] std::string pack_page_data(std::span<const Recording> recordings);

}  // namespace limber::view
