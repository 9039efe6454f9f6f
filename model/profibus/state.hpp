// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// The state of a chip as bytes, written and read again, also in another process. Each block lists its state in one
// function beside its members, for both directions:
//   template <class Archive>
//   void store(Archive& archive) {
//     auto& [window, bits, deadline, index, searching] = *this;
//     archive.given(window, bits);
//     archive.cycles(deadline);
//     archive(index, searching);
//   }
//
// The binding names all members: a new member does not compile until it is listed. Values are checked as they are read,
// so that damaged bytes cannot cause an access beyond an array or an endless loop. Numbers are little endian and as
// wide as their type.
#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/profibus/time.hpp"

namespace dsdpv1::profibus {

/// Common to both directions. `Way` has `number(T& value, T least, T most)` for each integer, `bytes` and `check`.
template <class Way>
class StateArchive {
  friend Way;
  StateArchive() = default;

 public:
  /// Booleans, integers of any value, blocks, and arrays of them.
  template <class... T>
  void operator()(T&... fields) {
    (field(fields), ...);
  }
  /// Integers and enumerators from `least` to `most`.
  template <class Least, class Most, class... T>
  void within(Least least, Most most, T&... fields) {
    (limited(least, most, fields), ...);
  }
  /// Cycles since the start of simulation, or kNever. As late as a tick can be, and early enough for events long ago.
  template <class... T>
  void cycles(T&... times) {
    (time(times, kLastTick / kTicksPerCycle), ...);
  }
  template <class... T>
  void ticks(T&... times) {
    (time(times, kLastTick), ...);
  }
  /// Lengths of time in cycles: up to 6 hours.
  template <class... T>
  void lengths(T&... times) {
    (limited(Cycle{0}, Cycle{1} << 40, times), ...);
  }
  /// A pointer to one of `from[0]` to `from[most]`, or null.
  template <class T>
  void place(const T*& pointer, const T* from, int most) {
    std::int32_t at = pointer == nullptr ? -1 : static_cast<std::int32_t>(pointer - from);
    limited(-1, most, at);
    if constexpr (Way::kReads) pointer = at < 0 ? nullptr : from + at;
  }
  template <std::size_t N>
  void bits(std::bitset<N>& set) {
    for (std::size_t first = 0; first < N; first += 8) {
      std::uint8_t byte = 0;
      for (std::size_t i = 0; i < 8; ++i) byte = static_cast<std::uint8_t>(byte | unsigned{set.test(first + i)} << i);
      field(byte);
      for (std::size_t i = 0; i < 8; ++i) set.set(first + i, (byte >> i & 1U) != 0);
    }
  }
  /// Given at construction, or derived from other members: not part of the state.
  template <class... T>
  void given(const T&... /*fields*/) {}
  /// Written before it is read, so not part of the state.
  template <class... T>
  void scratch(const T&... /*fields*/) {}

 private:
  // DPSIM_LAST_TICK of the C API and a margin: planned events may lie after it.
  static constexpr Tick kLastTick = (Tick{1} << 62) + (Tick{1} << 48), kFirst = -(Tick{1} << 32);

  Way& way() { return static_cast<Way&>(*this); }

  template <class T>
  void field(T& value) {
    if constexpr (std::is_same_v<T, bool>)
      limited(0, 1, value);
    else if constexpr (std::is_integral_v<T>)
      way().number(value, std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
    else
      block(value);
  }
  template <class T>
  void block(T& value) {
    value.store(way());
  }
  template <class T, std::size_t N>
  void block(std::array<T, N>& values) {
    if constexpr (std::is_same_v<T, std::uint8_t>)
      way().bytes(values.data(), N);
    else
      for (T& each : values) field(each);
  }
  template <class Least, class Most, class T>
  void limited(Least least, Most most, T& value) {
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
      auto number = static_cast<std::uint8_t>(value);
      way().number(number, static_cast<std::uint8_t>(least), static_cast<std::uint8_t>(most));
      value = static_cast<T>(number);
    } else {
      way().number(value, static_cast<T>(least), static_cast<T>(most));
    }
  }
  void time(Tick& value, Tick highest) {
    bool never = value == kNever;
    field(never);
    Tick finite = never ? 0 : value;
    limited(kFirst, highest, finite);
    value = never ? kNever : finite;
  }
};

class StateWriter : public StateArchive<StateWriter> {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void number(const T& value, T /*least*/, T /*most*/) {
    const auto bits = static_cast<std::make_unsigned_t<T>>(value);
    for (unsigned i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  void bytes(const std::uint8_t* values, std::size_t count) { bytes_.insert(bytes_.end(), values, values + count); }
  void check(bool /*possible*/) {}

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

class StateReader : public StateArchive<StateReader> {
 public:
  static constexpr bool kReads = true;

  StateReader(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), size_(size) {}

  /// A value outside `least` to `most` is not assigned, and the state is wrong.
  template <class T>
  void number(T& value, T least, T most) {
    const T read = next<T>();
    check(read >= least && read <= most);
    if (read >= least && read <= most) value = read;
  }
  void bytes(std::uint8_t* values, std::size_t count) {
    check(size_ - at_ >= count);
    if (size_ - at_ < count) return;
    std::copy_n(bytes_ + at_, count, values);
    at_ += count;
  }
  /// Marks the state wrong unless `possible`, a consistency check of a block.
  void check(bool possible) {
    if (!possible && right_) wrong_at_ = at_;
    right_ = right_ && possible;
  }

  /// No fault so far; `wrong_at`: bytes read at the first fault.
  bool right() const { return right_; }
  std::size_t wrong_at() const { return wrong_at_; }
  bool at_end() const { return at_ == size_; }

 private:
  template <class T>
  T next() {
    if (size_ - at_ < sizeof(T)) {
      check(false);
      return T{};
    }
    std::make_unsigned_t<T> bits = 0;
    for (unsigned i = 0; i < sizeof(T); ++i)
      bits = static_cast<std::make_unsigned_t<T>>(bits | std::make_unsigned_t<T>{bytes_[at_++]} << (8 * i));
    return static_cast<T>(bits);
  }

  const std::uint8_t* bytes_;
  std::size_t size_, at_ = 0, wrong_at_ = 0;
  bool right_ = true;
};

}  // namespace dsdpv1::profibus
