// decode: telegrams byte by byte, from whatever holds them. The format is detected by the beginning.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/commands/capture_file.hpp"
#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/words.hpp"
#include "bus/baud.hpp"
#include "bus/capture/pcapng_writer.hpp"
#include "bus/capture/telegram_printer.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/explain.hpp"
#include "bus/telegram/explain_memory.hpp"
#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "io/output/output_file.hpp"
#include "tb/bench/run_log.hpp"

namespace dsdpv1::app {
namespace {

namespace capture = bus::capture;
using bus::TelegramKind;

const char* kind_name(TelegramKind kind) {
  switch (kind) {
    case TelegramKind::kSd1: return "SD1";
    case TelegramKind::kSd2: return "SD2";
    case TelegramKind::kSd3: return "SD3";
    case TelegramKind::kSd4: return "SD4";
    case TelegramKind::kSc: return "SC";
  }
  return "";
}

bool has_addresses(const bus::Telegram& telegram) { return telegram.kind != TelegramKind::kSc; }
bool has_fc(const bus::Telegram& telegram) { return has_addresses(telegram) && telegram.kind != TelegramKind::kSd4; }

std::string baud_name(const capture::CapturedTelegram& telegram) {
  return telegram.baud ? std::string(bus::baud(*telegram.baud).name) : "";
}

std::string cell(const std::optional<std::uint8_t>& value) { return value ? fmt::format("{}", *value) : ""; }

/// A telegram with what is known of it.
struct Read {
  const capture::CapturedTelegram& telegram;
  bus::Decoded decoded;
  std::string why;  ///< what is wrong with it, empty for a right one
  bus::ExplainContext context;
};

std::string row(std::uint64_t number, const Read& read) {
  const capture::CapturedTelegram& telegram = read.telegram;
  const bus::Decoded& decoded = read.decoded;
  std::string text =
      fmt::format("{}\t{}\t{}", number, telegram.timed ? tb::nanoseconds(telegram.start) : "", baud_name(telegram));
  const bus::Telegram& fields = decoded.telegram;
  if (decoded.readable)
    text += fmt::format("\t{}\t{}\t{}\t{}\t{}\t{}\t{}", kind_name(fields.kind),
                        has_addresses(fields) ? fmt::format("{}", fields.sa) : "",
                        has_addresses(fields) ? fmt::format("{}", fields.da) : "",
                        has_fc(fields) ? fmt::format("{:02X}", fields.fc) : "", cell(fields.dsap), cell(fields.ssap),
                        has_fc(fields) ? bus::explain_service(fields, read.context) : "");
  else
    text += "\t\t\t\t\t\t\t";
  return text + fmt::format("\t{}\t{}\n", read.why, tb::bytes_text(telegram.bytes, telegram.bytes.size()));
}

nlohmann::ordered_json object(std::uint64_t number, const Read& read) {
  const capture::CapturedTelegram& telegram = read.telegram;
  const bus::Decoded& decoded = read.decoded;
  nlohmann::ordered_json json;
  json["number"] = number;
  if (telegram.line != 0) json["line"] = telegram.line;
  if (telegram.timed) json["at_ns"] = static_cast<double>(telegram.start) / static_cast<double>(bus::kTicksPerNs);
  if (telegram.baud) json["baud"] = baud_name(telegram);
  if (decoded.readable) {
    const bus::Telegram& fields = decoded.telegram;
    json["type"] = kind_name(fields.kind);
    if (has_addresses(fields)) json["sa"] = fields.sa;
    if (has_addresses(fields)) json["da"] = fields.da;
    if (has_fc(fields)) json["fc"] = fields.fc;
    if (fields.dsap) json["dsap"] = *fields.dsap;
    if (fields.ssap) json["ssap"] = *fields.ssap;
    if (has_fc(fields)) json["service"] = bus::explain_service(fields, read.context);
    json["words"] = bus::explain_line(fields, read.context);
    json["data"] = tb::bytes_text(fields.data, fields.data.size());
  }
  if (!read.why.empty()) json["wrong"] = read.why;
  for (const std::string& remark : telegram.remarks) json["remarks"].push_back(bus::printable(remark));
  json["bytes"] = tb::bytes_text(telegram.bytes, telegram.bytes.size());
  return json;
}

void open(std::optional<tb::OutputFile>& file, const std::string& path, const char* head) {
  if (path.empty()) return;
  file.emplace(path);
  file->write(head);
}

/// Paths, empty: not wanted.
struct FileNames {
  std::string table, json, pcapng;
};

/// --table, --json and --pcapng: a line or a packet for each telegram; nothing is kept.
class TelegramFiles {
 public:
  /// `source`: the input's name, for messages. Throws tb::InputError.
  TelegramFiles(const FileNames& names, std::string source) : source_(std::move(source)) {
    open(table_, names.table, "number\tat_ns\tbaud\ttype\tsa\tda\tfc\tdsap\tssap\tservice\twrong\tbytes\n");
    open(json_, names.json, "[");
    open(pcapng_, names.pcapng, "");
  }

  void take(const Read& read) {
    ++count_;
    if (table_) table_->write(row(count_, read));
    if (json_) json_->write((count_ == 1 ? "\n" : ",\n") + object(count_, read).dump());
    if (pcapng_) packet(read.telegram);
  }
  /// Throws tb::InputError where something could not be written.
  void finish() {
    if (json_) json_->write(count_ == 0 ? "]\n" : "\n]\n");
    for (std::optional<tb::OutputFile>* file : {&table_, &json_, &pcapng_})
      if (*file) (*file)->commit();
  }

 private:
  void packet(const capture::CapturedTelegram& telegram) {
    if (!telegram.baud)
      throw tb::InputError(source_, telegram.line,
                           "does not say its baud rate, --pcapng needs it, name it with --baud");
    if (telegram.missing != 0)
      throw tb::InputError(source_, telegram.line,
                           "has not all bytes, --pcapng needs a log with all of them (--log-whole, .jsonl)");
    if (!writer_)
      writer_.emplace(capture::PcapngHeader{257, "dsdpv1-sim", *telegram.baud},
                      [this](std::string_view bytes) { pcapng_->write(bytes); });
    writer_->telegram(telegram);
  }

  std::string source_;
  std::optional<tb::OutputFile> table_, json_, pcapng_;
  std::optional<capture::PcapngWriter> writer_;
  std::uint64_t count_ = 0;
};

/// Prints telegrams, and writes them to files.
class Printer {
 public:
  Printer(bool packets, bool quiet, TelegramFiles& files)
      : printer_(std::cout, packets), quiet_(quiet), files_(files) {}

  void take(const capture::CapturedTelegram& telegram) {
    ++count_;
    Read read{telegram, bus::decode(telegram.bytes), "", {}};
    read.why = capture::what_is_wrong(telegram, read.decoded);
    if (read.why.empty()) read.context = memory_.take(read.decoded.telegram);
    files_.take(read);
    if (!read.why.empty()) right_ = false;
    if (!quiet_) printer_.print(telegram, read.decoded, read.why, read.context);
  }

  int finish() {
    files_.finish();
    if (count_ == 0 && !quiet_) std::cout << "no telegram\n";
    return right_ && count_ > 0 ? kPassed : kFailed;
  }

 private:
  capture::TelegramPrinter printer_;
  bus::ExplainMemory memory_;
  bool quiet_, right_ = true;
  TelegramFiles& files_;
  std::uint64_t count_ = 0;
};

void say_source(const capture::LogicSource& source) {
  std::cout << fmt::format("signal {} at {}\n", bus::printable(source.signal), bus::baud(source.baud).name);
}

class Decode : public Command {
 public:
  Decode() : Command("decode", "Explain every byte of telegrams in text, logs, captures and recordings of the line") {}

  void options(CLI::App& app) override {
    app.add_option("FILE", file_,
                   "Hexadecimal text, a log of run or serve, pcapng, pcap, VCD or FST of any simulator, a session of "
                   "sigrok or CSV of a logic analyser; the format is detected (default and -: standard input)");
    app.add_option(
        "--baud", baud_,
        "Baud rate of a recording of the line (default: detected) or of text, whose telegrams then have times");
    app.add_option("--signal", settings_.signal,
                   "The line's signal in a recording (default: the only one, or line, PBRXD, PBTXD)");
    app.add_flag("--invert", settings_.inverted, "The recording's idle level is low");
    app.add_option("--table", table_, "Write one line per telegram, separated by tabs");
    app.add_option("--json", json_, "Write the same as JSON, with explanations");
    app.add_option("--pcapng", pcapng_, "Write the telegrams as a capture for Wireshark and replay; text needs --baud");
    app.add_flag("--quiet,-q", quiet_, "Print nothing");
    app.footer(
        "\nAny spacing, 0x and commas allowed; one telegram a line or a continuous stream; # begins a comment.\n"
        "A log is known by its lines, text or JSON; its telegrams are taken, best from one with all bytes "
        "(--log-whole).\nOf a line of another program's log the longest row of bytes is taken: I (394) RX: 68 05 ...\n"
        "\nExamples:\n  dsdpv1-sim decode capture.txt\n  dsdpv1-sim decode my.jsonl\n  dsdpv1-sim decode my.pcapng\n  "
        "dsdpv1-sim decode logic.sr --signal D2 --invert\n  dsdpv1-sim decode my.pcapng --quiet --table my.tsv\n  "
        "dsdpv1-sim decode terminal.txt --baud 1.5M --pcapng "
        "my.pcapng\n  echo "
        "68 05 05 68 85 82 6D 3C 3E EE 16 | dsdpv1-sim decode\n"
        "\nExit codes: 0 all right, 1 some bytes are no right telegram, 2 wrong input.\n");
  }

  int carry_out() override {
    CaptureFile file(file_);
    leave_nothing_on_signals();
    check_outputs("dsdpv1-sim decode", {{"the capture", file.path()}},
                  {{"--table", table_}, {"--json", json_}, {"--pcapng", pcapng_}});
    if (!baud_.empty()) settings_.baud = baud_index("dsdpv1-sim decode: --baud", baud_);
    TelegramFiles files({table_, json_, pcapng_}, file.name());
    Printer printer(file.packets(), quiet_, files);
    const auto source =
        file.read(settings_, [&printer](const capture::CapturedTelegram& telegram) { printer.take(telegram); });
    if (source && !quiet_) say_source(*source);
    return printer.finish();
  }

 private:
  std::string file_;  ///< empty or "-": standard input
  std::string baud_;  ///< of levels and text; empty: found, or not known
  capture::LogicSettings settings_;
  std::string table_, json_, pcapng_;  ///< files for programs
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_decode() { return std::make_unique<Decode>(); }

}  // namespace dsdpv1::app
