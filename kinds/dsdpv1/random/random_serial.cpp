#include "kinds/dsdpv1/random/random_serial.hpp"

#include <algorithm>

#include "model/dpram/crc16.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kLastCell = 0x7FF;
constexpr std::size_t kMostData = 245;

std::uint8_t byte(int value) { return static_cast<std::uint8_t>(value); }

}  // namespace

/// Usually the addressed card and the fastest rate; MODE, ADR, UBR and UIV are stable before RESET rises (R11).
void RandomSerial::strap() {
  constexpr int kFastest = 7;
  adr_ = random_.one_in(20) ? random_.below(4) : random_.between(1, 2);
  ubr_ = random_.one_in(12) ? kFastest - 1 : kFastest;
  if (random_.one_in(20)) ubr_ = std::max(random_.below(kFastest), random_.below(kFastest));
  uiv_ = random_.below(8);
  straps();
  stimulus_.push_back({});
}

void RandomSerial::straps() {
  pin(Pin::kMode, mode_ == HostMode::kSpi ? 1 : 2, random_.below(500));
  pin(Pin::kAdr, adr_, 0);
  pin(Pin::kUbr, ubr_, 0);
  pin(Pin::kUiv, uiv_, 0);
}

std::uint8_t RandomSerial::card() { return byte(mishap(40) ? random_.below(4) : adr_); }

void RandomSerial::ask(int address, int count) {
  send({start(0), byte(address >> 8), byte(address), byte(count)}, count + 4);
}

void RandomSerial::write(int address, int value) { write_bytes(address, {byte(value)}); }

void RandomSerial::write_bytes(int address, const bus::Bytes& bytes) {
  bus::Bytes telegram = {start(1), byte(address >> 8), byte(address), byte(static_cast<int>(bytes.size()))};
  for (const std::uint8_t each : bytes) telegram.push_back(each);
  send(telegram, 4);
}

/// The block's CRC is checked only with `serial_block_crc` (SP15).
void RandomSerial::block(int address, int crc_address, const bus::Bytes& bytes) {
  if (bytes.size() <= kMostData && exchange(address, bytes)) return;
  for (std::size_t at = 0; at < bytes.size(); at += kMostData) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto count = std::min(kMostData, bytes.size() - at);
    write_bytes(address + static_cast<int>(at), {begin, begin + static_cast<std::ptrdiff_t>(count)});
  }
  if (!mishap(2)) return;
  const int crc = dpram::crc16(bytes.data(), static_cast<int>(bytes.size())) ^ (random_.one_in(8) ? 1 : 0);
  write_bytes(crc_address, {byte(crc >> 8), byte(crc)});
}

bus::Bytes RandomSerial::finished(bus::Bytes telegram) {
  const int crc = dpram::crc16(telegram.data(), static_cast<int>(telegram.size()));
  telegram.push_back(byte(crc >> 8));
  telegram.push_back(byte(crc));
  if (!mishap(12)) return telegram;
  const auto place = static_cast<std::size_t>(random_.below(static_cast<int>(telegram.size())));
  switch (random_.below(5)) {
    case 0: telegram[place] ^= byte(1 << random_.below(8)); break;
    case 1: telegram[place] = random_.byte(); break;
    case 2: telegram.resize(place); break;
    case 3: telegram.insert(telegram.begin() + static_cast<std::ptrdiff_t>(place), random_.byte()); break;
    default: telegram.push_back(random_.byte()); break;
  }
  return telegram;
}

/// Pins of all ports in any order.
void RandomSerial::rude() {
  constexpr Pin kPins[] = {Pin::kXss,  Pin::kSck, Pin::kSck, Pin::kMosi, Pin::kRxd, Pin::kMode, Pin::kAdr,
                           Pin::kRReq, Pin::kWr,  Pin::kRd,  Pin::kCsr,  Pin::kUbr, Pin::kUiv};
  for (int i = random_.between(2, 24); i > 0; --i) {
    const Pin which = random_.pick(kPins);
    const int most = which == Pin::kMode || which == Pin::kAdr ? 3 : 1;
    pin(which, random_.between(0, most), random_.between(130, random_.one_in(4) ? 20'000 : 900));
  }
  for (const Pin low : {Pin::kSck, Pin::kRReq}) pin(low, 0, 300);
  for (const Pin high : {Pin::kWr, Pin::kRd, Pin::kCsr, Pin::kXss, Pin::kRxd}) pin(high, 1, 300);
  straps();
  wait(random_.below(400));
}

bool RandomSerial::own_traffic() {
  if (random_.one_in(2)) return false;
  const int what = random_.below(14);
  if (what < 3)
    ask(random_.below(kLastCell + 1), is_long() ? random_.below(256) : random_.between(1, 12));
  else if (what < 5)
    wrong_telegram();
  else if (what < 6)
    write_bytes(random_.between(0, kLastCell), random_.bytes(is_long() ? random_.below(256) : random_.below(9)));
  else if (what < 7)
    write_bytes(0x0A, random_.bytes(random_.between(1, 20)));
  else
    own_telegram();
  return true;
}

void RandomSerial::break_rules() {
  for (int i = random_.between(1, 4); i > 0; --i) wrong_telegram();
}

/// Any bytes; addresses beyond the DPRAM and lengths beyond the limits with a right CRC, each of which has its own bit
/// in the error code.
void RandomSerial::wrong_telegram() {
  constexpr int kArea = 0x5D0;  // of an exchange
  if (random_.one_in(6)) return send(random_.bytes(random_.between(1, 12)), random_.below(8));
  const int beyond = random_.one_in(2) ? random_.below(0x10000) : random_.between(0x7F0, 0x810);
  const int address = random_.one_in(3) ? random_.below(0x700) : beyond;
  constexpr int kLong[] = {245, 246, 250, 251, 251, 255};
  const int count = random_.one_in(10) ? random_.pick(kLong) : random_.one_in(3) ? 0 : random_.between(1, 20);
  switch (random_.below(3)) {
    case 0: return ask(address, random_.one_in(3) ? random_.between(246, 255) : count);
    case 1: return write_bytes(address, random_.bytes(count));
    default: return third(random_.one_in(2) ? kArea : address, random_.bytes(count));
  }
}

}  // namespace dsdpv1::cosim
