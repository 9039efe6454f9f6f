#pragma once
// Converts between characters of PROFIBUS (start bit, eight data bits LSB first, even parity, stop bit) and edges of a
// line. Times are the chip's ticks (1/12 ns). Independent of SystemC.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/profibus/baud.hpp"
#include "model/profibus/character_run.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// One character on the line, in ticks.
struct LineCharacter {
  Tick start = 0;  ///< falling edge of the start bit
  Tick bit = 0;    ///< length of a bit
  std::uint8_t data = 0;
  bool parity_ok = true;  ///< even parity
  bool stop_ok = true;    ///< the stop bit is high
  Tick end() const { return start + profibus::kBitsPerCharacter * bit; }

  template <class Archive>
  void store(Archive& archive) {
    archive.ticks(start, bit);
    archive(data, parity_ok, stop_ok);
  }
};

/// The elements of a list in a module's state.
template <class Archive, class List>
void store_list(Archive& archive, List& list) {
  constexpr std::uint32_t kMost = 1U << 24;
  auto size = static_cast<std::uint32_t>(list.size());
  archive.within(0U, kMost, size);
  list.resize(size);
  for (auto& element : list) archive(element);
}

/// The eleven levels of a character, start bit in bit 0.
std::uint16_t frame_of(std::uint8_t data, bool parity_ok, bool stop_ok);

struct Edge {
  Tick at;
  bool level;

  template <class Archive>
  void store(Archive& archive) {
    archive.ticks(at);
    archive(level);
  }
};

/// Valid characters without a gap between them.
struct LineRun {
  Tick start = 0, bit = profibus::kTicksPerCycle;
  std::vector<std::uint8_t> bytes = {};

  Tick character(std::size_t index) const {
    return start + static_cast<Tick>(index) * profibus::kBitsPerCharacter * bit;
  }
  Tick end() const { return character(bytes.size()); }
  /// The run in the core's format; `bit` must be a whole number of cycles. Valid as long as the bytes are.
  profibus::CharacterRun told() const {
    return {start, bit / profibus::kTicksPerCycle, bytes.data(), static_cast<int>(bytes.size())};
  }

  template <class Archive>
  void store(Archive& archive) {
    archive.ticks(start, bit);
    store_list(archive, bytes);
  }
};

/// The changes of a line that carries characters, in order of time. The line idles high.
class EdgeQueue {
 public:
  /// Appends a change. Changes already planned for the same tick or later are dropped.
  void push(Edge edge);
  /// Inserts a change before or between the waiting ones.
  void insert(Edge edge);
  /// Tick of the earliest change, kNever without one.
  Tick next() const { return edges_.empty() ? profibus::kNever : edges_.front().at; }
  Edge take();

  template <class Archive>
  void store(Archive& archive) {
    store_list(archive, edges_);
  }

 private:
  std::deque<Edge> edges_;
};

/// Collects the characters of a transmitter with known bit time.
class CharacterCollector {
 public:
  /// The line is `level` from `at` on. `bit` (> 0) is the bit time to assume when this edge starts a character.
  void edge(Tick at, bool level, Tick bit);
  /// Tick at which the running character is complete, kNever while the line is idle.
  Tick next() const { return running_ ? character_.end() : profibus::kNever; }
  /// The character that is complete at `now`, once.
  std::optional<LineCharacter> take(Tick now);

  template <class Archive>
  void store(Archive& archive) {
    archive(character_, running_, level_, frame_);
    archive.within(0, profibus::kBitsPerCharacter, sampled_);
  }

 private:
  void sample_until(Tick now);
  Tick middle_of_next_bit() const;

  LineCharacter character_;
  bool running_ = false;
  bool level_ = true;
  int sampled_ = 0;          ///< bits sampled so far
  std::uint16_t frame_ = 0;  ///< as frame_of
};

}  // namespace dsdpv1::systemc
