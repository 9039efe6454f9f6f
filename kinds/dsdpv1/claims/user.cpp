// The user's reads: version, RAM, CRCs, flags.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "kinds/dsdpv1/claims/found.hpp"
#include "kinds/dsdpv1/claims/reads.hpp"
#include "kinds/dsdpv1/port/crc16.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::calibrate {
namespace {

std::vector<Wire> with_host_port(Wire wire) {
  std::vector<Wire> wires = host_port();
  wires.push_back(wire);
  return wires;
}

const Claim kData = {"P5", "D stands 31.25 ns after RD and CSR fell, until one of them rises", host_port()};
const Claim kRam = {"P6", "what the user wrote is there while it holds the DPRAM", with_host_port(wire::kLReq)};
const Claim kVersion = {"D1", "B000 to B003 are 01 0D 07 01, B004 is 00 or C5", host_port()};
const Claim kCrc = {"D2", "a block that the user reads has the right CRC of what D3 says", host_port()};
const Claim kTaken = {"H5", "flags of B010 that the user set are 0 after an access of the chip",
                      with_host_port(wire::kLReq)};

/// The bits that the chip clears (table 10).
constexpr std::uint8_t kFlags = dsdpv1::regs::kUserCommand1Input | dsdpv1::regs::kUserCommand1Diag |
                                dsdpv1::regs::kUserCommand1Init | dsdpv1::regs::kUserCommand1CfgVerdict |
                                dsdpv1::regs::kUserCommand1PrmVerdict;

/// A block written by the chip: its length byte is the last of the header.
struct Area {
  std::uint32_t first, header, crc;
  std::uint8_t news;  ///< the bit of B00E that announces it
  const char* what;

  bool has(std::uint32_t address) const { return address >= first && address <= crc + 1; }
};
constexpr std::array<Area, 3> kAreas = {{{0x319, 1, 0x40E, dsdpv1::regs::kChipCommand1Output, "outputs"},
                                         {0x410, 1, 0x4FE, dsdpv1::regs::kChipCommand1Prm, "parameters"},
                                         {0x500, 3, 0x5CB, dsdpv1::regs::kChipCommand1Cfg, "configuration"}}};

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
  /// Whether the chip held the DPRAM since the previous access.
  bool chip_came_before(const UserAccess& access) {
    bool came = false;
    for (; next_ < scene_.accesses.size() && scene_.accesses[next_].start < access.end; ++next_) {
      came = true;
      if (scene_.is_start_up(scene_.accesses[next_]))
        users_.clear(), valid_ = false;  // H6: all cells are the chip's again
    }
    return came;
  }
  void new_hold() {
    ++hold_;
    written_.clear();
    read_.clear();
    flags_before_ |= flags_now_;
    flags_now_ = 0;
  }
  void write(const UserAccess& access) {
    const std::uint8_t data = access.data;
    const bool sure = stands_at_end(access);
    written_.erase(access.address);
    read_.erase(access.address);
    if (sure) written_[access.address] = data;
    users_[access.address] = {hold_, sure ? data : kAnything};
    if (access.address == dsdpv1::regs::kUserCommand1) flags_now_ = sure ? data & kFlags : 0, flags_before_ = 0;
  }
  void read(UserAccess access) {
    read_.erase(access.address);
    if (!is_known(scene_, access)) return;
    const std::optional<Standing> standing = standing_data(scene_, access);
    if (!standing) return found_.judge.coarse(kData);
    judge_data(*standing);
    access.data = static_cast<std::uint8_t>(data_at(scene_.record, standing->to));
    judge_version(access);
    if (const auto found = written_.find(access.address); found != written_.end() && scene_.record.sees(wire::kLReq))
      check(kRam, access, found->second);
    if (access.address == dsdpv1::regs::kUserCommand1 && flags_before_ != 0 && scene_.record.sees(wire::kLReq)) {
      found_.judge.judge(kTaken, (access.data & flags_before_) == 0, access.end, "a flag still stands");
      flags_before_ = 0;
    }
    read_[access.address] = access.data;
    if (access.address == dsdpv1::regs::kChipCommand1) find_written(access.data);
    for (const Area& area : kAreas)
      if (access.address == area.crc + 1 && !is_users(area)) judge_crc(area, access);
  }

  /// No wire of A or D changes in the samples around WR's rise, so they show the value that the chip took.
  bool stands_at_end(const UserAccess& access) const {
    const Tick from = access.end - scene_.time.ticks(scene_.time.doubt()),
               to = access.end + scene_.time.ticks(2 * scene_.time.jitter);
    const auto first = scene_.record.traces.begin() + static_cast<std::ptrdiff_t>(wire::kA);
    return std::all_of(first, scene_.record.traces.end(),
                       [&](const Trace& wire) { return wire.count_until(from) == wire.count_until(to); });
  }

  /// A bit that the user cleared in an earlier hold: the chip has written this block since then.
  void find_written(std::uint8_t news) {
    const auto cleared = users_.find(dsdpv1::regs::kChipCommand1);
    if (cleared == users_.end()) return;
    for (const Area& area : kAreas) {
      const bool came = (news & area.news) != 0 && (cleared->second.data & area.news) == 0;
      if (!came || cleared->second.hold == hold_) continue;
      const std::size_t before = cleared->second.hold;
      for (auto cell = users_.lower_bound(area.first); cell != users_.end() && area.has(cell->first);)
        cell = cell->second.hold <= before ? users_.erase(cell) : std::next(cell);
    }
  }
  /// P6: it contains a byte that is, or may be, the user's.
  bool is_users(const Area& area) const {
    const auto cell = users_.lower_bound(area.first);
    return cell != users_.end() && area.has(cell->first);
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
    if (users_.count(access.address) != 0) return;  // P6: it keeps the user's value until the chip rewrites it
    if (access.address < kVersion4.size()) check(kVersion, access, kVersion4.at(access.address));
    if (access.address != dsdpv1::regs::kValidFlag) return;
    if (access.data != 0 || (valid_ && scene_.record.sees(wire::kLReq))) check(kVersion, access, kValid);
    valid_ = valid_ || access.data == kValid;
  }
  /// No wire of D changes between 1.5 cycles after RD's fall and its rise.
  void judge_data(const Standing& standing) {
    for (std::size_t bit = 0; bit < kDataWires; ++bit) {
      const Trace& wire = scene_.record.traces.at(static_cast<std::size_t>(wire::kD) + bit);
      if (wire.count_until(standing.from) == wire.count_until(standing.to)) continue;
      return found_.judge.fails(kData, wire.edges[wire.count_until(standing.from)],
                                fmt::format("D{} changes while RD is low", bit));
    }
    found_.judge.holds(kData);
  }
  /// Only for blocks read completely in one hold.
  void judge_crc(const Area& area, const UserAccess& access) {
    const auto length = read_.find(area.first + area.header - 1);
    if (length == read_.end()) return;
    tb::Crc16 crc;
    bool empty = true;
    for (std::uint32_t i = 0; i < area.header + length->second; ++i) {
      const auto byte = read_.find(area.first + i);
      if (byte == read_.end()) return;
      crc.add(byte->second);
      empty = empty && byte->second == 0;
    }
    const auto high = read_.find(area.crc);
    if (high == read_.end()) return;
    const unsigned seen = static_cast<unsigned>(high->second) << 8U | access.data, right = crc.value();
    if (seen == 0 && empty) return;  // as left by the start-up
    if (seen == right)
      found_.judge.holds(kCrc);
    else
      found_.judge.fails(kCrc, access.end,
                         fmt::format("the CRC of the {} is {:04X}, {:04X} is right", area.what, seen, right));
  }

  static constexpr std::uint8_t kAnything = 0xFF;  ///< clears nothing
  struct Written {
    std::size_t hold = 0;
    std::uint8_t data = 0;
  };

  const Scene& scene_;
  Found& found_;
  std::size_t next_ = 0;                                  ///< the chip's access being evaluated
  std::map<std::uint32_t, std::uint8_t> written_, read_;  ///< in this hold
  std::map<std::uint32_t, Written> users_;                ///< cells written by the user, with the last write
  std::size_t hold_ = 0;                                  ///< a number for each
  bool valid_ = false;                                    ///< B004 was C5
  std::uint8_t flags_now_ = 0, flags_before_ = 0;
};

}  // namespace

void measure_user(const Scene& scene, Found& found) {
  if (!may_miss_writes(scene)) return UserJudge(scene, found).judge();
  for (const Claim* claim : user_claims()) found.judge.coarse(*claim);
}

ClaimList user_claims() { return {&kData, &kRam, &kVersion, &kCrc, &kTaken}; }

}  // namespace dsdpv1::calibrate
