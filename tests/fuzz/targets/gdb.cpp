// Bytes from a gdb, in pieces as delivered by a network, to a halted processor.
#include "board/gdb/gdb_commands.hpp"
#include "tests/board/fake_target.hpp"
#include "tests/board/small_elf.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

const arm::ElfImage& firmware() {
  static const arm::ElfImage image = arm::parse_elf(arm::test::SmallElf().bytes(), "small.elf");
  return image;
}

/// A reply arrives as it was sent.
void check_frame(const std::string& reply) {
  arm::GdbReader reader;
  reader.take(arm::gdb_frame(reply));
  const std::optional<arm::GdbInput> back = reader.next();
  fuzz::promise(back && back->kind == arm::GdbInput::Kind::kPacket && back->packet == reply, "a reply is one packet");
}

void execute(arm::GdbCommands& commands, const std::string& packet) {
  const arm::GdbCommands::Result result = commands.execute(packet);
  if (result.reply) check_frame(*result.reply);
  const arm::Resumption how = result.resumption;
  if (how == arm::Resumption::kContinue || how == arm::Resumption::kStep) {
    fuzz::promise(!result.reply, "what resumes is answered when it stops");
    commands.set_stop_reply("S05");
  }
  if (how == arm::Resumption::kDetach) commands.forget_stops();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  arm::test::FakeTarget target(firmware());
  arm::GdbCommands commands(target);
  commands.set_stop_reply("S05");
  arm::GdbReader reader;
  while (!input.empty()) {
    reader.take(input.text(1 + std::size_t{input.byte()}));
    while (const std::optional<arm::GdbInput> next = reader.next())
      if (next->kind == arm::GdbInput::Kind::kPacket) execute(commands, next->packet);
  }
  return 0;
}

}  // namespace dsdpv1
