// What the user reads: version, RAM, CRCs, flags.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "registers/dsdpv1_regs.hpp"
#include "tb/dsdpv1/calibrate/found.hpp"

namespace calibrate {
namespace {

const Claim kData = {"P5", "D stands 31.25 ns after RD and CSR fell, until one of them rises", {}, true};
const Claim kRam = {"P6", "what the user wrote is there while it holds the DPRAM", {Wire::kLReq}, true};
const Claim kVersion = {"D1", "B000 to B003 are 01 0D 07 01, B004 is 00 or C5", {}, true};
const Claim kCrc = {"D2", "a block that the user reads has the right CRC of what D3 says", {}, true};
const Claim kTaken = {"H5", "flags of B010 that the user set are 0 after an access of the chip", {Wire::kLReq}, true};

std::uint16_t crc_of(const bus::Bytes& bytes) {
  constexpr std::uint16_t kPolynomial = 0xA001;
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? crc >> 1U ^ kPolynomial : crc >> 1U;
  }
  return static_cast<std::uint16_t>(crc);
}

/// The bits that the chip clears (table 10).
constexpr std::uint8_t kFlags = dsdpv1::regs::kUserCommand1Input | dsdpv1::regs::kUserCommand1Diag |
                                dsdpv1::regs::kUserCommand1Init | dsdpv1::regs::kUserCommand1CfgVerdict |
                                dsdpv1::regs::kUserCommand1PrmVerdict;

/// A block that the chip writes: its length byte stands last of the header.
struct Area {
  std::uint32_t first, header, crc;
  const char* what;
};
constexpr std::array<Area, 3> kAreas = {
    {{0x319, 1, 0x40E, "outputs"}, {0x410, 1, 0x4FE, "parameters"}, {0x500, 3, 0x5CB, "configuration"}}};

class UserJudge {
 public:
  UserJudge(const Scene& scene, Found& found) : scene_(scene), found_(found) {}

  void judge() {
    for (const UserAccess& access : scene_.user) {
      if (chip_came_before(access)) new_hold();
      if (access.write)
        write(access);
      else
        read(access);
    }
  }

 private:
  /// Whether the chip had the DPRAM since the access before.
  bool chip_came_before(const UserAccess& access) {
    bool came = false;
    for (; next_ < scene_.accesses.size() && scene_.accesses[next_].start < access.end; ++next_) came = true;
    return came;
  }
  void new_hold() {
    written_.clear();
    read_.clear();
    flags_before_ |= flags_now_;
    flags_now_ = 0;
  }
  void write(const UserAccess& access) {
    written_[access.address] = access.data;
    written_at_[access.address] = access.end;
    read_.erase(access.address);
    if (access.address == dsdpv1::regs::kUserCommand1) flags_now_ = access.data & kFlags, flags_before_ = 0;
  }
  void read(const UserAccess& access) {
    read_.erase(access.address);
    if (!is_known(access)) return;
    judge_data(access);
    judge_version(access);
    if (const auto found = written_.find(access.address); found != written_.end() && scene_.record.sees(Wire::kLReq))
      check(kRam, access, found->second);
    if (access.address == dsdpv1::regs::kUserCommand1 && flags_before_ != 0 && scene_.record.sees(Wire::kLReq)) {
      found_.judge.judge(kTaken, (access.data & flags_before_) == 0, access.end, "a flag still stands");
      flags_before_ = 0;
    }
    read_[access.address] = access.data;
    for (const Area& area : kAreas)
      if (access.address == area.crc + 1) judge_crc(area, access);
  }

  /// Whether the rulings say what it brings: it has the DPRAM (P12), which a reset takes (P10, H6), and no write of the
  /// same cell is on its way (P8). What is not in the capture is taken to be right.
  bool is_known(const UserAccess& access) const {
    return !in_reset(access) && !before_start_up(access) && has_dpram(access) && !in_flight(access);
  }
  bool in_reset(const UserAccess& access) const {
    return scene_.in_reset(access.start - scene_.time.ticks(3) - scene_.time.margin(), access.end);
  }
  bool before_start_up(const UserAccess& access) const {
    const Trace& reset = scene_.record[Wire::kReset];
    const std::size_t rose = reset.last(access.start, true);
    if (rose == Trace::kNone || !scene_.record.sees(Wire::kLReq)) return false;
    return next_ == 0 || scene_.accesses[next_ - 1].start < reset.edges[rose];
  }
  bool has_dpram(const UserAccess& access) const {
    const auto is = [this](Wire wire, bool level, Tick from, Tick to) {
      const Trace& trace = scene_.record[wire];
      return !trace.seen || (level ? trace.high(from, to) : trace.low(from, to));
    };
    const Tick from = access.start - scene_.time.margin(), to = access.start + scene_.time.margin();
    return is(Wire::kRReq, true, access.start, access.end) && is(Wire::kRSta, true, access.start, access.end) &&
           is(Wire::kLReq, false, from, to) && is(Wire::kLSta, false, from, to);
  }
  /// A write takes effect at the third edge of CLK after WR rose, a read samples at the first.
  bool in_flight(const UserAccess& access) const {
    const auto write = written_at_.find(access.address);
    return write != written_at_.end() && scene_.time.between(write->second, access.start).lo < 3;
  }

  void check(const Claim& claim, const UserAccess& access, unsigned right) {
    if (access.data == right)
      found_.judge.holds(claim);
    else
      found_.judge.fails(claim, access.end,
                         fmt::format("B{:03X} reads {:02X}, {:02X} is right", access.address, access.data, right));
  }
  void judge_version(const UserAccess& access) {
    constexpr std::array<unsigned, 4> kVersion4 = {0x01, 0x0D, 0x07, 0x01};
    constexpr unsigned kValid = 0xC5;
    if (written_at_.count(access.address) != 0) return;  // P6: it holds that until the chip rewrites it
    if (access.address < kVersion4.size()) check(kVersion, access, kVersion4.at(access.address));
    if (access.address == dsdpv1::regs::kValidFlag && access.data != 0) check(kVersion, access, kValid);
  }
  /// No wire of D changes between 1.5 cycles behind RD's fall and its rise.
  void judge_data(const UserAccess& access) {
    const Tick from = access.start + scene_.time.ticks(1.5 + scene_.time.doubt()),
               to = access.end - scene_.time.ticks(scene_.time.doubt());
    if (from >= to) return found_.judge.coarse(kData);
    for (std::size_t bit = 0; bit < kDataWires; ++bit) {
      const Trace& wire = scene_.record.traces.at(static_cast<std::size_t>(Wire::kD) + bit);
      if (wire.count_until(from) == wire.count_until(to)) continue;
      return found_.judge.fails(kData, wire.edges[wire.count_until(from)],
                                fmt::format("D{} changes while RD is low", bit));
    }
    found_.judge.holds(kData);
  }
  /// Only of blocks that were read whole in one hold.
  void judge_crc(const Area& area, const UserAccess& access) {
    const auto length = read_.find(area.first + area.header - 1);
    if (length == read_.end()) return;
    bus::Bytes bytes;
    for (std::uint32_t i = 0; i < area.header + length->second; ++i) {
      const auto byte = read_.find(area.first + i);
      if (byte == read_.end()) return;
      bytes.push_back(byte->second);
    }
    const auto high = read_.find(area.crc);
    if (high == read_.end()) return;
    const unsigned seen = static_cast<unsigned>(high->second) << 8U | access.data, right = crc_of(bytes);
    const bool empty = std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
    if (seen == 0 && empty) return;  // as the start-up has left it
    if (seen == right)
      found_.judge.holds(kCrc);
    else
      found_.judge.fails(kCrc, access.end,
                         fmt::format("the CRC of the {} is {:04X}, {:04X} is right", area.what, seen, right));
  }

  const Scene& scene_;
  Found& found_;
  std::size_t next_ = 0;                                  ///< the chip's access that is looked at
  std::map<std::uint32_t, std::uint8_t> written_, read_;  ///< in this hold
  std::map<std::uint32_t, Tick> written_at_;              ///< by the user, the last time
  std::uint8_t flags_now_ = 0, flags_before_ = 0;
};

}  // namespace

void measure_user(const Scene& scene, Found& found) { UserJudge(scene, found).judge(); }

Claims user_claims() { return {&kData, &kRam, &kVersion, &kCrc, &kTaken}; }

}  // namespace calibrate
