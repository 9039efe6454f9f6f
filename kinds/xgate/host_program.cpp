#include "kinds/xgate/host_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <vector>

#include "driver/xgate/xgate.h"
#include "kinds/dsdpv1/user_cpu/acyclic_server.hpp"
#include "kinds/xgate/host_line.hpp"
#include "model/profibus/cfg_identifier.hpp"

namespace dsdpv1::xgate {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::uint8_t kBusErrors = 3;  // table 4.13: no data exchange yet

user_cpu::AcyclicOptions at_once(user_cpu::AcyclicOptions options) {
  options.delay = 0;
  return options;
}

class HostProgram {
 public:
  explicit HostProgram(kit::Cpu& cpu)
      : cpu_(cpu),
        own_(user_settings_of(cpu.settings())),
        chip_(chip_settings_of(cpu.chip_settings())),
        line_(cpu),
        server_(at_once(cpu.acyclic())) {
    const xgate_port port = {this, &send, &receive};
    const xgate_application application = {this, nullptr, &request, nullptr};
    xgate_open(&host_, &port, &application);
    xgate_settings& settings = host_.settings;
    settings.printed_errors = own_.printed_errors.value_or(chip_.errors == ErrorForm::kPrinted);
    settings.short_mailboxes = own_.short_mailboxes.value_or(chip_.mailboxes == MailboxForm::kShort);
    settings.repetitions = static_cast<std::uint8_t>(own_.repetitions);
    settings.answer_ms = static_cast<std::uint16_t>(own_.answer_ms);
    settings.byte_ms = static_cast<std::uint16_t>(own_.byte_ms);
  }

  /// The firmware of the module needs its time before it hears anything.
  void run() {
    cpu_.wait(own_.reset_wait.value_or(chip_.power_time + bus::kTicksPerMs));
    initialise();
    for (Tick turn = cpu_.now();; turn = std::max(turn + cpu_.period(), cpu_.now())) {
      cpu_.wait_until(turn);
      exchange();
      diagnose();
    }
  }

 private:
  void initialise() {
    const xgate_config config = given();
    while (check(xgate_initialise(&host_, &config)) != XGATE_OK) cpu_.wait(own_.retry);
    cpu_.initialised();
  }

  /// Command 04 (4.2).
  xgate_config given() {
    const user_cpu::StationConfig& station = cpu_.station();
    xgate_config config{};
    config.address = station.address;
    config.ident = station.ident;
    learn(station.cfg.data(), station.cfg.size());
    config.inputs = inputs_;
    config.outputs = outputs_;
    config.user_parameters = static_cast<std::uint8_t>(own_.user_parameters);
    put_dpv1(config.dpv1);
    if (own_.any_cfg) return config;
    std::copy(station.cfg.begin(), station.cfg.end(), config.cfg);
    config.cfg_length = static_cast<std::uint8_t>(station.cfg.size());
    return config;
  }

  /// 4.2.2.
  void put_dpv1(std::uint8_t* bytes) const {
    const user_cpu::StationConfig& station = cpu_.station();
    const auto flag = [](bool on, unsigned bit) { return on ? bit : 0U; };
    bytes[0] = cpu_.acyclic().any() ? 1 : 0;
    bytes[6] = static_cast<std::uint8_t>(own_.c2_timeout);
    bytes[7] = static_cast<std::uint8_t>(own_.c1_length);
    bytes[8] = static_cast<std::uint8_t>(own_.c2_length);
    bytes[9] = static_cast<std::uint8_t>(flag(station.dpv1, 0x80) | flag(station.fail_safe, 0x02) |
                                         flag(own_.check_cfg_mode, 0x01));
    bytes[10] = static_cast<std::uint8_t>(own_.alarm_types);
    bytes[11] = static_cast<std::uint8_t>(own_.open_alarms);
  }

  void learn(const std::uint8_t* cfg, std::size_t size) {
    const profibus::CfgLengths lengths = profibus::cfg_lengths(cfg, static_cast<int>(size));
    inputs_ = static_cast<std::uint8_t>(lengths.input());
    outputs_ = static_cast<std::uint8_t>(lengths.output());
  }

  void exchange() {
    const Bytes inputs = cpu_.inputs(inputs_);
    Bytes outputs(XGATE_MAX_DATA);
    std::uint8_t length = 0;
    const xgate_result result = check(xgate_exchange(&host_, inputs.data(), static_cast<std::uint8_t>(inputs.size()),
                                                     outputs.data(), XGATE_MAX_DATA, &length));
    if (own_.any_cfg && waits_for_master(result) && xgate_read_cfg(&host_) == XGATE_OK)
      learn(host_.answer.data, host_.answer.length);
    if (result != XGATE_OK) return;
    outputs.resize(length);
    cpu_.received(std::move(outputs));
    cpu_.written();
  }

  void diagnose() {
    const std::optional<kit::Diagnosis> wanted = cpu_.diagnosis();
    if (wanted) check(xgate_diagnose(&host_, wanted->bytes.data(), static_cast<std::uint8_t>(wanted->bytes.size())));
  }

  bool waits_for_master(xgate_result result) const {
    return result == XGATE_ERR_MODULE && host_.error_class == kBusErrors;
  }

  /// Tells an error, but not that there is no data exchange yet.
  xgate_result check(xgate_result result) {
    if (result == XGATE_OK || waits_for_master(result)) return result;
    const auto& code = *std::find_if(program_codes().codes.begin(), program_codes().codes.end(),
                                     [&](const tb::CodeText& each) { return each.code == code_of(result); });
    cpu_.failed(code.code, result == XGATE_ERR_MODULE
                               ? fmt::format("command {:02X}: the module's error {}/{}", host_.command.command,
                                             host_.error_class, host_.error_code)
                               : fmt::format("command {:02X}: {}", host_.command.command, code.text));
    return result;
  }
  static const char* code_of(xgate_result result) {
    switch (result) {
      case XGATE_ERR_SILENT: return "XGATE_ERR_SILENT";
      case XGATE_ERR_ANSWER: return "XGATE_ERR_ANSWER";
      case XGATE_ERR_MODULE: return "XGATE_ERR_MODULE";
      default: return "XGATE_ERR_ARGUMENT";
    }
  }

  // --- requests of C1 and C2 ---------------------------------------------------------------------------------------
  struct Open {
    Bytes pdu;
    Tick since = 0;
  };

  /// The length of the answer; 0: not yet.
  std::uint8_t serve(const Bytes& pdu, std::uint8_t* to) {
    const unsigned area = xgate_request_id(&host_) == chip_.c2_id ? 2 : 1;
    Open& open = open_[area - 1];
    if (open.pdu != pdu) open = {pdu, cpu_.now()};
    if (cpu_.now() < open.since + cpu_.acyclic().delay) return 0;
    server_.set_answering(cpu_.acyclic().answering);
    const std::optional<Bytes> answer = server_.answer(area, pdu);
    if (!answer) return 0;
    open.pdu.clear();
    std::copy(answer->begin(), answer->end(), to);
    return static_cast<std::uint8_t>(answer->size());
  }

  // --- xgate_port and xgate_application ------------------------------------------------------------------------------
  static HostProgram& self(void* context) { return *static_cast<HostProgram*>(context); }
  static void send(void* context, const std::uint8_t* bytes, std::uint16_t length) {
    self(context).line_.send(bytes, length);
  }
  static int receive(void* context, std::uint16_t ms) {
    const std::optional<std::uint8_t> byte = self(context).line_.receive(ms * bus::kTicksPerMs);
    return byte ? *byte : -1;
  }
  static std::uint8_t request(void* context, const std::uint8_t* pdu, std::uint8_t length, std::uint8_t* answer) {
    return self(context).serve(Bytes(pdu, pdu + length), answer);
  }

  kit::Cpu& cpu_;
  const UserSettings& own_;
  const ChipSettings& chip_;
  HostLine line_;
  user_cpu::AcyclicServer server_;
  xgate_module host_{};
  std::uint8_t inputs_ = 0, outputs_ = 0;
  std::array<Open, 2> open_;
};

}  // namespace

const tb::CodeTable& program_codes() {
  static const tb::CodeTable table{
      "Host program",
      "Errors of `driver/xgate` on an XGate-DPS10's user CPU.",
      {{"XGATE_ERR_ARGUMENT", "refusal", "X16", "an argument out of its range",
        "Give a diagnosis that fits in a frame."},
       {"XGATE_ERR_SILENT", "refusal", "X2", "no whole answer after all repetitions",
        "Compare rate, port and form of errors with the module's; give it more time."},
       {"XGATE_ERR_ANSWER", "refusal", "X2", "an answer that is none to this command",
        "Read each answer before the next command."},
       {"XGATE_ERR_MODULE", "refusal", "X3", "the module's error",
        "Tables 4.10 to 4.14 have the classes and codes; the log has the module's XGATE_ERROR."}}};
  return table;
}

void run_host(kit::Cpu& cpu) { HostProgram(cpu).run(); }

}  // namespace dsdpv1::xgate
