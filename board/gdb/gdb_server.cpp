#include "board/gdb/gdb_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::arm {
namespace {

constexpr int kLookMs = 100;  // real time between two looks at `stopped` while the processor is halted

// Stop replies: signals by gdb's numbers, and the one thread.
constexpr const char* kInterrupted = "T02thread:1;";              // SIGINT
constexpr const char* kTrapped = "T05thread:1;";                  // SIGTRAP
constexpr const char* kFaulted = "T0bthread:1;";                  // SIGSEGV
constexpr const char* kAtBegin = "T05thread:1;replaylog:begin;";  // there is nothing further back
constexpr const char* kRunHasEnded = "W00";

/// A processor asks wanted() every 250 ns, which are far fewer instructions.
constexpr std::uint64_t kAhead = 1024;

std::string watch_reply(const Watchpoint& point) {
  const char* const name = point.kind == Watchpoint::Kind::kWrite  ? "watch"
                           : point.kind == Watchpoint::Kind::kRead ? "rwatch"
                                                                   : "awatch";
  return fmt::format("{}{}:{:x};", kTrapped, name, point.address);
}

}  // namespace

GdbServer::GdbServer(DebugTarget& target, GdbOptions options)
    : target_(target), options_(std::move(options)), commands_(target, options_.history != nullptr) {
  if (options_.history != nullptr && options_.history->live_from == 0) commands_.set_program(options_.program_now);
  commands_.set_stop_reply(kTrapped);
  if (travels())
    take_over();
  else
    link_ = std::make_shared<GdbLink>(options_.port, options_.say);
}

GdbServer::~GdbServer() {
  if (attached_ && link_->connected()) link_->send(kRunHasEnded);
}

void GdbServer::data_access(std::uint32_t address, std::uint32_t size, bool write) {
  if (travels()) {
    const auto met = commands_.watchpoints().met_by(address, size, write);
    if (met && options_.history->journey->searches) found_ = {2 * target_.instructions(), watch_reply(*met)};
    return;
  }
  if (!watch_hit_.empty() || over_) return;
  const auto point = commands_.watchpoints().met_by(address, size, write);
  if (!point) return;
  watch_hit_ = watch_reply(*point);
  due_ = true;
}

void GdbServer::consider(std::uint32_t pc) {
  const bool look = until_look_ == 0;
  if (look) until_look_ = kInstructionsPerLook;
  if (over_ || resumed_here(pc) || !halt_if_due(pc, look)) return;
  // With another pc the processor comes again, for the instruction that has been let go already.
  if (target_.read_register(Register::kPc) != pc) expect_call_again();
}

bool GdbServer::halt_if_due(std::uint32_t pc, bool look) {
  if (const auto reply = reason_to_stop(pc)) {
    stop(*reply);
    return true;
  }
  return (waiting_ || look) && halt_if_gdb_wants();
}

/// True: the run was resumed at this instruction and has not executed it yet.
bool GdbServer::resumed_here(std::uint32_t pc) {
  if (awaited_) resumed_at_.reset();
  if (!resumed_at_) return false;
  due_ = stepping_;
  return *std::exchange(resumed_at_, std::nullopt) == pc;
}

/// The run was resumed at an instruction for which before_instruction() has not been called yet: it must not stop there
/// again.
void GdbServer::expect_call_again() {
  if (!wanted()) return;
  resumed_at_ = target_.read_register(Register::kPc);
  due_ = true;
}

std::optional<std::string> GdbServer::reason_to_stop(std::uint32_t pc) const {
  if (awaited_) return kTrapped;
  if (!watch_hit_.empty()) return watch_hit_;
  if (commands_.breakpoints().at(pc)) return kTrapped;
  if (stepping_ && !commands_.step_range().holds(pc)) return kTrapped;
  return std::nullopt;
}

void GdbServer::wait_for_gdb() {
  options_.say(fmt::format("waiting for gdb: target remote localhost:{}", port()));
  while (!link_->connected() && !options_.stopped()) link_->look(kLookMs);
  converse();
}

void GdbServer::stop(const std::string& reply) {
  commands_.set_stop_reply(reply);
  link_->send(std::exchange(awaited_, std::nullopt).value_or(reply));
  converse();
}

void GdbServer::converse() {
  attached_ = attached_ || link_->connected();
  if (options_.history != nullptr && !options_.history->begin) options_.history->begin = place();
  waiting_ = stepping_ = due_ = false;
  watch_hit_.clear();
  while (!options_.stopped()) {
    if (!link_->connected()) return let_go();
    if (const auto input = link_->next()) {
      // Ctrl-C that came too late: the processor is halted already.
      if (input->kind == GdbInput::Kind::kPacket && carry_out(input->packet)) return;
    } else {
      link_->look(kLookMs);
    }
  }
  end();
}

/// Returns whether the processor continues.
bool GdbServer::carry_out(const std::string& packet) {
  const GdbCommands::Result result = commands_.execute(packet);
  if (!result.refused.empty()) options_.say(result.refused);
  if (result.resumption == Resumption::kBeginAgain) {
    begin_again();
    return true;
  }
  if (result.resumption == Resumption::kReset) {
    awaited_ = result.reply.value_or(kTrapped);
    return due_ = true;
  }
  if (result.reply) link_->send(*result.reply);
  if (result.stop_acknowledging) link_->stop_acknowledging();
  if (result.resumption == Resumption::kStepBack || result.resumption == Resumption::kContinueBack)
    return go_back(result.resumption == Resumption::kContinueBack);
  resume(result.resumption);
  return result.resumption != Resumption::kNone;
}

void GdbServer::resume(Resumption how) {
  switch (how) {
    case Resumption::kNone:
    case Resumption::kStepBack:
    case Resumption::kContinueBack:
    case Resumption::kReset:
    case Resumption::kBeginAgain:
    case Resumption::kContinue: break;
    case Resumption::kStep: stepping_ = due_ = true; break;
    case Resumption::kDetach:
      attached_ = false;
      let_go();
      break;
    case Resumption::kKill:
      end();
      target_.end_run();
      break;
  }
}

void GdbServer::end() {
  over_ = true;
  attached_ = false;
  let_go();
}

void GdbServer::let_go() {
  const bool killed = commands_.killed();
  if (std::exchange(attached_, false) && !killed) options_.say("gdb has gone without `detach`: the run goes on");
  link_->close();
  commands_.forget_stops();
  if (killed) {
    over_ = true;
    target_.end_run();
  }
  watch_hit_.clear();
  stepping_ = due_ = false;
}

void GdbServer::poll() {
  if (travels()) return travel(std::nullopt);
  if (!over_ && halt_if_gdb_wants()) expect_call_again();
}

// ------------------------------------------------------------------------------------------------- going back

void GdbServer::take_over() {
  const auto session = std::static_pointer_cast<Session>(options_.history->connection);
  link_ = session->link;
  commands_.set_stops(session->stops);
  commands_.set_extended(session->extended);
  awaited_ = session->awaited;
  waiting_ = due_ = false;
  attached_ = true;
}

/// Returns whether the processor continues: not at the very beginning.
bool GdbServer::go_back(bool as_far_as_something_stops) {
  const std::uint64_t here = place(), begin = *options_.history->begin;
  if (here <= begin) {
    commands_.set_stop_reply(kAtBegin);
    link_->send(kAtBegin);
    return false;
  }
  const std::uint64_t before = here % 2 != 0 ? here - 1 : here - 2;
  const bool nothing_stops = commands_.breakpoints().empty() && commands_.watchpoints().empty();
  user_cpu::Journey journey{options_.board, std::max(before, begin), here, false, kTrapped};
  if (as_far_as_something_stops && nothing_stops) journey.until = begin, journey.reply = kAtBegin;
  if (as_far_as_something_stops && !nothing_stops) journey.until = here, journey.searches = true;
  depart(std::move(journey));
  return true;
}

/// This run ends; its owner begins it again.
void GdbServer::depart(user_cpu::Journey journey) {
  options_.history->connection =
      std::make_shared<Session>(Session{link_, commands_.stops(), commands_.extended(), awaited_});
  options_.history->back = std::move(journey);
  options_.history->journey.reset();
  over_ = true;
  attached_ = stepping_ = due_ = false;
  target_.end_run();
}

/// gdb has loaded the program that the run's file has now: from power-on, and without what gdb has changed before.
void GdbServer::begin_again() {
  options_.say("load: another program, the run begins again");
  options_.history->inputs.clear();
  awaited_ = "OK";
  depart({0, *options_.history->begin, place(), false, kTrapped});
}

bool GdbServer::nears_end() const {
  const user_cpu::Journey& journey = *options_.history->journey;
  return journey.searches || place() + 2 * kAhead >= journey.until;
}

/// `pc`: address of the next instruction; absent while the processor sleeps, and in poll().
void GdbServer::travel(std::optional<std::uint32_t> pc) {
  const user_cpu::Journey& journey = *options_.history->journey;
  if (place() >= journey.until) return end_journey();
  if (journey.searches && pc && commands_.breakpoints().at(*pc)) found_ = {place(), kTrapped};
}

void GdbServer::end_journey() {
  user_cpu::Journey journey = *options_.history->journey;
  const std::uint64_t begin = *options_.history->begin;
  if (journey.searches) {
    if (!found_) found_ = {begin, kAtBegin};
    return depart({journey.board, found_->place, journey.until, false, found_->reply});
  }
  if (place() >= journey.limit && journey.until > begin) {  // the place before was passed without a call
    journey.until = std::max(journey.until - 2, begin);
    return depart(std::move(journey));
  }
  options_.history->journey.reset();
  const std::uint32_t pc = target_.read_register(Register::kPc);
  stop(journey.reply);
  if (target_.read_register(Register::kPc) != pc) expect_call_again();
}

/// Returns whether the processor was halted, and has been resumed.
bool GdbServer::halt_if_gdb_wants() {
  if (waiting_) {
    wait_for_gdb();
    return true;
  }
  link_->look(0);
  if (!link_->connected()) {
    if (attached_) let_go();
    return false;
  }
  if (!attached_) {
    commands_.set_stop_reply(kTrapped);
    converse();
    return true;
  }
  while (const auto input = link_->next()) {
    if (input->kind != GdbInput::Kind::kInterrupt) continue;
    stop(kInterrupted);
    return true;
  }
  return false;
}

void GdbServer::fault(const std::string& what) {
  poll();
  if (!attached_ || over_) return;
  link_->send("O" + to_hex(what + "\n"));
  stop(kFaulted);
}

}  // namespace dsdpv1::arm
