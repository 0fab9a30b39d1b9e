// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/records/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace limber {

struct Digest::State {
  State() { XXH3_128bits_reset(hash.get()); }
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash{
      XXH3_createState(), XXH3_freeState};
};

Digest::Digest() : state_(std::make_unique<State>()) {}
Digest::Digest(const Digest& other) : Digest() {
  XXH3_copyState(state_->hash.get(), other.state_->hash.get());
}
Digest::Digest(Digest&& other) noexcept = default;
Digest& Digest::operator=(Digest&& other) noexcept = default;
Digest::~Digest() = default;

void Digest::add_bytes(const void* data, std::size_t size) {
  XXH3_128bits_update(state_->hash.get(), data, size);
}

void Digest::add(const std::string& text) {
  add(text.size());
  add_bytes(text.data(), text.size());
}

void Digest::add(const Vector3& v) {
  for (const double x : v) add(x);
}

void Digest::add(const MatrixX& values) {
  add(values.rows());
  add(values.cols());
  add_bytes(values.data(),
            sizeof(double) * static_cast<std::size_t>(values.size()));
}

void Digest::add(const std::vector<double>& values) {
  add(values.size());
  for (const double x : values) add(x);
}

std::string Digest::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->hash.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace limber
