#pragma once
// The wires of a chip that a capture shows: any subset of its kind's table, each with its edges.
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "bus/capture/level_taker.hpp"
#include "bus/time.hpp"

namespace dsdpv1::calibrate {

using bus::Tick;

/// Its place in the WireTable.
enum class Wire : std::uint8_t {};

struct WireInfo {
  std::string name;  ///< the datasheet's: "PBTXD", "A10"
  std::string bus;   ///< the bus that it is a wire of: "A"
  std::size_t bit = 0;
  const char* group = nullptr;  ///< name of an incomplete group in messages: "pins of the host port"
};
using WireTable = std::vector<WireInfo>;

/// The wires of a group.
std::vector<Wire> wires_of(const WireTable& table, const std::string& group);

/// The recording of one wire.
struct Trace {
  bool seen = false;
  bool first = false;       ///< level at the beginning
  std::vector<Tick> edges;  ///< first sample of each new level, in order

  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// The level after edge `edge` - 1.
  bool level(std::size_t edge) const { return first != (edge % 2 == 1); }
  /// The number of edges up to and including `at`.
  std::size_t count_until(Tick at) const;
  bool at(Tick at) const { return level(count_until(at)); }
  /// True when it was low from `from` to `to`; false when unknown.
  bool low(Tick from, Tick to) const;
  bool high(Tick from, Tick to) const;
  /// The index of the first edge to `level` at or after `from`; kNone when none exists.
  std::size_t next(Tick from, bool level) const;
  /// The last edge to `level` at or before `until`.
  std::size_t last(Tick until, bool level) const;
};

/// The wires in a capture.
struct Record {
  /// `table` must outlive it.
  explicit Record(const WireTable& all) : table(all), traces(all.size()), names(all.size()) {}

  const WireTable& table;
  std::vector<Trace> traces;
  std::vector<std::string> names;  ///< in the capture
  Tick end = 0;

  const Trace& operator[](Wire wire) const { return traces.at(static_cast<std::size_t>(wire)); }
  bool sees(Wire wire) const { return (*this)[wire].seen; }
  bool sees(const std::vector<Wire>& wires) const;
  /// The value of a bus, whose wires follow `first`.
  std::uint32_t number(Wire first, std::size_t count, Tick at) const;
};

/// The names of a capture's signals.
struct Names {
  std::string scope;  ///< only signals in it; empty: any
  struct Given {
    std::string signal;
    bool inverted = false;
  };
  std::map<std::string, Given> given;  ///< by the wire's name, or the bus's
  bool only_given = false;
};

/// Takes from a recording the wires of the chip.
class RecordTaker : public bus::capture::LevelTaker {
 public:
  /// `table` must outlive the record.
  RecordTaker(const WireTable& table, Names names)
      : table_(table), names_(std::move(names)), record_(table), begun_(table.size()) {}

  /// Throws CaptureError when the capture has no pin of the chip, has one twice, or lacks a given one.
  std::vector<std::size_t> choose(const std::vector<std::string>& signals) override;
  void level(Tick at, std::size_t which, bool level) override;
  void finish(Tick end) override { record_.end = end; }

  Record& record() { return record_; }

  /// More changes than this are refused: a capture is held in memory.
  static constexpr std::size_t kMostChanges = 100'000'000;

 private:
  struct Chosen {
    Wire wire;
    bool inverted;
  };
  void look_for(Wire wire, const std::vector<std::string>& signals);
  std::size_t given_place(const WireInfo& wire, const Names::Given& given, const std::string& suffix,
                          const std::vector<std::string>& signals) const;
  std::size_t named_place(const WireInfo& wire, const std::vector<std::string>& signals) const;
  void leave_out_lone_data();
  bool shows_nothing() const;

  const WireTable& table_;
  Names names_;
  Record record_;
  std::vector<std::size_t> places_;
  std::vector<Chosen> chosen_;
  std::vector<bool> begun_;
  std::size_t changes_ = 0;
};

}  // namespace dsdpv1::calibrate
