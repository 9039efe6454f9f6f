#include "kinds/dsdpv1/random/random_user.hpp"

#include <algorithm>

#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::cosim {
namespace {

struct Configuration {
  bus::Bytes bytes;
  int inputs, outputs;
};

/// Identifiers of every kind: simple and special, bytes and words, one direction and both.
const Configuration kConfigurations[] = {{{0x11, 0x21}, 2, 2},
                                         {{0x31}, 2, 2},
                                         {{0x13, 0x23}, 4, 4},
                                         {{0x10}, 1, 0},
                                         {{0x20}, 0, 1},
                                         {{0x51, 0x60}, 4, 2},
                                         {{0x71}, 4, 4},
                                         {{0xC1, 0x01, 0x02, 0xAA}, 3, 2},
                                         {{0x41, 0x43, 0x11}, 4, 0},
                                         {{0x00, 0x33}, 4, 4},
                                         {{0x1F, 0x2F, 0x12}, 19, 16},
                                         {{}, 0, 0}};

}  // namespace

Setup RandomUser::any_setup() {
  Setup setup;
  const int most = static_cast<int>(std::size(kConfigurations));
  const Configuration& cfg = kConfigurations[random_.below(most)];
  setup.cfg = cfg.bytes;
  setup.inputs = cfg.inputs;
  setup.outputs = cfg.outputs;
  setup.address = random_.one_in(6) ? static_cast<std::uint8_t>(random_.between(0, 126)) : std::uint8_t{5};
  setup.command = random_.one_in(3) ? random_.byte() : std::uint8_t{0x0F};
  setup.prm_mode = random_.one_in(3) ? random_.between(1, 2) : 0;
  setup.cfg_mode = random_.one_in(3) ? random_.between(1, 2) : 0;
  setup.max_prm = random_.one_in(2) ? random_.between(0, 4) : 237;
  if (random_.one_in(3)) setup.max_cfg = static_cast<int>(cfg.bytes.size()) + random_.below(2);
  if (random_.one_in(4)) setup.max_input = cfg.inputs;
  if (random_.one_in(4)) setup.max_output = cfg.outputs;
  if (random_.one_in(4)) setup.max_diag = random_.below(8);
  return setup;
}

bus::Bytes RandomUser::init_block() const {
  const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
  const auto cfg_length = setup_.cfg.size();
  bus::Bytes bytes = {byte(14 + static_cast<int>(cfg_length)),
                      setup_.address,
                      byte(setup_.ident >> 8),
                      byte(setup_.ident & 0xFF),
                      setup_.command,
                      random_.byte(),
                      random_.byte(),
                      byte(setup_.max_input),
                      byte(setup_.max_output),
                      byte(setup_.max_diag),
                      byte(setup_.max_prm),
                      byte(setup_.prm_mode),
                      byte(setup_.max_cfg),
                      byte(setup_.cfg_mode),
                      byte(static_cast<int>(cfg_length))};
  bytes.insert(bytes.end(), setup_.cfg.begin(), setup_.cfg.end());
  return bytes;
}

void RandomUser::hand_over_init(const bus::Bytes& bytes) {
  host_.take();
  host_.block(regs::kInit, regs::kInitCrc, bytes);
  command(regs::kUserCommand1Init);
  host_.give();
}

void RandomUser::initialise() {
  bus::Bytes bytes = init_block();
  if (host_.mishap(10)) bytes[static_cast<std::size_t>(random_.below(static_cast<int>(bytes.size())))] = random_.byte();
  if (host_.mishap(16)) bytes[1] = static_cast<std::uint8_t>(random_.between(125, 129));
  hand_over_init(bytes);
}

void RandomUser::initialise_wrong() {
  constexpr int kLongestInit = 214;  // D12
  struct Cell {
    int address, most;
  };
  const Cell cells[] = {{regs::kInitLength, kLongestInit},
                        {regs::kInitAddress, regs::kInitAddressLimit},
                        {regs::kInitMaxInput, regs::kInitMaxInputLimit},
                        {regs::kInitMaxOutput, regs::kInitMaxOutputLimit},
                        {regs::kInitMaxDiag, regs::kInitMaxDiagLimit},
                        {regs::kInitMaxPrm, regs::kInitMaxPrmLimit},
                        {regs::kPrmMode, 2},
                        {regs::kInitMaxCfg, regs::kInitMaxCfgLimit},
                        {regs::kCfgMode, 2},
                        {regs::kInitCfgLength, setup_.max_cfg}};
  bus::Bytes bytes = init_block();
  const auto at = [&bytes](int address) -> std::uint8_t& {
    return bytes[static_cast<std::size_t>(address - regs::kInit)];
  };
  if (random_.one_in(4)) {  // too few inputs or outputs, or an incomplete identifier
    at(random_.one_in(2) ? regs::kInitMaxInput : regs::kInitMaxOutput) = 0;
    bytes.back() |= 0xC0;
  } else {
    const Cell cell = random_.pick(cells);
    const int least = std::min(cell.most + 1, 255);
    at(cell.address) = static_cast<std::uint8_t>(random_.one_in(2) ? least : random_.between(least, 255));
  }
  if (random_.one_in(10)) bytes[0] = static_cast<std::uint8_t>(random_.below(20));
  hand_over_init(bytes);
}

void RandomUser::inputs() {
  bus::Bytes bytes = random_.bytes(setup_.inputs + (host_.mishap(10) ? random_.between(-1, 1) : 0) + 1);
  if (bytes.empty()) bytes.push_back(0);
  bytes[0] =
      static_cast<std::uint8_t>(host_.mishap(16) ? random_.between(240, 255) : static_cast<int>(bytes.size()) - 1);
  host_.take();
  host_.block(regs::kInput, regs::kInputCrc, bytes);
  if (host_.mishap(4)) host_.write(regs::kUserCommand2, random_.below(4) << 6);  // D16
  command(regs::kUserCommand1Input);
  host_.give();
}

void RandomUser::diagnosis() {
  constexpr int kTypes[] = {0x00, 0x01, 0x81, 0x02, 0x82, 0x81, 0x02, 0x55};
  bus::Bytes bytes = random_.bytes(random_.between(2, 2 + std::min(setup_.max_diag + 1, 12)));
  bytes[0] = static_cast<std::uint8_t>(random_.pick(kTypes));
  bytes[1] =
      static_cast<std::uint8_t>(random_.one_in(16) ? random_.between(236, 255) : static_cast<int>(bytes.size()) - 2);
  host_.take();
  host_.block(regs::kDiag, regs::kDiagCrc, bytes);
  command(regs::kUserCommand1Diag);
  host_.give();
}

void RandomUser::verdict(bool prm, bool cfg, bool good) {
  host_.take();
  host_.write(regs::kUserStatus1, good ? 0 : random_.between(1, 3));
  command((prm ? regs::kUserCommand1PrmVerdict : 0) | (cfg ? regs::kUserCommand1CfgVerdict : 0));
  host_.give();
}

void RandomUser::fetch() {
  constexpr int kBlocks[] = {regs::kOutput, regs::kPrm, regs::kCfg};
  const int base = random_.pick(kBlocks);
  host_.take();
  host_.read(regs::kChipCommand1);
  for (int i = random_.below(6); i > 0; --i) host_.read(base + i);
  host_.write(regs::kChipCommand1, random_.one_in(3) ? random_.below(8) : 0);
  if (random_.one_in(3)) host_.write(regs::kChipStatus2, random_.one_in(2) ? 0 : random_.byte());
  if (random_.one_in(8)) host_.write(regs::kChipStatus1, 0);
  host_.give();
}

void RandomUser::dpv1() { enable_dpv1(random_.one_in(3) ? random_.byte() : 0x1D); }

void RandomUser::enable_dpv1(int value) {
  host_.take();
  host_.write(regs::kDpv1Enable, value);
  host_.give();
}

void RandomUser::acyclic_answer(int channel) {
  const bool c1 = channel == 0;
  const auto function = setup_.function[channel];
  bus::Bytes bytes = {function, setup_.slot[channel], setup_.index[channel],
                      static_cast<std::uint8_t>(random_.one_in(16) ? random_.between(238, 243) : random_.below(6))};
  constexpr std::uint8_t kRead = 0x5E, kTransport = 0x51, kError = 0x80;
  const bool data = function == kRead || function == kTransport;
  if (random_.one_in(3)) {
    bytes = {static_cast<std::uint8_t>(function | kError), 0x80, random_.byte(), random_.byte()};
  } else if (data) {
    const bus::Bytes more = random_.bytes(bytes[3]);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  if (host_.mishap(8))
    bytes[static_cast<std::size_t>(random_.below(3))] ^= static_cast<std::uint8_t>(1 << random_.below(8));
  bytes.resize(std::min<std::size_t>(bytes.size(), regs::kC1Size));
  host_.take();
  host_.block(c1 ? regs::kC1 : regs::kC2, c1 ? regs::kC1Crc : regs::kC2Crc, bytes);
  host_.write(regs::kUserCommand2, c1 ? regs::kUserCommand2C1 : regs::kUserCommand2C2);
  if (random_.one_in(3)) host_.write(regs::kChipStatus2, 0);
  if (random_.one_in(2)) host_.write(regs::kChipCommand2, 0);
  host_.give();
}

/// Any cell, owned or not.
void RandomUser::poke() {
  const bool owned = !random_.one_in(3);
  if (owned) host_.take();
  for (int i = random_.between(1, 6); i > 0; --i) {
    const int address = random_.one_in(3) ? random_.below(0x800) : random_.between(0x005, 0x135);
    if (random_.one_in(2))
      host_.read(address);
    else
      host_.write(address, random_.byte());
  }
  if (owned) host_.give();
}

void RandomUser::long_hold() {
  host_.take();
  host_.wait(random_.between(40, 4000));
  host_.give();
}

void RandomUser::anything() {
  if (host_.own_traffic()) return;
  const int what = random_.below(20);
  if (what < 5) return inputs();
  if (what < 8) return fetch();
  if (what < 11) return diagnosis();
  if (what < 14) return verdict(random_.one_in(2), random_.one_in(2), !random_.one_in(3));
  if (what < 16) return poke();
  if (what < 17) return host_.rude();
  if (what < 18) return long_hold();
  if (what < 19) return dpv1();
  return host_.wait(random_.between(1, 3000));
}

void RandomUser::command(int value) {
  // Sometimes with other flags, whose blocks then have arbitrary content.
  host_.write(regs::kUserCommand1, host_.mishap(12) ? value | random_.byte() : value);
}

}  // namespace dsdpv1::cosim
