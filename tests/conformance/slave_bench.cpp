#include "tests/conformance/slave_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "model/dpram/crc16.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
// The user's bus: comfortable times, table 15's limits are tested on their own.
constexpr Tick kSetup = 240, kStrobe = 600, kHold = 240;  // 20 ns, 50 ns, 20 ns

void put_crc(Bytes& block, std::uint16_t crc_error) {
  const unsigned crc = dpram::crc16(block.data(), static_cast<int>(block.size())) ^ crc_error;
  block.push_back(static_cast<std::uint8_t>(crc >> 8));
  block.push_back(static_cast<std::uint8_t>(crc & 0xFF));
}

}  // namespace

Bytes Init::block() const {
  const std::size_t to_cfg = regs::kInitCfg - regs::kInit - 1;
  const std::uint8_t size = length.value_or(static_cast<std::uint8_t>(to_cfg + cfg.size()));
  Bytes block = {size,
                 address,
                 static_cast<std::uint8_t>(ident >> 8),
                 static_cast<std::uint8_t>(ident & 0xFF),
                 command,
                 0,
                 0,
                 max_input,
                 max_output,
                 max_diag,
                 max_prm,
                 prm_mode,
                 max_cfg,
                 cfg_mode,
                 static_cast<std::uint8_t>(cfg.size())};
  std::copy(cfg.begin(), cfg.end(), std::back_inserter(block));
  block.resize(static_cast<std::size_t>(size) + 1);
  return block;
}

Bytes Prm::bytes() const {
  Bytes bytes = {
      status, wd1, wd2, min_tsdr, static_cast<std::uint8_t>(ident >> 8), static_cast<std::uint8_t>(ident & 0xFF),
      group};
  std::copy(user.begin(), user.end(), std::back_inserter(bytes));
  return bytes;
}

SlaveBench::SlaveBench(const dsdpv1::Config& config, Engines engines)
    : chip(segment, config, engines), requester(segment) {
  timeline.check_announcements();
  timeline.add(chip);
  timeline.add(requester);
}

void SlaveBench::run_until(Tick until) {
  timeline.run_until(until);
  chip.compare(until);
}

// --- the user --------------------------------------------------------------------------------------------------------

void SlaveBench::power_on() {
  run_cycles(10);
  chip.set(now(), Pin::kReset, 1);
  for (int i = 0; i < 100 && peek(regs::kValidFlag) != regs::kValidFlagValid; ++i) run_cycles(96);
  ASSERT_EQ(peek(regs::kValidFlag), regs::kValidFlagValid);
  run_cycles(48);
}

Tick SlaveBench::acquire() {
  const Tick asked = now();
  chip.set(now(), Pin::kRReq, 1);
  run_cycles(4);  // H2: the chip may still start up to 3 cycles after R_REQ rose
  for (int i = 0; i < 20'000 && (chip.level(Pin::kLReq) != 0 || chip.level(Pin::kLSta) != 0); ++i) run_cycles(4);
  EXPECT_EQ(chip.level(Pin::kLSta), 0) << "the chip never releases the DPRAM";
  chip.set(now(), Pin::kRSta, 1);
  run_cycles(1);
  owns_ = true;
  return now() - asked;
}

void SlaveBench::release() {
  chip.set(now(), Pin::kRSta, 0);
  chip.set(now(), Pin::kRReq, 0);
  owns_ = false;
}

std::uint8_t SlaveBench::read(std::uint16_t cell) {
  chip.set(now(), Pin::kA, static_cast<Level>(cell));
  chip.set(now(), Pin::kCsr, 0);
  run_for(kSetup);
  chip.set(now(), Pin::kRd, 0);
  run_for(kStrobe);
  const Level data = chip.level(Pin::kDOut);
  EXPECT_GE(data, 0) << "D is X or Z when B" << std::hex << cell << " is read";
  chip.set(now(), Pin::kRd, 1);
  run_for(kHold);
  chip.set(now(), Pin::kCsr, 1);
  return static_cast<std::uint8_t>(data);
}

void SlaveBench::write(std::uint16_t cell, std::uint8_t value) {
  chip.set(now(), Pin::kA, static_cast<Level>(cell));
  chip.set(now(), Pin::kDIn, value);
  chip.set(now(), Pin::kCsr, 0);
  run_for(kSetup);
  chip.set(now(), Pin::kWr, 0);
  run_for(kStrobe);
  chip.set(now(), Pin::kWr, 1);
  run_for(kHold);
  chip.set(now(), Pin::kCsr, 1);
  chip.set(now(), Pin::kDIn, dsdpv1::kLevelZ);
}

void SlaveBench::write_block(std::uint16_t base, const Bytes& bytes, std::uint16_t crc_address,
                             std::uint16_t crc_error) {
  Bytes block = bytes;
  put_crc(block, crc_error);
  for (std::size_t i = 0; i < bytes.size(); ++i) write(static_cast<std::uint16_t>(base + i), block[i]);
  write(crc_address, block[bytes.size()]);
  write(static_cast<std::uint16_t>(crc_address + 1), block[bytes.size() + 1]);
}

void SlaveBench::poke(std::uint16_t cell, std::uint8_t value) {
  acquire();
  write(cell, value);
  release();
}

Bytes SlaveBench::peek(std::uint16_t cell, int count) {
  Bytes bytes;
  for (int i = 0; i < count; ++i) bytes.push_back(peek(static_cast<std::uint16_t>(cell + i)));
  return bytes;
}

void SlaveBench::chip_accesses(int accesses) {
  if (owns_) release();
  const auto target = chip.status().accesses + static_cast<std::uint64_t>(accesses);
  for (int i = 0; i < 100'000 && (chip.status().accesses < target || chip.level(Pin::kLSta) != 0); ++i) run_cycles(1);
  ASSERT_GE(chip.status().accesses, target) << "the chip does not access the DPRAM";
}

bool SlaveBench::initialise(const Init& init) {
  address = init.address;
  acquire();
  write_block(regs::kInit, init.block(), regs::kInitCrc, init.crc_error);
  write(regs::kUserCommand1, regs::kUserCommand1Init);
  chip_accesses();
  return (peek(regs::kChipStatus1) & regs::kChipStatus1Initialised) != 0;
}

void SlaveBench::give_inputs(const Bytes& inputs, std::uint16_t crc_error) {
  Bytes block = {static_cast<std::uint8_t>(inputs.size())};
  block.insert(block.end(), inputs.begin(), inputs.end());
  acquire();
  write_block(regs::kInput, block, regs::kInputCrc, crc_error);
  write(regs::kUserCommand1, regs::kUserCommand1Input);
  chip_accesses();
}

void SlaveBench::give_diag(std::uint8_t type, const Bytes& diag, std::uint16_t crc_error) {
  Bytes block = {type, static_cast<std::uint8_t>(diag.size())};
  block.insert(block.end(), diag.begin(), diag.end());
  acquire();
  write_block(regs::kDiag, block, regs::kDiagCrc, crc_error);
  write(regs::kUserCommand1, regs::kUserCommand1Diag);
  chip_accesses();
}

void SlaveBench::verdict(std::optional<bool> prm_good, std::optional<bool> cfg_good) {
  const unsigned wrong = (prm_good.value_or(true) ? 0U : regs::kUserStatus1PrmWrong) |
                         (cfg_good.value_or(true) ? 0U : regs::kUserStatus1CfgWrong);
  const unsigned flags =
      (prm_good ? regs::kUserCommand1PrmVerdict : 0U) | (cfg_good ? regs::kUserCommand1CfgVerdict : 0U);
  acquire();
  write(regs::kUserStatus1, static_cast<std::uint8_t>(wrong));
  write(regs::kUserCommand1, static_cast<std::uint8_t>(flags));
  chip_accesses();
}

std::optional<Bytes> SlaveBench::fetch_outputs() {
  acquire();
  const std::uint8_t flags = read(regs::kChipCommand1);
  if ((flags & regs::kChipCommand1Output) == 0) {
    release();
    return std::nullopt;
  }
  Bytes block = {read(regs::kOutput)};
  for (int i = 1; i <= block[0]; ++i) block.push_back(read(static_cast<std::uint16_t>(regs::kOutput + i)));
  const int crc = read(regs::kOutputCrc) << 8 | read(regs::kOutputCrc + 1);
  EXPECT_EQ(crc, dpram::crc16(block.data(), static_cast<int>(block.size()))) << "CRC of the outputs";
  write(regs::kChipCommand1, static_cast<std::uint8_t>(flags & ~regs::kChipCommand1Output));
  release();
  return Bytes(block.begin() + 1, block.end());
}

// --- the master ------------------------------------------------------------------------------------------------------

void SlaveBench::find_baud(int index) {
  constexpr std::uint8_t kNobody = 100;
  requester.set_baud(index);
  for (int i = 0; i < 100'000 && chip.status().baud_index.code() != index; ++i) {
    requester.send(timeline, bus::make_telegram(kNobody, master, 0x49), {.wants_answer = false});
    run_for(requester.bit() * 60);
  }
  ASSERT_EQ(chip.status().baud_index.code(), index);
}

bus::Exchange SlaveBench::srd(int dsap, int ssap, const Bytes& data) {
  const auto fc = static_cast<std::uint8_t>(0x4D | (fcb ? 0x20 : 0) | (fcb_valid ? 0x10 : 0));
  const auto optional_sap = [](int sap) {
    return sap < 0 ? std::optional<std::uint8_t>{} : std::optional<std::uint8_t>{static_cast<std::uint8_t>(sap)};
  };
  const auto telegram = bus::make_telegram(address, master, fc, data, optional_sap(dsap), optional_sap(ssap));
  bus::Exchange exchange = requester.send(timeline, telegram);
  if (!exchange.silent()) {
    fcb = fcb_valid ? !fcb : false;  // a series starts with FCB = 1, FCV = 0
    fcb_valid = true;
  }
  chip.compare(now());
  return exchange;
}

bus::Exchange SlaveBench::data_exchange(const Bytes& outputs) { return srd(-1, -1, outputs); }

Bytes SlaveBench::slave_diag() {
  const bus::Exchange exchange = srd(60, 62, {});
  return exchange.answered() ? exchange.answer().data : Bytes{};
}

void SlaveBench::global_control(std::uint8_t command, std::uint8_t group) {
  requester.send(timeline, bus::make_telegram(bus::kBroadcast, master, 0x46, {command, group}, 58, 62),
                 {.wants_answer = false});
  run_for(requester.bit() * 4);  // the decision is 1 bit time after the end (S10)
}

bus::Exchange SlaveBench::fdl_status() { return requester.send(timeline, bus::make_telegram(address, master, 0x49)); }

void SlaveBench::to_wait_prm(const Init& init, int baud) {
  power_on();
  ASSERT_TRUE(initialise(init));
  find_baud(baud);
  ASSERT_EQ(dp_state(), dsdpv1::DpState::kWaitPrm);
}

void SlaveBench::to_wait_cfg(const Init& init, const Prm& prm, int baud) {
  to_wait_prm(init, baud);
  ASSERT_TRUE(set_prm(prm).short_acknowledge());
  ASSERT_EQ(dp_state(), dsdpv1::DpState::kWaitCfg);
}

void SlaveBench::to_data_exch(const Init& init, const Prm& prm, int baud) {
  to_wait_cfg(init, prm, baud);
  ASSERT_TRUE(check_cfg(init.cfg).short_acknowledge());
  ASSERT_EQ(dp_state(), dsdpv1::DpState::kDataExch);
}

// --- what happened ---------------------------------------------------------------------------------------------------

int SlaveBench::count(profibus::Reason reason) const {
  int found = 0;
  for (const profibus::Event& event : chip.events()) found += event.reason == reason ? 1 : 0;
  return found;
}

const profibus::Event& SlaveBench::last(profibus::Reason reason) const {
  static const profibus::Event none{};
  for (auto event = chip.events().rbegin(); event != chip.events().rend(); ++event)
    if (event->reason == reason) return *event;
  ADD_FAILURE() << "no event " << profibus::code(reason);
  return none;
}

std::vector<PinChange> SlaveBench::changes(Pin pin) const {
  std::vector<PinChange> found;
  for (const PinChange& change : chip.trace())
    if (change.pin == pin) found.push_back(change);
  return found;
}

}  // namespace dsdpv1::conformance
