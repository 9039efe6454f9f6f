#include "apps/commands/telegram_files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/explain.hpp"
#include "io/input/units.hpp"
#include "tb/bench/run_log.hpp"

namespace dsdpv1::app {
namespace {

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

std::string baud_name(const bus::capture::CapturedTelegram& telegram) {
  return telegram.baud ? std::string(bus::baud(*telegram.baud).name) : "";
}

std::string cell(const std::optional<std::uint8_t>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string row(std::uint64_t number, const bus::capture::CapturedTelegram& telegram, const bus::Decoded& decoded,
                const std::string& why) {
  std::string text = fmt::format("{}\t{}\t{}", number, tb::nanoseconds(telegram.start), baud_name(telegram));
  const bus::Telegram& fields = decoded.telegram;
  if (decoded.readable)
    text += fmt::format("\t{}\t{}\t{}\t{}\t{}\t{}\t{}", kind_name(fields.kind),
                        has_addresses(fields) ? fmt::format("{}", fields.sa) : "",
                        has_addresses(fields) ? fmt::format("{}", fields.da) : "",
                        has_fc(fields) ? fmt::format("{:02X}", fields.fc) : "", cell(fields.dsap), cell(fields.ssap),
                        has_fc(fields) ? bus::explain_service(fields) : "");
  else
    text += "\t\t\t\t\t\t\t";
  return text + fmt::format("\t{}\t{}\n", why, tb::bytes_text(telegram.bytes, telegram.bytes.size()));
}

nlohmann::ordered_json object(std::uint64_t number, const bus::capture::CapturedTelegram& telegram,
                              const bus::Decoded& decoded, const std::string& why) {
  nlohmann::ordered_json json;
  json["number"] = number;
  json["at_ns"] = static_cast<double>(telegram.start) / static_cast<double>(bus::kTicksPerNs);
  if (telegram.baud) json["baud"] = baud_name(telegram);
  if (decoded.readable) {
    const bus::Telegram& fields = decoded.telegram;
    json["type"] = kind_name(fields.kind);
    if (has_addresses(fields)) json["sa"] = fields.sa;
    if (has_addresses(fields)) json["da"] = fields.da;
    if (has_fc(fields)) json["fc"] = fields.fc;
    if (fields.dsap) json["dsap"] = *fields.dsap;
    if (fields.ssap) json["ssap"] = *fields.ssap;
    if (has_fc(fields)) json["service"] = bus::explain_service(fields);
    json["words"] = bus::explain_line(fields);
    json["data"] = tb::bytes_text(fields.data, fields.data.size());
  }
  if (!why.empty()) json["wrong"] = why;
  for (const std::string& remark : telegram.remarks) json["remarks"].push_back(bus::printable(remark));
  json["bytes"] = tb::bytes_text(telegram.bytes, telegram.bytes.size());
  return json;
}

void open(std::optional<tb::OutputFile>& file, const std::string& path, const char* head) {
  if (path.empty()) return;
  file.emplace(path);
  file->write(head);
}

}  // namespace

TelegramFiles::TelegramFiles(const std::string& table, const std::string& json) {
  open(table_, table, "number\tat_ns\tbaud\ttype\tsa\tda\tfc\tdsap\tssap\tservice\twrong\tbytes\n");
  open(json_, json, "[");
}

void TelegramFiles::take(const bus::capture::CapturedTelegram& telegram, const bus::Decoded& decoded,
                         const std::string& why) {
  ++count_;
  if (table_) table_->write(row(count_, telegram, decoded, why));
  if (json_) json_->write((count_ == 1 ? "\n" : ",\n") + object(count_, telegram, decoded, why).dump());
}

void TelegramFiles::finish() {
  if (json_) json_->write(count_ == 0 ? "]\n" : "\n]\n");
  if (table_) table_->commit();
  if (json_) json_->commit();
}

}  // namespace dsdpv1::app
