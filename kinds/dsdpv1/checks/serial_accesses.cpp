#include "kinds/dsdpv1/checks/serial_accesses.hpp"

namespace dsdpv1::checks {
namespace {

constexpr unsigned kErrorAnswer = 7, kFunctionError = 0x80;
constexpr std::size_t kCrcBytes = 2, kReplyHead = 2, kExchangeHead = 5;

/// UA10: the bit of a reply to inputs for each of kChipBlocks; outputs come without one.
constexpr std::array<std::uint8_t, kChipBlocks.size()> kNews = {0, 0x10, 0x20, 0x04, 0x08};

/// The block that such a reply carries; the chip has cleared its flag.
const Block& news_of(std::uint8_t function) {
  for (std::size_t i = 0; i < kNews.size(); ++i)
    if ((function & kNews.at(i)) != 0) return kChipBlocks.at(i);
  return kChipBlocks.front();
}

/// UA9: the area of an exchange with the flag that the chip sets.
const Block* posted(unsigned address) {
  for (const Block& block : kUserBlocks)
    if (block.first == address && block.flag != regs::kUserCommand1Init) return &block;
  return nullptr;
}

}  // namespace

void SerialAccesses::claimed(Tick at) {
  owned_ = true;
  duties_.hold_began(at);
}

void SerialAccesses::released(Tick at) {
  owned_ = false;
  duties_.hold_ended(at, HoldOf::kDpram);
}

/// A telegram without ownership is a hold of its own (SP14, SP16, UA6).
void SerialAccesses::replied(const HostTelegram& request, const HostReply& reply, Tick asked, Tick at) {
  asked_ = asked;
  at_ = at;
  if (owned_) return carry_out(request, reply);
  duties_.hold_began(asked);
  carry_out(request, reply);
  duties_.hold_ended(at, HoldOf::kTelegram);
}

void SerialAccesses::carry_out(const HostTelegram& request, const HostReply& reply) {
  const bus::Bytes& bytes = reply.bytes();
  if (request.is_exchange()) {
    if ((bytes[1] & kFunctionError) == 0) exchange(request, bytes);
    return;
  }
  if (bytes[0] >> 5U == kErrorAnswer) return;
  if (request.kind() == TelegramKind::kExchange) return read_and_write(bytes);
  if (request.kind() == TelegramKind::kRead)
    return access(false, request.address(), bytes.data() + kReplyHead, request.length());
  access(true, request.address(), request.bytes().data() + request.bytes().size() - kCrcBytes - request.length(),
         request.length());
}

void SerialAccesses::access(bool write, unsigned first, const std::uint8_t* bytes, unsigned count) {
  for (unsigned i = 0; i < count; ++i)
    duties_.accessed({write, static_cast<std::uint16_t>(first + i), bytes[i], asked_, at_});
}

/// SP16.
void SerialAccesses::read_and_write(const bus::Bytes& reply) {
  access(false, regs::kOutput, reply.data() + kReplyHead, static_cast<unsigned>(reply.size() - kReplyHead - kCrcBytes));
  duties_.announced(regs::kUserCommand1, regs::kUserCommand1Input);
  duties_.taken(regs::kChipCommand1, regs::kChipCommand1Output);
}

/// UA9 to UA12.
void SerialAccesses::exchange(const HostTelegram& request, const bus::Bytes& reply) {
  const Block* const block = posted(request.address());
  if (block == nullptr) return;
  access(true, block->first, request.bytes().data() + kExchangeHead, request.length());
  duties_.announced(block->command, block->flag);
  if (block->first != regs::kInput) return;
  duties_.told_news();
  const Block& news = news_of(reply[1]);
  access(false, news.first, reply.data() + kExchangeHead,
         static_cast<unsigned>(reply.size() - kExchangeHead - kCrcBytes));
  duties_.taken(news.command, news.flag);
}

}  // namespace dsdpv1::checks
