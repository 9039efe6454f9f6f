#pragma once
// Data_Exchange on the line as reported by the bus monitor, for a station whose PBRTS the board moves.
#include "bus/monitor/monitor.hpp"
#include "tests/kinds/dsdpv1/checks/board.hpp"

namespace dsdpv1::checks_test {

class Exchanges {
 public:
  Exchanges(Board& board, std::uint8_t station) : station_(station) { board.wait(100'000); }

  /// A request that ends now; returns its end.
  Tick request(Board& board) const {
    bus::WireTelegram wire = wire_of(bus::make_telegram(station_, 2, bus::fc::kRequest | bus::fc::kSrdHigh, {0x11}));
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
  void answered(Board& board) const {
    board.set(Pin::kPbrts, 1);
    board.wait(1000);
    bus::WireTelegram wire = wire_of(bus::make_sc());
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
