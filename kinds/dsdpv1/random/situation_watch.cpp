#include "kinds/dsdpv1/random/situation_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "bus/telegram/telegram.hpp"
#include "kinds/dsdpv1/random/chip_blocks.hpp"
#include "kinds/dsdpv1/random/situations.hpp"
#include "model/profibus/request.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr unsigned kOffline = 0, kDataExch = 3;

std::string service_of(const bus::Telegram& request) {
  namespace fc = profibus::fc;
  const unsigned function = request.function();
  if (function == fc::kFdlStatus) return "FDL status";
  if (function != fc::kSrdLow && function != fc::kSrdHigh) return "another function";
  if (!request.dsap) return "Data_Exchange";
  switch (*request.dsap) {
    case 47:
    case 48: return "C2";
    case bus::sap::kMs2Rm: return "Initiate";
    case bus::sap::kMs1: return "C1";
    case bus::sap::kSetSlaveAddress: return "Set_Slave_Add";
    case bus::sap::kReadInputs: return "RD_Inp";
    case bus::sap::kReadOutputs: return "RD_Outp";
    case bus::sap::kGlobalControl: return "SRD to SAP 58";
    case bus::sap::kGetCfg: return "Get_Cfg";
    case bus::sap::kSlaveDiag: return "Slave_Diag";
    case bus::sap::kSetPrm: return "Set_Prm";
    case bus::sap::kChkCfg: return "Chk_Cfg";
    default: return "another SAP";
  }
}

const char* answer_of(const bus::Telegram& answer) {
  namespace fc = profibus::fc;
  if (answer.kind == bus::TelegramKind::kSc) return "SC";
  const bool data = answer.kind != bus::TelegramKind::kSd1;
  switch (answer.function()) {
    case fc::kOk: return "OK";
    case fc::kRr: return "RR";
    case fc::kRs: return "RS";
    case fc::kDh: return data ? "data of high priority" : "high priority";
    default: return "data";
  }
}

}  // namespace

void SituationWatch::begins(const tb::PinDevice& both) {
  model_ = &both;
  rulings_.begins(both);
  for (int pin = 0; pin < pin_count(chip_.part); ++pin)
    levels_.at(static_cast<std::size_t>(pin)) = both.level(static_cast<PinNumber>(pin));
}

// --- pins ------------------------------------------------------------------------------------------------------------

void SituationWatch::pin(Tick at, Side side, PinNumber pin, Level level) {
  if (side == Side::kRtl) return;
  if (reader_ && (reader_->pins() & tb::mask_of(pin)) != 0) {
    reader_->run(at);
    reader_->pin(at, pin, level);
  }
  levels_.at(pin) = level;
  if (side == Side::kInput) input_changed(at, static_cast<Pin>(pin), level);
}

std::string SituationWatch::phase() const { return model_->works_on(); }

void SituationWatch::input_changed(Tick at, Pin pin, Level level) {
  const bool parallel = chip_.mode == HostMode::kParallel;
  if (pin == Pin::kReset && level == 0) {
    situations_.count("RESET falls in", phase());
    state_ = kOffline;
    sync_ = freeze_ = false;
    service_.clear();
    reader_.reset();
    rulings_.reset();
  } else if (pin == Pin::kReset) {
    released(at);
  } else if (parallel && pin == Pin::kRReq && level != 0) {
    situations_.count("R_REQ rises in", phase());
  } else if (chip_.mode == HostMode::kSpi && pin == Pin::kXss && level == 0) {
    situations_.count("XSS falls in", phase());
  } else if (chip_.mode == HostMode::kUart && pin == Pin::kRxd && level == 0) {
    situations_.count("RXD falls in", phase());
  } else if (parallel && (pin == Pin::kRd || pin == Pin::kWr) && level == 0 && this->level(Pin::kCsr) == 0) {
    access_begins(pin == Pin::kWr);
  } else if (parallel && pin == Pin::kWr && level != 0) {
    write_ends();
  }
}

void SituationWatch::write_ends() {
  const bool owned = level(Pin::kRReq) != 0 && level(Pin::kRSta) != 0 && level(Pin::kLSta) == 0;
  if (owned && level(Pin::kCsr) == 0) rulings_.written(level(Pin::kA));
}

void SituationWatch::access_begins(bool write) {
  const bool req = level(Pin::kRReq) != 0, sta = level(Pin::kRSta) != 0;
  const char* owner = req && sta ? "owned" : req ? "R_REQ alone" : sta ? "R_STA alone" : "not owned";
  situations_.count("accesses of the user",
                    fmt::format("{}, {}, {}", write ? "write" : "read", owner,
                                level(Pin::kLSta) != 0 ? "the chip in an access" : "the chip away"));
  if (!write && req && sta) cell_read(level(Pin::kA));
}

/// The block on which the chip's access has worked so far waits for the user.
void SituationWatch::block_written() {
  for (std::size_t i = 0; i < kChipBlocks.size(); ++i) {
    const ChipBlock& block = kChipBlocks.at(i);
    if (item_ == nullptr || std::strcmp(item_, item_of(block.part)) != 0) continue;
    const auto wait = [&](int first, int count, std::size_t cells) {
      const auto begin = unread_.begin() + first;
      std::fill(begin, begin + count, static_cast<std::uint8_t>(1 + i * std::size(kBlockCells) + cells));
    };
    wait(block.base, block.header, 0);
    wait(block.base + block.header, data_of(block, *model_), 1);
    wait(block.crc, 2, 2);
    wait(block.flag, 1, 3);
  }
}

void SituationWatch::cell_read(int address) {
  rulings_.read(address);
  const unsigned what = std::exchange(unread_.at(static_cast<std::size_t>(address)), std::uint8_t{0});
  if (what == 0) return;
  const ChipBlock& block = kChipBlocks.at((what - 1) / std::size(kBlockCells));
  situations_.count("written and read",
                    fmt::format("{}, {}", item_of(block.part), kBlockCells[(what - 1) % std::size(kBlockCells)]));
}

/// The straps are in force.
void SituationWatch::released(Tick at) {
  if (chip_.mode == HostMode::kParallel) return;
  tb::Dsdpv1Settings settings = chip_;
  settings.address = level(Pin::kAdr);
  settings.uart_rate = level(Pin::kUbr);
  settings.interval = level(Pin::kUiv);
  reader_ = tb::host_reader_of(settings);
  reader_->on_telegram = [this](const tb::HostTelegram& telegram) { host_telegram(telegram); };
  reader_->run(at);
}

void SituationWatch::evaluated(Tick /*now*/, tb::PinDevice& model) {
  const char* item = model.works_on();
  if (item == item_) return;
  block_written();
  if (item_ != nullptr) rulings_.block_written(item_);
  item_ = item;
  rulings_.works_on(item);
  if (std::strcmp(item, "-") != 0) situations_.count("transfers", item);
}

// --- events ----------------------------------------------------------------------------------------------------------

void SituationWatch::event(const profibus::Event& event) {
  using profibus::Reason;
  rulings_.event(event);
  if (event.reason == Reason::kDpState) {
    situations_.count("DP states", fmt::format("{} to {}", dp_state_name(event.a), dp_state_name(event.b)));
    state_ = event.b;
    if (event.a == kDataExch) sync_ = freeze_ = false;
    return;
  }
  situations_.count("events", event_item(event, dp_state_name(state_)));
  if (event.reason == Reason::kGlobalControl) global_control(event.a);
  if (event.reason == Reason::kGcSync) sync_ = false;
  if (event.reason == Reason::kGcFreeze) freeze_ = false;
  if (event.reason == Reason::kFcbNotToggled) service_.clear();  // the answer is another service's (S26)
}

/// S24, S4, S27. A later event refuses what Set_Prm has not requested.
void SituationWatch::global_control(unsigned command) {
  namespace gc = bus::global_control;
  const char* held = sync_ && freeze_ ? "Sync and Freeze" : sync_ ? "Sync" : freeze_ ? "Freeze" : "nothing held";
  const unsigned outputs = (command & gc::kUnsync) != 0 ? unsigned{gc::kUnsync} : command & gc::kSync;
  const unsigned inputs = (command & gc::kUnfreeze) != 0 ? unsigned{gc::kUnfreeze} : command & gc::kFreeze;
  std::string what = outputs == gc::kUnsync ? "Unsync" : outputs != 0 ? "Sync" : "";
  if (inputs != 0)
    what += fmt::format("{}{}", what.empty() ? "" : " and ", inputs == gc::kUnfreeze ? "Unfreeze" : "Freeze");
  if (!what.empty()) situations_.count("Sync and Freeze", fmt::format("{}: {}", held, what));
  if ((command & gc::kClearData) != 0) situations_.count("Sync and Freeze", fmt::format("{}: Clear_Data", held));
  if (outputs != 0) sync_ = outputs == gc::kSync;
  if (inputs != 0) freeze_ = inputs == gc::kFreeze;
}

// --- telegrams -------------------------------------------------------------------------------------------------------

void SituationWatch::telegram(Tick /*now*/, const bus::WireTelegram& telegram) {
  const bool asked = !service_.empty();
  const std::string service = std::exchange(service_, {});
  if (!telegram.right()) return;
  const bus::Telegram& decoded = telegram.decoded.telegram;
  if (decoded.is_request() && decoded.wants_answer() && decoded.da == model_->address() && state_ != kOffline) {
    rulings_.request(decoded);
    service_ = fmt::format("{} in {}", service_of(decoded), dp_state_name(state_));
  }
  if (!asked || !telegram.tsdr || !decoded.is_response()) return;
  situations_.count("services", fmt::format("{}: {}", service, answer_of(decoded)));
  rulings_.answer(decoded);
}

void SituationWatch::host_telegram(const tb::HostTelegram& telegram) {
  if (!telegram.reply) {
    request_ = telegram.bytes;
    return;
  }
  if (telegram.wrong.empty()) host_reply(telegram.bytes);
}

/// SP4, SP10, UA8, UA13.
void SituationWatch::host_reply(const bus::Bytes& bytes) {
  constexpr unsigned kExchange = 2, kErrorReply = 7, kErrorFunction = 0x80;
  const unsigned command = request_.empty() ? 0 : request_[0] >> 5U;
  const bool exchange = chip_.mode == HostMode::kUart && command == kExchange;
  const char* third = exchange ? "exchange" : "read and write";
  const char* kind = command == 0 ? "read" : command == 1 ? "write" : third;
  if (bytes.size() < 3) return;
  const bool error = exchange ? (bytes[1] & kErrorFunction) != 0 : bytes[0] >> 5U == kErrorReply;
  const unsigned code = !error ? 0U : bytes[exchange ? 2 : 1];
  const bool refused = error && code == 0;
  situations_.count("telegrams of the host",
                    refused ? fmt::format("{}, refused", kind) : fmt::format("{}, code {:02X}", kind, code));
  if (exchange && !error) exchange_reply(bytes[1]);
  if (command > 1 || error || request_.size() <= 3) return;
  for (int i = 0, first = request_[1] << 8 | request_[2]; i < request_[3]; ++i)
    command == 0 ? cell_read(first + i) : rulings_.written(first + i);
}

void SituationWatch::exchange_reply(unsigned function) {
  const char* news = (function & 0x10) != 0   ? "parameters"
                     : (function & 0x20) != 0 ? "configuration"
                     : (function & 0x04) != 0 ? "C1"
                     : (function & 0x08) != 0 ? "C2"
                                              : "outputs";
  situations_.count("replies of exchanges", fmt::format("{}{}", news, (function & 1) != 0 ? " in DATA_EXCH" : ""));
}

}  // namespace dsdpv1::cosim
