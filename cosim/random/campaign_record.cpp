#include "cosim/random/campaign_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cosim/random/play_options.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/output/write_file.hpp"

namespace dsdpv1::cosim {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "dsdpv1-sim rtl-random --campaign";
constexpr int kVersion = 1;
constexpr tb::FileKind kRecordFile{"the record of a campaign", 64};

Json json_of(const PortRecord& port) {
  Json telegrams = Json::object(), codes = Json::object(), situations = Json::array();
  for (const auto& [name, count] : port.coverage.telegrams()) telegrams[name] = count;
  for (const profibus::Reason reason : port.kind->reasons())
    if (port.coverage.count(reason) != 0) codes[profibus::code(reason)] = port.coverage.count(reason);
  for (const auto& [situation, times] : port.situations.counts())
    situations.push_back({situation.first, situation.second, times});
  return {{"port", port.name()},
          {"cases", port.cases},
          {"cycles", port.counts.cycles},
          {"pin_changes", port.counts.pin_changes},
          {"dpram_images", port.counts.dpram_images},
          {"telegrams", telegrams},
          {"codes", codes},
          {"situations", situations}};
}

void read_port(const Json& json, PortRecord& port) {
  if (json.at("port") != port.name()) throw tb::InputError("port " + json.at("port").dump());
  json.at("cases").get_to(port.cases);
  json.at("cycles").get_to(port.counts.cycles);
  json.at("pin_changes").get_to(port.counts.pin_changes);
  json.at("dpram_images").get_to(port.counts.dpram_images);
  for (const auto& [name, count] : json.at("telegrams").items()) port.coverage.add(name, count.get<std::uint64_t>());
  const std::vector<profibus::Reason>& reasons = port.kind->reasons();
  for (const auto& [code, count] : json.at("codes").items()) {
    const auto found = std::find_if(reasons.begin(), reasons.end(),
                                    [&code = code](profibus::Reason each) { return code == profibus::code(each); });
    if (found == reasons.end()) throw tb::InputError("code " + code);
    port.coverage.add(*found, count.get<std::uint64_t>());
  }
  for (const Json& each : json.at("situations"))
    port.situations.add({each.at(0).get<std::string>(), each.at(1).get<std::string>()},
                        each.at(2).get<std::uint64_t>());
}

void read_all(const Json& json, CampaignRecord& record) {
  if (json.at("schema") != kSchema || json.at("version") != kVersion) throw tb::InputError("schema or version");
  const Json& ports = json.at("ports");
  if (ports.size() != record.ports.size()) throw tb::InputError("number of ports");
  for (std::size_t i = 0; i < record.ports.size(); ++i) read_port(ports.at(i), record.ports.at(i));
}

}  // namespace

std::string PortRecord::name() const { return fmt::format("{} {}", kind->name(), port->word); }

std::vector<Situation> PortRecord::known() const {
  return kind->random()->known_situations(*chip_settings(*kind, port->set));
}

std::uint64_t CampaignRecord::cycles() const {
  std::uint64_t sum = 0;
  for (const PortRecord& port : ports) sum += port.counts.cycles;
  return sum;
}

std::uint64_t CampaignRecord::cases() const {
  std::uint64_t sum = 0;
  for (const PortRecord& port : ports) sum += port.cases;
  return sum;
}

PortRecord* CampaignRecord::behind(std::uint64_t goal) {
  const auto done = [](const PortRecord& port) { return port.counts.cycles / port.port->share; };
  const auto least =
      std::min_element(ports.begin(), ports.end(), [&](const auto& a, const auto& b) { return done(a) < done(b); });
  return least->counts.cycles * 100 < goal * least->port->share ? &*least : nullptr;
}

void CampaignRecord::add(PortRecord& port, const CampaignResult& result) {
  port.cases += result.cases;
  port.counts.add(result.counts);
  port.coverage.add(result.coverage);
  port.situations.add(result.situations);
}

CampaignRecord new_record(std::uint64_t seed) {
  CampaignRecord record;
  record.seed = seed;
  for (const tb::ChipKind* kind : tb::chip_kinds()) {
    if (kind->random() == nullptr) continue;
    for (const HostPort& port : kind->random()->words().ports)
      if (port.share != 0) record.ports.push_back({kind, &port});
  }
  return record;
}

CampaignRecord read_record(const std::string& folder, std::uint64_t seed) {
  const std::string path = (std::filesystem::path(folder) / kCampaignFile).string();
  CampaignRecord record = new_record(seed);
  if (!std::filesystem::exists(path)) return record;
  const Json json = Json::parse(tb::read_file(path, kRecordFile), nullptr, false);
  std::uint64_t other = 0;
  try {
    read_all(json, record);
    json.at("seed").get_to(other);
  } catch (const std::exception& error) {
    throw tb::InputError(path + ": no record of a campaign of this program (" + error.what() +
                         "), expected --state with another folder");
  }
  if (other != seed)
    throw tb::InputError(fmt::format("{}: this campaign has seed {}, expected --seed {} or --state with another folder",
                                     path, other, other));
  return record;
}

void write_record(const std::string& folder, const CampaignRecord& record) {
  Json json = {{"schema", kSchema}, {"version", kVersion}, {"seed", record.seed}, {"ports", Json::array()}};
  for (const PortRecord& port : record.ports) json["ports"].push_back(json_of(port));
  tb::write_file((std::filesystem::path(folder) / kCampaignFile).string(), json.dump(1) + "\n");
}

std::string table(const CampaignRecord& record) {
  std::string lines = "# port, group, situation, count\n";
  for (const PortRecord& port : record.ports) {
    const std::string name = port.name();
    lines += fmt::format("{}\tcompared\tseed\t{}\n{}\tcompared\tcases\t{}\n{}\tcompared\tcycles\t{}\n", name,
                         record.seed, name, port.cases, name, port.counts.cycles);
    const std::string situations = table(port.situations, port.known());
    for (std::size_t at = 0; at < situations.size();) {
      const std::size_t end = situations.find('\n', at);
      lines += name + "\t" + situations.substr(at, end - at + 1);
      at = end + 1;
    }
  }
  return lines;
}

}  // namespace dsdpv1::cosim
