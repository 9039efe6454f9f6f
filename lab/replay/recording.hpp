#pragma once
// A capture of the line, divided into the telegrams of one slave and those of all others.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/capture/captured_telegram.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::tb::replay {

using bus::Tick;

/// A telegram of the capture. Times are the capture's.
struct RecordedTelegram {
  Tick start = 0, end = 0;
  std::uint32_t damage = 0;  ///< bits of bus::capture::damage
  int baud = 0;              ///< index of bus/baud.hpp
  bus::Bytes bytes = {};     ///< all characters
  bus::Decoded decoded = {};
  bool of_slave = false;

  bool right() const {
    return decoded.error == bus::DecodeError::kNone && (damage & ~bus::capture::damage::kGap) == 0 &&
           decoded.bytes.size() == bytes.size();
  }
};

/// A change of the line, idle high.
struct LevelChange {
  Tick at;
  bool level;
};

/// A request to the slave that it has to answer; positions in Recording::telegrams.
struct RecordedRequest {
  std::size_t telegram = 0;
  std::optional<std::size_t> answer = {};
  bool searching = false;  ///< at a rate at which the slave has not answered since the change to it
  bool found = false;      ///< the first one after a change of the rate that the slave answers
};

struct Recording {
  std::string name;          ///< of the file, for messages
  std::uint8_t slave = 0;    ///< its address at the beginning of the capture
  int baud = 0;              ///< the first one, index of bus/baud.hpp
  Tick resolution = 1;       ///< of the times
  std::size_t left_out = 0;  ///< telegrams of other rates
  std::vector<RecordedTelegram> telegrams;
  std::vector<RecordedRequest> requests;
  std::vector<LevelChange> levels;  ///< empty: a capture of telegrams

  const RecordedTelegram& request(const RecordedRequest& request) const { return telegrams[request.telegram]; }
  /// Null if the slave was silent.
  const RecordedTelegram* answer(const RecordedRequest& request) const {
    return request.answer ? &telegrams[*request.answer] : nullptr;
  }
  /// Indices of bus/baud.hpp, in the order of time.
  std::vector<int> bauds() const;
  /// End of its content.
  Tick end() const { return telegrams.empty() ? 0 : telegrams.back().end; }
};

/// Takes the telegrams of a capture in the order of time.
class Recorder {
 public:
  /// `slave`: the station address, 0 to 126. `baud`: telegrams of other rates are left out.
  Recorder(std::string name, std::uint8_t slave, std::optional<int> baud);

  void telegram(const bus::capture::CapturedTelegram& telegram);
  void level(Tick at, bool level) { recording_.levels.push_back({at, level}); }
  /// Throws InputError when nothing can be replayed: no rate, no request to the slave, no answer.
  Recording finish();

 private:
  struct Pending {
    std::size_t request;  ///< position of its telegram
    std::uint8_t da;
    bool of_slave;  ///< it is in Recording::requests
  };
  void take(const bus::capture::CapturedTelegram& telegram, int baud);
  void divide();
  void divide(std::size_t index);
  void right(std::size_t index);
  void wrong(std::size_t index);
  void answered(std::size_t index);
  void follow_address(const RecordedTelegram& answer);
  void follow_rate();
  void check() const;
  /// Advice for a capture that cannot be used.
  std::string stations() const;

  Recording recording_;
  std::optional<int> baud_;  ///< chosen by the user
  std::uint8_t address_;     ///< of the slave, which Set_Slave_Address changes
  std::optional<Pending> pending_;
};

}  // namespace dsdpv1::tb::replay
