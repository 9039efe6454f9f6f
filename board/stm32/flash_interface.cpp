#include "board/stm32/flash_interface.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kAcr = FlashInterface::kAcr, kKeyr = 0x04, kOptkeyr = 0x08, kSr = 0x0C, kCr = 0x10, kAr = 0x14;

constexpr RegisterList kFlashRegisters = {  // CR cannot be written while it is locked
    {kAcr, "ACR", 0x30, 0x1F}, {kKeyr, "KEYR"}, {kOptkeyr, "OPTKEYR"},      {kSr, "SR"},
    {kCr, "CR", 0x80},         {kAr, "AR"},     {0x1C, "OBR", 0x03FF'FFFC}, {0x20, "WRPR", 0xFFFF'FFFF}};
constexpr TagList kFlashTags = {  // no programming
    {kAcr, 3, 1, "HLFCYA"}, {kKeyr, 0, 32, "FKEYR"}, {kOptkeyr, 0, 32, "OPTKEYR"},
    {kSr, 2, 1, "PGERR"},   {kSr, 4, 1, "WRPRTERR"}, {kSr, 5, 1, "EOP"},
    {kCr, 0, 1, "PG"},      {kCr, 1, 1, "PER"},      {kCr, 2, 1, "MER"},
    {kCr, 4, 1, "OPTPG"},   {kCr, 5, 1, "OPTER"},    {kCr, 6, 1, "STRT"},
    {kCr, 10, 1, "ERRIE"},  {kCr, 12, 1, "EOPIE"},   {kAr, 0, 32, "FAR"}};

}  // namespace

constexpr RegisterTable FlashInterface::kRegisters{kFlashRegisters, kFlashTags};

/// PRFTBS follows PRFTBE.
std::uint32_t FlashInterface::read(std::uint32_t offset) const {
  const std::uint32_t value = words_.read(offset);
  return offset == kAcr ? (value & ~(kPrftbe << 1U)) | (value & kPrftbe) << 1U : value;
}

}  // namespace dsdpv1::arm
