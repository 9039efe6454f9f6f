#include "kinds/dsdpv1/pins/inside_watch.hpp"

#include <tuple>

#include "bus/baud.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::array<regs::Address, 4> kFlags = {regs::kChipCommand1, regs::kChipCommand2, regs::kUserCommand1,
                                                 regs::kUserCommand2};

/// 5.1: the owner of the DPRAM.
const char* owner(bool chip, bool user) {
  if (chip) return user ? "both" : "chip";
  return user ? "user" : "-";
}

const char* move(const dpram::Inside& access) {
  if (!access.moves) return "-";
  return access.writes ? "write" : "read";
}

std::string crc(const dpram::Inside& access) {
  const std::string of = access.crc_of;
  return of == "-" ? of : of + (access.crc_right ? " right" : " wrong");
}

std::string baud(const dsdpv1::Inside& inside, bool offline) {
  if (offline) return "-";
  const std::string tried(bus::baud(inside.tried.code()).name);
  return inside.watchdog == profibus::Watchdog::State::kBaudSearch ? "search " + tried : tried;
}

const char* watchdog(profibus::Watchdog::State state) {
  switch (state) {
    case profibus::Watchdog::State::kBaudSearch: return "BAUD_SEARCH";
    case profibus::Watchdog::State::kBaudControl: return "BAUD_CONTROL";
    case profibus::Watchdog::State::kDpControl: return "DP_CONTROL";
  }
  return "?";
}

bool same(const dpram::Inside& a, const dpram::Inside& b) {
  const auto all = [](const dpram::Inside& each) {
    return std::tie(each.item, each.moves, each.address, each.byte, each.writes, each.crc_of, each.crc_right);
  };
  return all(a) == all(b);
}

}  // namespace

const std::vector<InnerSignal>& InsideWatch::signals() {
  static const std::vector<InnerSignal> signals = {{"owner", 0}, {"item", 0}, {"move", 0}, {"address", 11},
                                                   {"byte", 8},  {"B00E", 8}, {"B00F", 8}, {"B010", 8},
                                                   {"B011", 8},  {"crc", 0},  {"baud", 0}, {"watchdog", 0}};
  return signals;
}

InsideWatch::Seen InsideWatch::see(const dsdpv1::Chip& chip) {
  Seen seen{chip.inside(), chip.level(Pin::kLSta) == 1, chip.level(Pin::kRSta) == 1, chip.level(Pin::kReady) == 0, {}};
  for (std::size_t i = 0; i < kFlags.size(); ++i) seen.flags.at(i) = chip.peek(kFlags.at(i));
  return seen;
}

bool InsideWatch::same(const Seen& a, const Seen& b) {
  return a.chip_owns == b.chip_owns && a.user_owns == b.user_owns && a.offline == b.offline && a.flags == b.flags &&
         a.inside.tried.code() == b.inside.tried.code() && a.inside.watchdog == b.inside.watchdog &&
         tb::same(a.inside.access, b.inside.access);
}

/// In the order of signals().
std::vector<InsideWatch::Value> InsideWatch::values(const Seen& seen) {
  const dpram::Inside& access = seen.inside.access;
  const auto moved = [&](int value) { return Value{access.moves ? static_cast<Level>(value) : kLevelZ, {}}; };
  std::vector<Value> values = {{0, owner(seen.chip_owns, seen.user_owns)},
                               {0, access.item},
                               {0, move(access)},
                               moved(access.address),
                               moved(access.byte)};
  for (const std::uint8_t flag : seen.flags) values.push_back({flag, {}});
  values.push_back({0, crc(access)});
  values.push_back({0, baud(seen.inside, seen.offline)});
  values.push_back({0, watchdog(seen.inside.watchdog)});
  return values;
}

void InsideWatch::look(bus::Tick at, const dsdpv1::Chip& chip, std::size_t number, ChipListener& listener) {
  const Seen seen = see(chip);
  if (!told_.empty() && same(seen, last_)) return;
  last_ = seen;
  const std::vector<Value> now = values(seen);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (told_.empty() || now[i].level != told_[i].level || now[i].word != told_[i].word)
      listener.inside(number, at, i, now[i].level, now[i].word);
  told_ = now;
}

}  // namespace dsdpv1::tb
