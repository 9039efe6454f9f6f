#include "cosim/random/random_master.hpp"

#include <algorithm>
#include <numeric>

namespace dsdpv1::cosim {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr int kNoSap = -1;
constexpr std::uint8_t kFailSafe = 0x08, kFailSafeReq = 0x40;  // for Setup::command; byte 7 of Set_Prm
constexpr int kReplyBits = 270;                                // longer than any min_TSDR
constexpr Tick kToInitialisation = 24;  // cycles from the release to the search, without the bytes of Cfg_Data

Tick window(const SearchTimes& times, int rate) {
  return std::max(times.window, times.window_bits * bus::baud(rate).bit);
}

}  // namespace

Tick RandomMaster::bit() const { return bus::baud(setup_.rate).bit; }

void RandomMaster::choose_rate() {
  setup_.rate = random_.one_in(8) ? random_.between(1, 2) : 0;
  be_found();
}

/// Rates that choose_rate() rarely uses, because one telegram lasts as long as a whole case at 12 Mbit/s.
void RandomMaster::slow_rate() {
  constexpr int kRates[] = {3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 9};
  setup_.rate = random_.pick(kRates);
  be_found();
}

void RandomMaster::fastest_rate() {
  setup_.rate = 0;
  be_found();
}

void RandomMaster::rate_of_500k() {
  setup_.rate = 4;
  be_found();
}

void RandomMaster::rate_after_a_window() {
  constexpr int kTelegramBits = 6 * bus::kCharacterBits + 1, kRate = 6;
  Tick ends = 0;
  for (int rate = 0; rate <= kRate; ++rate) ends += window(times_, rate);
  setup_.rate = kRate;
  const Tick bits = kTelegramBits * bit();
  const auto bytes = static_cast<Tick>(setup_.cfg.size());
  const Tick late = (kToInitialisation + bytes) * kCycle + random_.between(2, 5) * kCycle;
  send(bus::encode(bus::make_telegram(setup_.address, 2, 0x49)), ends - bits + late, false);
  setup_.rate = kRate + 1;
  send(bus::encode(bus::make_telegram(setup_.address, 2, 0x49)), idle() + 500 * kCycle, false);
}

/// Waits for the rate's window, then sends telegrams.
void RandomMaster::be_found() {
  Tick wait = 0;
  for (int rate = 0; rate < setup_.rate; ++rate) wait += window(times_, rate);
  extra_ += wait + 500 * kCycle;
  for (int i = random_.between(1, 2); i > 0; --i) {
    const auto to = random_.one_in(3) ? setup_.address : static_cast<std::uint8_t>(random_.between(6, 126));
    send(bus::make_telegram(to, 2, 0x49));
  }
}

void RandomMaster::slave_diag() { request(bus::sap::kSlaveDiag, {}); }

bus::Bytes RandomMaster::prm(bool right) {
  const int user = setup_.prm_mode == 1 ? setup_.max_prm : random_.below(std::min(setup_.max_prm, 5) + 1);
  bus::Bytes bytes = {
      static_cast<std::uint8_t>(0x80 | (random_.one_in(4) ? random_.byte() & 0x30 : (setup_.command & 0x06) << 3)),
      0,
      0,
      11,
      static_cast<std::uint8_t>(setup_.ident >> 8),
      static_cast<std::uint8_t>(setup_.ident & 0xFF),
      0};
  const bus::Bytes more = random_.bytes(user);
  bytes.insert(bytes.end(), more.begin(), more.end());
  if (bytes.size() > 7) bytes[7] = static_cast<std::uint8_t>(random_.below(4) << 1 & 0x04);
  setup_.fail_safe = bytes.size() > 7 && (setup_.command & kFailSafe) != 0 && random_.one_in(2);
  if (setup_.fail_safe) bytes[7] |= kFailSafeReq;
  if (setup_.dpv1) {
    bytes.resize(std::max<std::size_t>(bytes.size(), 10), 0);
    bytes[7] |= 0x80;
  }
  if (!setup_.dpv1 && random_.one_in(4)) {  // watchdog, 1 to 30 ms
    bytes[0] |= 0x08;
    bytes[1] = static_cast<std::uint8_t>(random_.between(1, 3));
    bytes[2] = 1;
  }
  if (random_.one_in(3)) bytes[3] = random_.byte();
  if (random_.one_in(3)) bytes[6] = random_.byte();
  if (right) return bytes;
  if (random_.one_in(3)) bytes[0] = random_.byte();
  if (random_.one_in(4))
    bytes.resize(static_cast<std::size_t>(std::min(7 + setup_.max_prm + random_.between(-1, 2), 30)), 0);
  if (random_.one_in(6)) bytes[0] |= 0x08;  // possibly with factors of 0
  if (random_.one_in(5)) bytes[random_.one_in(2) ? 4 : 5] ^= static_cast<std::uint8_t>(1 << random_.below(8));
  if (random_.one_in(6)) bytes.resize(static_cast<std::size_t>(random_.below(14)));
  if (random_.one_in(4) && bytes.size() > 7) bytes[7] = random_.byte();
  if (random_.one_in(6) && bytes.size() > 2) bytes[1] = bytes[2] = static_cast<std::uint8_t>(random_.below(2));
  return bytes;
}

void RandomMaster::set_prm_with_watchdog(int factor_1, int factor_2) {
  bus::Bytes bytes = prm(true);
  bytes.resize(std::max<std::size_t>(bytes.size(), 8), 0);
  bytes[0] |= 0x08;
  bytes[1] = static_cast<std::uint8_t>(factor_1);
  bytes[2] = static_cast<std::uint8_t>(factor_2);
  bytes[7] = static_cast<std::uint8_t>((setup_.dpv1 ? 0x80 : 0) | 0x04);
  request(bus::sap::kSetPrm, bytes);
}

void RandomMaster::set_prm_with_tsdr(int bits) {
  bus::Bytes bytes = prm(true);
  bytes[3] = static_cast<std::uint8_t>(bits);
  request(bus::sap::kSetPrm, bytes);
}

void RandomMaster::set_prm_of_groups(int groups) {
  constexpr std::uint8_t kSyncReq = 0x20, kFreezeReq = 0x10;
  bus::Bytes bytes = prm(true);
  bytes[0] |= kSyncReq | kFreezeReq;
  bytes[6] = static_cast<std::uint8_t>(groups);
  request(bus::sap::kSetPrm, bytes);
}

void RandomMaster::command(int command, int groups) {
  send(bus::make_telegram(bus::kBroadcast, 2, bus::fc::kRequest | bus::fc::kSdnHigh,
                          {static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(groups)},
                          bus::sap::kGlobalControl, bus::sap::kMaster),
       false);
}

void RandomMaster::other_fcb_same_fcs() {
  constexpr std::uint8_t kSrd = bus::fc::kRequest | bus::fc::kSrdHigh, kFcb = bus::fc::kFcb, kFcv = bus::fc::kFcv;
  bus::Bytes data = random_.bytes(setup_.outputs);
  for (const std::uint8_t bits : {kFcb, kFcv, static_cast<std::uint8_t>(kFcv | kFcb)}) {
    send(bus::make_telegram(setup_.address, 2, static_cast<std::uint8_t>(kSrd | bits), data));
    data = random_.bytes(setup_.outputs - 1);
    const bus::Bytes& before = last_->data;  // the sum stays when FCB, which is 20, is set
    const int sum = std::accumulate(before.begin(), before.end(), -std::accumulate(data.begin(), data.end(), 0));
    data.push_back(static_cast<std::uint8_t>(sum - kFcb));
  }
}

void RandomMaster::in_a_series(int sap) {
  const auto fc = static_cast<std::uint8_t>(bus::fc::kRequest | bus::fc::kSrdHigh | bus::fc::kFcb);
  send(bus::make_telegram(setup_.address, 2, fc, random_.bytes(setup_.outputs)));
  const auto next = static_cast<std::uint8_t>(bus::fc::kRequest | bus::fc::kSrdHigh | bus::fc::kFcv);
  if (sap == 0) return send(bus::make_telegram(setup_.address, 2, next, random_.bytes(setup_.outputs)));
  send(bus::make_telegram(setup_.address, 2, next, {}, static_cast<std::uint8_t>(sap), bus::sap::kMaster));
}

void RandomMaster::wait_watchdog() { extra_ += random_.between(9, 26) * bus::kTicksPerMs / 10; }

void RandomMaster::repeat_last() {
  if (last_) send(*last_);
}

void RandomMaster::read_service() {
  constexpr int kSaps[] = {bus::sap::kReadInputs, bus::sap::kReadOutputs, bus::sap::kGetCfg};
  request(random_.pick(kSaps), {});
}

/// Too short for a start bit, a wrong character, or a break; soon followed by a telegram.
void RandomMaster::spike() {
  Action action;
  action.verb = Verb::kSpike;
  action.delay = random_.below(40) * bit() + random_.below(static_cast<int>(bit()));
  action.low = random_.one_in(2) ? random_.between(1, static_cast<int>(bit())) : random_.below(20) * bit() + 1;
  stimulus_.push_back(action);
  if (random_.one_in(2)) slave_diag();
}

void RandomMaster::set_prm(bool right) { request(bus::sap::kSetPrm, prm(right)); }

void RandomMaster::unlock() {
  bus::Bytes bytes = prm(true);
  bytes[0] = 0x40;
  request(bus::sap::kSetPrm, bytes);
}

void RandomMaster::check_cfg(bool right) {
  bus::Bytes cfg = setup_.cfg;
  if (cfg.empty()) cfg = {0x00};  // an empty slot; no data at all are refused (D8)
  if (!right) {
    constexpr int kMost = 200;  // S14
    const int what = random_.below(random_.one_in(4) ? 6 : 5);
    if (what == 5) cfg.resize(static_cast<std::size_t>(random_.between(kMost, kMost + 2)));
    if (what == 4) cfg[0] ^= 0x01;
    if (what == 0) cfg[static_cast<std::size_t>(random_.below(static_cast<int>(cfg.size())))] = random_.byte();
    if (what == 1) cfg.push_back(random_.one_in(2) ? std::uint8_t{0x00} : random_.byte());
    if (what == 2) cfg.pop_back();
    if (what == 3) cfg = random_.bytes(random_.below(6));
  }
  request(bus::sap::kChkCfg, cfg);
}

void RandomMaster::data_exchange() {
  int length = !careful_ && random_.one_in(16) ? random_.below(3) * random_.below(4) : setup_.outputs;
  if (setup_.fail_safe && random_.one_in(8)) length = 0;  // Clear (S19)
  request(kNoSap, random_.bytes(length));
}

void RandomMaster::global_control() {
  constexpr int kCommands[] = {0x20, 0x20, 0x10, 0x08, 0x08, 0x04, 0x28, 0x28, 0x14, 0x02, 0x30, 0x0C};
  bus::Bytes data = {
      static_cast<std::uint8_t>(random_.one_in(careful_ ? 20 : 5) ? random_.byte() : random_.pick(kCommands)),
      random_.one_in(careful_ ? 12 : 3) ? random_.byte() : std::uint8_t{0}};
  if (!careful_ && random_.one_in(16)) data.resize(static_cast<std::size_t>(random_.below(4)));
  const std::uint8_t to = random_.one_in(3) ? setup_.address : bus::kBroadcast;
  send(bus::make_telegram(to, master(), random_.one_in(2) ? 0x46 : 0x44, data, bus::sap::kGlobalControl,
                          bus::sap::kMaster),
       false);
}

void RandomMaster::set_slave_address() {
  const auto to = static_cast<std::uint8_t>(random_.one_in(4) ? random_.byte() : random_.between(3, 8));
  bus::Bytes data = {to, static_cast<std::uint8_t>(setup_.ident >> 8), static_cast<std::uint8_t>(setup_.ident & 0xFF),
                     static_cast<std::uint8_t>(random_.one_in(3))};
  if (random_.one_in(6)) data.resize(static_cast<std::size_t>(random_.below(7)));
  if (random_.one_in(6) && data.size() > 1) data[1] ^= 1;
  const bool right = data.size() == 4 && data[1] == setup_.ident >> 8 && to < 126;
  request(bus::sap::kSetSlaveAddress, data);
  if (careful_ ? right && !setup_.locked : random_.one_in(2) && to < 126) setup_.address = to;
  setup_.locked = setup_.locked || (right && data[3] != 0);
}

void RandomMaster::set_slave_address_to(int address) {
  request(bus::sap::kSetSlaveAddress, {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(setup_.ident >> 8),
                                       static_cast<std::uint8_t>(setup_.ident & 0xFF), 0});
  if (address < 126) setup_.address = static_cast<std::uint8_t>(address);
}

void RandomMaster::any_service() {
  constexpr int kSaps[] = {bus::sap::kSetSlaveAddress,
                           bus::sap::kReadInputs,
                           bus::sap::kReadOutputs,
                           bus::sap::kGlobalControl,
                           bus::sap::kGetCfg,
                           bus::sap::kSlaveDiag,
                           51,
                           49,
                           48,
                           47,
                           10};
  const int what = random_.below(14);
  if (what == 0) return send(bus::make_telegram(setup_.address, master(), bus::fc::kRequest | bus::fc::kFdlStatus));
  if (what == 1)
    return send(
        bus::make_telegram(setup_.address, master(), static_cast<std::uint8_t>(random_.byte() | bus::fc::kRequest)));
  if (what == 2) return data_exchange();
  const int sap = random_.pick(kSaps);
  const bool dpv1 = sap > 10 && sap <= 51;
  bus::Telegram telegram = bus::make_telegram(
      setup_.address, random_.one_in(8) ? std::uint8_t{3} : master(), function_code(),
      random_.one_in(3) ? random_.bytes(random_.between(1, 7)) : bus::Bytes{}, static_cast<std::uint8_t>(sap),
      static_cast<std::uint8_t>(!dpv1 || random_.one_in(8) ? bus::sap::kMaster
                                : sap == 51                ? 51
                                                           : 50));
  send(telegram);
}

/// Other SAPs, function codes, FDL services.
void RandomMaster::other_service() {
  constexpr int kSaps[] = {bus::sap::kReadInputs,
                           bus::sap::kReadOutputs,
                           bus::sap::kGetCfg,
                           bus::sap::kReadInputs,
                           bus::sap::kReadOutputs,
                           bus::sap::kGetCfg,
                           49,
                           51,
                           50,
                           58,
                           10};
  const int what = random_.below(12);
  if (what == 0) return send(bus::make_telegram(setup_.address, master(), 0x49));
  if (what == 1)
    return send(bus::make_telegram(setup_.address, master(), static_cast<std::uint8_t>(random_.byte() | 0x40)));
  if (what == 2)
    return send(bus::make_telegram(setup_.address, master(), random_.byte(), random_.bytes(random_.below(5)),
                                   static_cast<std::uint8_t>(random_.below(64)), bus::sap::kMaster));
  request(random_.one_in(12) ? random_.below(64) : random_.pick(kSaps),
          random_.one_in(6) ? random_.bytes(random_.below(4)) : bus::Bytes{});
}

void RandomMaster::repetition() {
  if (!last_) return slave_diag();
  bus::Telegram again = *last_;
  if (random_.one_in(4)) again.sa = static_cast<std::uint8_t>(again.sa ^ 1);
  if (random_.one_in(4)) again.fc ^= bus::fc::kFcb;
  if (random_.one_in(4) && !again.data.empty()) again.data[0] ^= 0x10;
  send(again);
}

void RandomMaster::broken() {
  const bus::Telegram telegram =
      bus::make_telegram(setup_.address, 2, 0x6D, random_.bytes(random_.below(4)),
                         random_.one_in(2) ? std::optional<std::uint8_t>(bus::sap::kSlaveDiag) : std::nullopt,
                         random_.one_in(2) ? std::optional<std::uint8_t>(bus::sap::kMaster) : std::nullopt);
  bus::Bytes bytes = bus::encode(telegram);
  const auto position = static_cast<std::size_t>(random_.below(static_cast<int>(bytes.size())));
  bus::WireFaults faults;
  switch (random_.below(14)) {
    case 0: faults.wrong_parity_at = position; break;
    case 1: faults.missing_stop_at = position; break;
    case 2:
    case 12:  // about a bit time, where it becomes a gap, or clearly one
      faults.gap_before = position;
      faults.gap_millibits = random_.one_in(2) ? random_.between(0, 7) * 250 : random_.between(1000, 4000);
      break;
    case 3:
      faults.truncate_after = position;
      faults.truncate_bits = random_.below(11);
      break;
    case 4:
      faults.glitch_at = position;
      faults.glitch = {random_.below(11'000), random_.between(100, 900)};
      break;
    case 5: bytes[position] ^= static_cast<std::uint8_t>(1 << random_.below(8)); break;
    case 6: bytes.push_back(random_.byte()); break;
    case 7:
      bytes[bytes.size() - (random_.one_in(2) ? 1 : 2)] ^= static_cast<std::uint8_t>(1 << random_.below(8));
      break;
    case 9:
      bytes[std::min<std::size_t>(2, bytes.size() - 1)] ^= static_cast<std::uint8_t>(1 << random_.below(8));
      break;
    case 10: faults.missing_stop_at = bytes.size() - 1; break;
    case 11:  // a SAP is announced but missing (S8)
      bytes = bus::encode(bus::make_telegram(setup_.address, 2, 0x6D));
      bytes[random_.one_in(2) ? 1 : 2] |= 0x80;
      bytes[4] = static_cast<std::uint8_t>(bytes[1] + bytes[2] + bytes[3]);
      break;
    case 8: bytes.insert(bytes.end(), bytes.begin(), bytes.end()); break;
    case 13:
      if (bytes[0] == bus::sd::k2) bytes[3] ^= static_cast<std::uint8_t>(1 << random_.below(8));
      break;
    default: bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(position)); break;
  }
  send(bytes, idle(), true, faults);
}

void RandomMaster::noise() {
  constexpr int kStarts[] = {bus::sd::k1, bus::sd::k2, bus::sd::k3, bus::sd::k4, bus::sd::kSc, 0x00};
  bus::Bytes bytes = random_.bytes(random_.between(1, 12));
  bytes[0] = static_cast<std::uint8_t>(random_.pick(kStarts));
  if (random_.one_in(2) && bytes[0] == bus::sd::k2) {
    bytes.resize(std::max<std::size_t>(bytes.size(), 4));
    bytes[1] = bytes[2] = static_cast<std::uint8_t>(random_.one_in(2) ? random_.below(8) : random_.byte());
    bytes[3] = bus::sd::k2;
  }
  send(bytes, idle(), random_.one_in(2));
}

void RandomMaster::sd3() {
  bus::Telegram telegram = bus::make_telegram(setup_.address, master(), function_code(), random_.bytes(8));
  if (random_.one_in(3)) {
    telegram.data.resize(6);
    telegram.dsap = bus::sap::kReadInputs;
    telegram.ssap = bus::sap::kMaster;
  }
  send(bus::prefer_sd3(telegram));
}

void RandomMaster::anything() {
  const int what = random_.below(100);
  if (what < 26) return data_exchange();
  if (what < 34) return slave_diag();
  if (what < 39) return set_prm(!random_.one_in(3));
  if (what < 44) return check_cfg(!random_.one_in(3));
  if (what < 51) return global_control();
  if (what < 54) return set_slave_address();
  if (what < 61) return other_service();
  if (what < 65) return repetition();
  if (what < 87) return broken();
  if (what < 91) return noise();
  if (what < 97) return spike();
  return sd3();
}

void RandomMaster::silence() { extra_ += random_.below(20) * bus::kTicksPerMs / 20; }

void RandomMaster::wait_baud_control() { extra_ += times_.baud_control - random_.below(2) * 40 * bit(); }

std::uint8_t RandomMaster::master() {
  if (!careful_ && random_.one_in(60)) return 127;  // S32
  return !careful_ && random_.one_in(10) ? std::uint8_t{3} : std::uint8_t{2};
}

/// SRD; the frame count bit toggles in a series, but sometimes does not.
std::uint8_t RandomMaster::function_code() {
  constexpr std::uint8_t kFcb = bus::fc::kFcb, kFcv = bus::fc::kFcv;
  const auto base =
      static_cast<std::uint8_t>(bus::fc::kRequest | (random_.one_in(3) ? bus::fc::kSrdLow : bus::fc::kSrdHigh));
  if (!careful_ && random_.one_in(16)) return base;
  if (!fcv_ || careful_ || random_.one_in(30)) {
    fcv_ = fcb_ = true;
    return static_cast<std::uint8_t>(base | kFcb);
  }
  if (!random_.one_in(30)) fcb_ = !fcb_;
  return static_cast<std::uint8_t>(base | kFcv | (fcb_ ? kFcb : 0));
}

void RandomMaster::request(int dsap, const bus::Bytes& data) {
  const bool sap = dsap != kNoSap;
  bus::Telegram telegram = bus::make_telegram(setup_.address, master(), function_code(), data);
  if (sap)
    telegram = bus::make_telegram(setup_.address, telegram.sa, telegram.fc, data, static_cast<std::uint8_t>(dsap),
                                  bus::sap::kMaster);
  if (sap && !careful_ && random_.one_in(24)) telegram.ssap.reset();
  send(telegram);
}

void RandomMaster::send(const bus::Telegram& telegram, bool answered) {
  if (answered) last_ = telegram;
  send(bus::encode(telegram), idle(), answered);
}

/// Usually T_SYN or slightly more; often near T_SYN, where one cycle decides (S3, S10).
Tick RandomMaster::idle() {
  if (careful_) return 33 * bit() + random_.below(static_cast<int>(8 * bit()));
  if (random_.one_in(6)) return 33 * bit() + random_.between(-22, 6) * kCycle / 2;
  if (random_.one_in(12)) return random_.below(33) * bit();
  return 33 * bit() + random_.below(static_cast<int>(20 * bit()));
}

void RandomMaster::send(const bus::Bytes& bytes, Tick idle, bool answered, const bus::WireFaults& faults) {
  Action action;
  action.verb = Verb::kSend;
  action.delay = std::max<Tick>(0, idle) + extra_;
  action.rate = setup_.rate;
  action.reply_bits = answered ? kReplyBits : 0;
  if (answered && random_.one_in(60)) action.reply_bits = random_.below(200);
  action.bytes = bytes;
  action.faults = faults;
  extra_ = 0;
  stimulus_.push_back(action);
}

}  // namespace dsdpv1::cosim
