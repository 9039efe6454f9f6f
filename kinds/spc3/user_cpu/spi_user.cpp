#include "kinds/spc3/user_cpu/spi_user.hpp"

#include <algorithm>

namespace dsdpv1::spc3_user {
namespace {

constexpr std::uint8_t kWriteArray = 0x02, kReadArray = 0x03, kWriteByte = 0x12, kReadByte = 0x13;
constexpr std::ptrdiff_t kHead = 3;

}  // namespace

SpiUser::Bytes SpiUser::frame(std::uint8_t instruction, std::uint16_t address, const Bytes& data) {
  Bytes out = {instruction, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address & 0xFF)};
  out.insert(out.end(), data.begin(), data.end());
  cpu_.enable_interrupts(false);
  master_->begin(cpu_.now(), out);
  cpu_.transfer(*master_);
  const Bytes in(master_->received().begin() + kHead, master_->received().end());
  cpu_.enable_interrupts(true);
  return in;
}

std::uint8_t SpiUser::read(std::uint16_t address) { return frame(kReadByte, address, {0}).front(); }

void SpiUser::write(std::uint16_t address, std::uint8_t value) { frame(kWriteByte, address, {value}); }

void SpiUser::read_array(std::uint16_t address, std::uint8_t* bytes, std::uint8_t length) {
  const Bytes in = frame(kReadArray, address, Bytes(length, 0));
  std::copy(in.begin(), in.end(), bytes);
}

void SpiUser::write_array(std::uint16_t address, const std::uint8_t* bytes, std::uint8_t length) {
  frame(kWriteArray, address, {bytes, bytes + length});
}

}  // namespace dsdpv1::spc3_user
