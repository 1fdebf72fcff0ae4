// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ardrone_vslam {

/// A sequence in blocks of `kBlock` elements. Its copies share the blocks: one that is changed is
/// copied first. So a copy of a million landmarks takes the time of a few thousand pointers, and
/// another thread may read it while the original goes on. Growing moves nothing.
///
/// Copying marks the original's blocks, and so counts as a change of it for other threads.
template <class T, std::size_t kBlock>
class SharedBlocks {
 public:
  /// @cond  what the library's containers have as well
  class const_iterator;  // NOLINT(readability-identifier-naming)
  using value_type = T;
  using iterator = const_iterator;

  SharedBlocks() = default;
  SharedBlocks(std::initializer_list<T> values) { append(values); }
  /// @endcond
  /// Copies the elements. Not explicit, as one stands for the other.
  SharedBlocks(const std::vector<T>& values) { append(values); }
  /// Shares the elements.
  SharedBlocks(const SharedBlocks& other) : blocks_(shared(other)), size_(other.size_) {}
  /// @cond
  SharedBlocks(SharedBlocks&& other) noexcept
      : blocks_(std::move(other.blocks_)), size_(std::exchange(other.size_, 0)) {}
  SharedBlocks& operator=(SharedBlocks other) noexcept {
    blocks_.swap(other.blocks_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~SharedBlocks() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t index) const {
    assert(index < size_);
    return blocks_[index / kBlock].values[index % kBlock];
  }
  const T& at(std::size_t index) const {
    if (index >= size_) throw std::out_of_range("SharedBlocks::at");
    return (*this)[index];
  }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, size_}; }
  /// @endcond

  /// For a change. O(kBlock) the first time after a copy was made, then O(1).
  T& change(std::size_t index) {
    assert(index < size_);
    return own(index / kBlock)[index % kBlock];
  }
  /// Appends one. O(1), but for what change() says.
  void push_back(T value) {
    reserve(size_ + 1);
    own(size_ / kBlock)[size_ % kBlock] = std::move(value);
    ++size_;
  }
  /// Drops the last one. O(1)
  void pop_back() {
    --size_;
    Block& block = blocks_[size_ / kBlock];
    if (!block.is_shared) block.values[size_ % kBlock] = T();
  }
  /// Drops all, and the memory.
  void clear() { *this = SharedBlocks(); }
  /// Takes the memory for so many elements.
  void reserve(std::size_t count) {
    while (blocks_.size() * kBlock < count)
      blocks_.push_back({std::shared_ptr<T[]>(new T[kBlock]), false});
  }

 private:
  struct Block {
    std::shared_ptr<T[]> values;
    mutable bool is_shared;  // with another sequence, perhaps no longer
  };

  static const std::vector<Block>& shared(const SharedBlocks& other) {
    for (const Block& block : other.blocks_) block.is_shared = true;
    return other.blocks_;
  }

  template <class Values>
  void append(const Values& values) {
    reserve(values.size());
    for (const T& value : values) push_back(value);
  }

  T* own(std::size_t index) {
    Block& block = blocks_[index];
    if (block.is_shared) {
      const std::shared_ptr<T[]> copy(new T[kBlock]);
      std::copy_n(block.values.get(), kBlock, copy.get());
      block = {copy, false};
    }
    return block.values.get();
  }

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

/// @cond  random access; valid while the sequence is, also when it grows
template <class T, std::size_t kBlock>
class SharedBlocks<T, kBlock>::const_iterator {  // NOLINT(readability-identifier-naming)
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = T;
  using difference_type = std::ptrdiff_t;
  using pointer = const T*;
  using reference = const T&;

  const_iterator() = default;
  const_iterator(const SharedBlocks* all, std::size_t index) : all_(all), index_(index) {}

  reference operator*() const { return (*all_)[index_]; }
  pointer operator->() const { return &**this; }
  reference operator[](difference_type by) const { return *(*this + by); }
  const_iterator& operator+=(difference_type by) {
    index_ += static_cast<std::size_t>(by);
    return *this;
  }
  const_iterator& operator-=(difference_type by) { return *this += -by; }
  const_iterator& operator++() { return *this += 1; }
  const_iterator& operator--() { return *this -= 1; }
  const_iterator operator++(int) { return std::exchange(*this, *this + 1); }
  const_iterator operator--(int) { return std::exchange(*this, *this - 1); }
  friend const_iterator operator+(const_iterator it, difference_type by) { return it += by; }
  friend const_iterator operator+(difference_type by, const_iterator it) { return it += by; }
  friend const_iterator operator-(const_iterator it, difference_type by) { return it -= by; }
  friend difference_type operator-(const const_iterator& a, const const_iterator& b) {
    return static_cast<difference_type>(a.index_) - static_cast<difference_type>(b.index_);
  }
  friend bool operator==(const const_iterator& a, const const_iterator& b) {
    return a.index_ == b.index_;
  }
  friend bool operator!=(const const_iterator& a, const const_iterator& b) { return !(a == b); }
  friend bool operator<(const const_iterator& a, const const_iterator& b) {
    return a.index_ < b.index_;
  }
  friend bool operator>(const const_iterator& a, const const_iterator& b) { return b < a; }
  friend bool operator<=(const const_iterator& a, const const_iterator& b) { return !(b < a); }
  friend bool operator>=(const const_iterator& a, const const_iterator& b) { return !(a < b); }

 private:
  const SharedBlocks* all_ = nullptr;
  std::size_t index_ = 0;
};
/// @endcond

}  // namespace ardrone_vslam
