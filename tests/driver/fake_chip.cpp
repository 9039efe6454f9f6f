#include "tests/driver/fake_chip.hpp"

namespace dsdpv1 {
namespace {

std::uint16_t crc_of(const std::vector<std::uint8_t>& bytes) {
  return dsdpv1_crc(DSDPV1_CRC_START, bytes.data(), bytes.size());
}

FakeChip& self(void* ctx) { return *static_cast<FakeChip*>(ctx); }

}  // namespace

FakeChip::FakeChip() { at(0x004) = 0xC5; }

dsdpv1_port FakeChip::port() {
  dsdpv1_port port{};
  port.ctx = this;
  port.read = [](void* ctx, std::uint16_t address) {
    self(ctx).check_ownership("read");
    const std::uint8_t value = self(ctx).at(address);
    int& bad = self(ctx).bad_reads[address];
    return bad > 0 && bad-- > 0 ? static_cast<std::uint8_t>(value ^ 0xFF) : value;
  };
  port.write = [](void* ctx, std::uint16_t address, std::uint8_t value) {
    self(ctx).check_ownership("write");
    self(ctx).counted_ += address == 0x006 ? 1 : 0;
    self(ctx).user_writes(address, value);
  };
  port.set_r_req = [](void* ctx, bool level) { self(ctx).set_r_req(level); };
  port.set_r_sta = [](void* ctx, bool level) { self(ctx).set_r_sta(level); };
  port.get_l_req = [](void* ctx) { return self(ctx).l_req(); };
  port.get_l_sta = [](void* ctx) { return self(ctx).l_sta(); };
  port.pause = [](void* ctx, std::uint32_t) { ++self(ctx).pauses; };
  return port;
}

void FakeChip::check_ownership(const char* what) {
  ++accesses;
  if (!r_req_ || !r_sta_ || l_) violations.push_back(std::string(what) + " without ownership");
}

/// P6: only the chip sets bits of B00A, B00B, B00E and B00F.
void FakeChip::user_writes(std::uint16_t address, std::uint8_t value) {
  const bool chips = address == 0x00A || address == 0x00B || address == 0x00E || address == 0x00F;
  if (chips && (value & ~at(address)) != 0) violations.emplace_back("the user sets a bit of the chip");
  at(address) = value;
}

void FakeChip::set_r_req(bool level) {
  const bool fell = r_req_ && !level;
  r_req_ = level;
  free_samples_ = 0;
  if (on_r_req) on_r_req(level);
  if (fell) lowered();
}

void FakeChip::set_r_sta(bool level) {
  if (level && !r_req_) violations.emplace_back("R_STA rose without R_REQ");
  if (level && free_samples_ < 4) violations.emplace_back("R_STA rose after less than two looks at L_REQ and L_STA");
  if (level) {
    ++holds;
    counted_ = 0;
  } else if (r_sta_ && counted_ != 1) {
    violations.push_back("B006 was counted " + std::to_string(counted_) + " times in a hold");
  }
  const bool fell = r_sta_ && !level;
  r_sta_ = level;
  if (fell) lowered();
}

void FakeChip::lowered() {
  if (!r_req_ && !r_sta_) let_in();
}

void FakeChip::let_in() {
  if (before_access) before_access();
  access();
}

bool FakeChip::l_req() {
  l_ = busy_samples > 0 && busy_samples-- > 0;
  free_samples_ = l_ ? 0 : free_samples_ + 1;
  return l_;
}

bool FakeChip::l_sta() {
  free_samples_ = l_ ? 0 : free_samples_ + 1;
  return l_;
}

void FakeChip::access() {
  if (!present) return;
  at(0x006) = 1;
  at(0x004) = not_ready_accesses > 0 && not_ready_accesses-- > 0 ? 0 : 0xC5;
  if (takes_commands) {
    take_init();
    take_verdicts();
    take_clearing();
    take_inputs();
    take_diagnosis();
    take_answer(1);
    take_answer(2);
    at(0x010) = 0;
    at(0x011) = static_cast<std::uint8_t>(at(0x011) & 0x40);
  }
}

bool FakeChip::crc_is_right(std::uint16_t address, std::size_t count, std::uint16_t crc) const {
  if (!looks_at_crcs) return true;
  const auto stored = static_cast<std::uint16_t>(memory.at(crc) << 8 | memory.at(crc + 1U));
  return crc_of(bytes(address, count)) == stored;
}

void FakeChip::take_init() {
  if ((at(0x010) & 0x04) == 0 || refuses_silently) return;
  const bool right = crc_is_right(0x020, at(0x020) + 1U, 0x0F7);
  const bool in_limits = at(0x021) <= 126;
  at(0x00B) = static_cast<std::uint8_t>((at(0x00B) & ~0x01) | (right ? 0 : 1));
  at(0x013) = right && !in_limits ? 1 : 0;
  at(0x00A) = right && in_limits ? 1 : 0;
  initialisations += at(0x00A);
}

void FakeChip::take_verdicts() {
  std::string verdict;
  if ((at(0x010) & 0x80) != 0) verdict += (at(0x00C) & 1) != 0 ? "prm wrong" : "prm ok";
  if ((at(0x010) & 0x40) != 0) {
    verdict += verdict.empty() ? "" : ", ";
    verdict += (at(0x00C) & 2) != 0 ? "cfg wrong" : "cfg ok";
  }
  if (!verdict.empty()) verdicts.push_back(verdict);
}

void FakeChip::take_clearing() {
  if ((at(0x011) & 0xC0) == 0xC0) at(0x00B) = static_cast<std::uint8_t>(at(0x00B) & ~0x04);
}

void FakeChip::take_inputs() {
  if ((at(0x010) & 0x01) == 0) return;
  const bool right = crc_is_right(0x130, at(0x130) + 1U, 0x225);
  const bool history = (at(0x011) & 0x40) != 0;
  at(0x00B) = static_cast<std::uint8_t>((at(0x00B) & (history ? 0xFF : ~0x04)) | (right ? 0 : 4));
  if (right) inputs = bytes(0x131, at(0x130));
}

void FakeChip::take_diagnosis() {
  if ((at(0x010) & 0x02) == 0) return;
  const bool right = crc_is_right(0x227, at(0x228) + 2U, 0x317);
  at(0x00B) = static_cast<std::uint8_t>((at(0x00B) & ~0x08) | (right ? 0 : 8));
  if (right) diagnosis = bytes(0x227, at(0x228) + 2U);
}

void FakeChip::take_answer(int master_class) {
  if ((at(0x011) & master_class) == 0) return;
  ++answers_taken;
  const auto area = static_cast<std::uint16_t>(master_class == 1 ? 0x5D0 : 0x6D0);
  const bool data = at(area) == 0x5E || at(area) == 0x51;
  const std::size_t count = 4U + (data ? at(static_cast<std::uint16_t>(area + 3)) : 0U);
  const bool right = crc_is_right(area, count, static_cast<std::uint16_t>(area + 0xF4));
  const int bit = master_class == 1 ? 0x10 : 0x20;
  at(0x00B) = static_cast<std::uint8_t>((at(0x00B) & ~bit) | (right ? 0 : bit));
  if (right) answers[master_class - 1] = bytes(area, count);
}

std::vector<std::uint8_t> FakeChip::bytes(std::uint16_t address, std::size_t count) const {
  const auto first = memory.begin() + address;
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

void FakeChip::put_block(std::uint16_t address, const std::vector<std::uint8_t>& block, std::uint16_t crc,
                         std::uint8_t flag, std::uint16_t command) {
  for (std::size_t i = 0; i < block.size(); ++i) memory.at(address + i) = block[i];
  const std::uint16_t value = crc_of(block);
  at(crc) = static_cast<std::uint8_t>(value >> 8);
  at(static_cast<std::uint16_t>(crc + 1)) = static_cast<std::uint8_t>(value & 0xFF);
  at(command) = static_cast<std::uint8_t>(at(command) | flag);
}

void FakeChip::put_outputs(const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> block{static_cast<std::uint8_t>(data.size())};
  block.insert(block.end(), data.begin(), data.end());
  put_block(0x319, block, 0x40E, 0x01);
}

void FakeChip::put_prm(const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> block{static_cast<std::uint8_t>(data.size())};
  block.insert(block.end(), data.begin(), data.end());
  put_block(0x410, block, 0x4FE, 0x02);
}

void FakeChip::put_cfg(std::uint8_t outputs, std::uint8_t inputs_length, const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> block{outputs, inputs_length, static_cast<std::uint8_t>(data.size())};
  block.insert(block.end(), data.begin(), data.end());
  put_block(0x500, block, 0x5CB, 0x04);
}

void FakeChip::put_request(int master_class, const std::vector<std::uint8_t>& request) {
  const auto area = static_cast<std::uint16_t>(master_class == 1 ? 0x5D0 : 0x6D0);
  put_block(area, request, static_cast<std::uint16_t>(area + 0xF4), static_cast<std::uint8_t>(master_class), 0x00F);
}

}  // namespace dsdpv1
