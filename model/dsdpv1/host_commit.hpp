#pragma once
// Executes a telegram of the host in the DPRAM (docs/microarchitecture_rsu.md 4.2): one byte a cycle, while no access
// of the chip runs. The sequencer begins none as long as busy().
#include "model/dpram/ram.hpp"
#include "model/dsdpv1/exchange.hpp"
#include "model/dsdpv1/host_telegram.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1 {

class HostCommit {
 public:
  HostCommit(profibus::EventLog& log, dpram::Ram& ram, bool cfg_length)
      : log_(log), ram_(ram), exchange_(ram, cfg_length) {}

  static constexpr int kNobody = -1, kMostMoves = 1024;

  void reset() { state_ = State::kIdle; }
  /// Call when the telegram is judged, at `now`; `data` must stay until the commit is done. For `write`, `owner` is the
  /// cell that is not changed (B014 of SPI), or none.
  void write(Cycle now, const Request& request, const std::uint8_t* data, int owner);
  void read(Cycle now, const Request& request);
  void read_and_write(Cycle now, const Request& request, const std::uint8_t* data);
  void exchange(Cycle now, const Request& request, const std::uint8_t* data);

  /// The edge of `now`; `owns`, `data_exch` as before it. Returns true with the last move.
  bool eval(Cycle now, bool owns, bool data_exch);
  Cycle next() const { return state_ == State::kIdle ? profibus::kNever : next_; }

  bool busy() const { return state_ != State::kIdle; }
  bool waits() const { return state_ == State::kWaits; }  ///< for an access of the chip to end
  /// The data of the last read, the answer of the last exchange.
  const std::uint8_t* data() const { return read_.data(); }
  const Exchange& answer() const { return exchange_; }
  /// The present work belongs to `request`.
  bool is_of(const Request& request) const;

  /// `data`: of the telegram being executed.
  template <class Archive>
  void store(Archive& archive, const std::uint8_t* data) {
    auto& [log, ram, exchange, state, kind, next, index, base, length, owner, from, user_command, chip_command, read] =
        *this;
    archive.given(log, ram);
    exchange.store(archive, data);
    archive.within(State::kIdle, State::kMoves, state);
    archive.within(Kind::kWrite, Kind::kExchange, kind);
    archive.cycles(next);
    archive.within(0, kMostMoves, index, length);
    archive.within(kNobody, kHighestLevel, owner);
    archive(base, user_command, chip_command, read);
    if constexpr (Archive::kReads) from = data;
    archive.check(state == State::kIdle || is_possible());
  }

 private:
  enum class State : std::uint8_t { kIdle, kWaits, kMoves };
  enum class Kind : std::uint8_t { kWrite, kRead, kReadAndWrite, kExchange };
  void start(Cycle now, Kind kind, const Request& request, const std::uint8_t* data);
  bool move(int index, Cycle now, bool data_exch);
  void move_write(int index, Cycle now);
  bool move_read_and_write(int index, Cycle now);
  void put(regs::Address address, std::uint8_t byte, Cycle now);
  bool is_possible() const;

  profibus::EventLog& log_;
  dpram::Ram& ram_;
  Exchange exchange_;
  State state_ = State::kIdle;
  Kind kind_ = Kind::kWrite;
  Cycle next_ = 0;
  int index_ = 0;  // moves made
  regs::Address base_ = 0;
  int length_ = 0, owner_ = kNobody;
  const std::uint8_t* data_ = nullptr;
  std::uint8_t user_command_ = 0, chip_command_ = 0;  // B010, B00E
  std::array<std::uint8_t, kMostRead> read_{};
};

}  // namespace dsdpv1
