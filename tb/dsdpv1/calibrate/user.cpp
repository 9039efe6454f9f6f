// What the user reads: version, RAM, CRCs, flags.
#include <fmt/format.h>

#include <map>

#include "registers/dsdpv1_regs.hpp"
#include "tb/dsdpv1/calibrate/found.hpp"

namespace calibrate {
namespace {

const Claim kData = {"P5", "D stands 31.25 ns after RD fell, until it rises", {}, true};
const Claim kRam = {"P6", "what the user wrote is there while it holds the DPRAM", {Wire::kLReq}, true};
const Claim kVersion = {"D1", "B000 to B003 are 01 0D 07 01, B004 is 00 or C5", {}, true};
const Claim kCrc = {"D2", "a block that the user reads has the right CRC", {}, true};
const Claim kCover = {"D3", "it covers what D3 says", {}, true};
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
    read_.erase(access.address);
    if (access.address == dsdpv1::regs::kUserCommand1) flags_now_ = access.data, flags_before_ = 0;
  }
  void read(const UserAccess& access) {
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
    if (written_.count(access.address) != 0) return;
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
    for (const Claim* claim : {&kCrc, &kCover})
      if (seen == right)
        found_.judge.holds(*claim);
      else
        found_.judge.fails(*claim, access.end,
                           fmt::format("the CRC of the {} is {:04X}, {:04X} is right", area.what, seen, right));
  }

  const Scene& scene_;
  Found& found_;
  std::size_t next_ = 0;                                  ///< the chip's access that is looked at
  std::map<std::uint32_t, std::uint8_t> written_, read_;  ///< in this hold
  std::uint8_t flags_now_ = 0, flags_before_ = 0;
};

}  // namespace

void measure_user(const Scene& scene, Found& found) { UserJudge(scene, found).judge(); }

Claims user_claims() { return {&kData, &kRam, &kVersion, &kCrc, &kCover, &kTaken}; }

}  // namespace calibrate
