// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <utility>
#include <vector>

#include "limber/common/files/spilled_numbers.hpp"
#include "limber/common/records/archive.hpp"

namespace limber {

/// A list of values that an Archive can hold, of which all but the last block
/// are in a temporary file (SpilledNumbers). Elements are copies: they are
/// appended once, and read in any order.
template <typename T>
class SpilledList {
 public:
  class Iterator;
  using value_type = T;
  using size_type = std::size_t;
  using const_iterator = Iterator;

  SpilledList() = default;
  SpilledList(std::initializer_list<T> values) {
    for (const T& value : values) push_back(value);
  }
  SpilledList(const std::vector<T>& values) {
    for (const T& value : values) push_back(value);
  }

  void push_back(T value) {
    Archive archive = Archive::write_into(std::move(row_));
    archive(value);
    row_ = archive.take_numbers();
    rows_.append(row_);
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  /// @throws as SpilledNumbers::read
  [[nodiscard]] T operator[](std::size_t i) const {
    Archive archive(rows_.read(i));
    T value;
    archive(value);
    return value;
  }
  [[nodiscard]] T front() const { return (*this)[0]; }
  [[nodiscard]] T back() const { return (*this)[size() - 1]; }
  /// `count` elements from `first` on.
  [[nodiscard]] std::vector<T> read(std::size_t first,
                                    std::size_t count) const {
    std::vector<T> part;
    part.reserve(count);
    for (std::size_t i = 0; i < count; ++i) part.push_back((*this)[first + i]);
    return part;
  }

  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

  /// Bytes of elements in memory.
  [[nodiscard]] std::size_t held_bytes() const { return rows_.held_bytes(); }

  /// Reads one element at a time.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = T;

    Iterator(const SpilledList& list, std::size_t at) : list_(&list), at_(at) {}

    [[nodiscard]] T operator*() const { return (*list_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++at_;
      return before;
    }
    [[nodiscard]] bool operator==(const Iterator&) const = default;

   private:
    const SpilledList* list_;
    std::size_t at_;
  };

 private:
  SpilledNumbers rows_;
  std::vector<double> row_;  // memory for the next
};

template <typename T>
void exchange(Archive& archive, SpilledList<T>& list) {
  std::size_t size = list.size();
  archive.pass_size(size);
  if (archive.reads()) list = SpilledList<T>();
  for (std::size_t i = 0; i < size; ++i) {
    if (archive.reads()) {
      T value;
      archive(value);
      list.push_back(std::move(value));
    } else {
      T value = list[i];
      archive(value);
    }
  }
}

}  // namespace limber
