#pragma once
// Data_Exchange on the line as reported by the bus monitor, for a station whose PBRTS the board moves.
#include "bus/monitor/monitor.hpp"
#include "tests/kinds/dsdpv1/checks/board.hpp"

namespace dsdpv1::checks_test {

class Exchanges {
 public:
  Exchanges(Board& board, std::uint8_t station) : station_(station) { board.wait(100'000); }

  /// A Data_Exchange that ends now; returns its end.
  Tick request(Board& board) const {
    return request(board, bus::make_telegram(station_, 2, bus::fc::kRequest | bus::fc::kSrdHigh, {0x11}));
  }
  Tick request(Board& board, const bus::Telegram& telegram) const {
    bus::WireTelegram wire = wire_of(telegram);
    wire.start = board.now() - 10'000;
    wire.end = board.now();
    board.checks().telegram(board.now(), wire);
    return board.now();
  }
  Tick request_ending_at(Board& board, Tick end) const {
    board.wait(end - board.now());
    return request(board);
  }
  /// An answer of the station, framed by PBRTS, from which its address is learnt.
  void answered(Board& board) const { answered(board, bus::make_sc()); }
  void answered(Board& board, const bus::Telegram& answer) const {
    board.set(Pin::kPbrts, 1);
    board.wait(1000);
    bus::WireTelegram wire = wire_of(answer);
    wire.start = board.now();
    board.wait(11'000);
    wire.end = board.now();
    wire.tsdr = 11'000;
    wire.station = station_;
    board.wait(1000);
    board.set(Pin::kPbrts, 0);
    board.checks().telegram(board.now(), wire);
    board.wait(50'000);
  }
  /// A Data_Exchange with one output, answered with one input; returns its execution.
  Tick exchange(Board& board) const {
    constexpr Tick kBit = 1000;
    const Tick end = request(board);
    board.wait(kBit);
    answered(board, bus::make_telegram(2, station_, bus::fc::kDl, {0x22}));
    return end + kBit;
  }

 private:
  static bus::WireTelegram wire_of(const bus::Telegram& telegram) {
    bus::WireTelegram wire;
    wire.decoded.readable = true;
    wire.decoded.telegram = telegram;
    return wire;
  }
  std::uint8_t station_;
};

}  // namespace dsdpv1::checks_test
