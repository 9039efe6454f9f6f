#include "kinds/dsdpv1/checks/serial_accesses.hpp"

namespace dsdpv1::checks {
namespace {

constexpr unsigned kErrorAnswer = 7, kFunctionError = 0x80;
constexpr std::size_t kCrcBytes = 2, kReplyHead = 2, kExchangeHead = 5;

/// UA10: what a reply to inputs carries, and the flag that the chip has cleared with it.
struct News {
  std::uint8_t function;
  Address first, command;
  std::uint8_t flag;
};
constexpr std::array<News, 4> kNews = {{{0x10, regs::kPrm, regs::kChipCommand1, regs::kChipCommand1Prm},
                                        {0x20, regs::kCfg, regs::kChipCommand1, regs::kChipCommand1Cfg},
                                        {0x04, regs::kC1, regs::kChipCommand2, regs::kChipCommand2C1},
                                        {0x08, regs::kC2, regs::kChipCommand2, regs::kChipCommand2C2}}};
constexpr News kOutputsCome = {0, regs::kOutput, regs::kChipCommand1, regs::kChipCommand1Output};

const News& news_of(std::uint8_t function) {
  for (const News& each : kNews)
    if ((function & each.function) != 0) return each;
  return kOutputsCome;
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
  const News& news = news_of(reply[1]);
  access(false, news.first, reply.data() + kExchangeHead,
         static_cast<unsigned>(reply.size() - kExchangeHead - kCrcBytes));
  duties_.taken(news.command, news.flag);
}

}  // namespace dsdpv1::checks
