#include "model/spc3/control_buffers.hpp"

#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

constexpr std::array<Block, 3> kBlocks = {Block::kPrm, Block::kCfg, Block::kSsa};

struct BlockRow {
  Address length, pointer;
  std::uint16_t event;
};
// In the order of Block.
constexpr BlockRow kRows[] = {{regs::kOrgPrmLength, regs::kOrgPrmPointer, regs::kEventNewPrm},
                              {regs::kOrgCfgLength, regs::kOrgCfgPointer, regs::kEventNewCfg},
                              {regs::kOrgSsaLength, regs::kOrgSsaPointer, regs::kEventNewSsa}};

constexpr unsigned number(Block block) { return static_cast<unsigned>(block); }
constexpr const BlockRow& row_of(Block block) { return kRows[number(block)]; }

}  // namespace

// 0 or 1: R_Aux_Puf_Sel has a bit for each kind.
int ControlBuffers::aux_of(Block block) const { return ram_.cell(regs::kOrgAuxSelect) >> number(block) & 1; }

// A37, A23: no second one. A57: no other kind's Aux, but a Check_Cfg gives way to a Set_Prm, which drops it (A53).
bool ControlBuffers::is_held(Block block, bool spec) const {
  if ((spec || block == Block::kSsa) && pending(block)) return true;
  for (const Block each : kBlocks) {
    const bool gives_way = each == block || (each == Block::kCfg && block == Block::kPrm);
    if (!gives_way && of(each).waits && aux_of(each) == aux_of(block)) return true;
  }
  return false;
}

bool ControlBuffers::has_room(Cycle now, Block block, int size, bool spec) {
  const int aux = aux_of(block);
  const auto refuse = [&](const profibus::Reason& reason, unsigned a, unsigned b) {
    log_.at_cycle(now, reason, a, b, number(block));
    return false;
  };
  const auto pointer = static_cast<Address>(regs::kOrgAuxPointer + aux);
  const int length = ram_.cell(spec ? regs::kOrgSpecPrmLength : static_cast<Address>(regs::kOrgAuxLength + aux));
  if (size > length) return refuse(Reason::kNoRoom, static_cast<unsigned>(size), static_cast<unsigned>(length));
  for (const Address needed : {spec ? row_of(block).pointer : pointer, row_of(block).pointer})
    if (ram_.cell(needed) == 0) return refuse(Reason::kNoPointer, needed, 0);
  return is_held(block, spec) ? refuse(Reason::kBufferHeld, static_cast<unsigned>(aux) + 1, spec) : true;
}

void ControlBuffers::receive(Cycle now, Block block, const profibus::Request& request, bool spec) {
  Entry& entry = of(block);
  const auto pointer = spec ? row_of(block).pointer : static_cast<Address>(regs::kOrgAuxPointer + aux_of(block));
  const int begin = ram_.buffer(pointer);
  for (int i = 0; i < request.size; ++i) ram_.write(begin + i, request.data[i]);
  entry.size = static_cast<std::uint8_t>(request.size);
  entry.is_there = spec;
  if (entry.state == State::kFree) {
    entry.state = State::kOnWay;
    log_.at_cycle(now, Reason::kToUser, number(block), request.sa, static_cast<unsigned>(request.size));
    return;
  }
  log_.at_cycle(now, Reason::kWaitsInAux, number(block), static_cast<unsigned>(request.size), entry.waits);
  entry.waits = true;
}

void ControlBuffers::exchange(Block block) {
  const Entry& entry = of(block);
  if (!entry.is_there)
    ram_.swap_cells(row_of(block).pointer, static_cast<Address>(regs::kOrgAuxPointer + aux_of(block)));
  ram_.set_cell(row_of(block).length, entry.size);
}

std::uint16_t ControlBuffers::deliver() {
  std::uint16_t events = 0;
  for (const Block each : kBlocks) {
    if (of(each).state != State::kOnWay) continue;
    exchange(each);
    of(each).state = State::kWithUser;
    events = static_cast<std::uint16_t>(events | row_of(each).event);
  }
  return events;
}

bool ControlBuffers::next(Block block) {
  Entry& entry = of(block);
  if (!entry.waits) {
    entry.state = State::kFree;
    return false;
  }
  entry.waits = false;
  exchange(block);
  return true;
}

}  // namespace dsdpv1::spc3
