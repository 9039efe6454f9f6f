#include "cosim/user_rtl.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <system_error>
#include <utility>

#include "cosim/reference_rtl.hpp"
#include "io/input/hash.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/output/shell_word.hpp"
#include "io/output/write_file.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::cosim {
namespace {

namespace fs = std::filesystem;

/// A message about a line of the map, or, without a line, about the map or its lack.
[[noreturn]] void fail(const UserRtl& rtl, const PinMap& map, int line, const std::string& what) {
  if (map.path.empty()) throw tb::InputError(fmt::format("{}: {}, in --pins", rtl.command, what));
  throw tb::InputError(map.path, line, what);
}

std::string read(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The first line of an error in the output of a command.
std::string first_error(const std::string& log) {
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);)
    if (line.find("rror:") != std::string::npos || line.find("%Error") != std::string::npos) return line;
  return "failed";
}

/// Runs a command with its output in a file. Returns whether it succeeded. Not by system(), which keeps Ctrl-C from
/// this process.
bool succeeds(const std::string& command, const std::string& log) {
  std::string text = command + " >" + tb::shell_word(log) + " 2>&1", shell = "sh", option = "-c";
  const std::array<char*, 4> words = {shell.data(), option.data(), text.data(), nullptr};
  pid_t pid = 0;
  if (posix_spawn(&pid, "/bin/sh", nullptr, nullptr, words.data(), environ) != 0) return false;
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status == 0;
}

[[noreturn]] void fail_build(const std::string& log, const UserRtl& rtl) {
  throw tb::InputError(fmt::format("{}: {}: {} (all of it in {}), expected RTL that Verilator 5.006 builds",
                                   rtl.command, rtl.top, first_error(log), log));
}

/// The path of a file or folder in the map; it exists.
std::string existing(const UserRtl& rtl, const PinMap& map, const MapWord& word) {
  const fs::path path = fs::absolute(fs::path(rtl.folder) / word.text);
  if (!fs::exists(path))
    fail(rtl, map, word.line, fmt::format("{} is not in {}, expected a path from there", word.text, rtl.folder));
  return path.string();
}

std::vector<std::string> sources(const UserRtl& rtl, const PinMap& map) {
  std::vector<std::string> files;
  for (const MapWord& file : map.files) files.push_back(existing(rtl, map, file));
  if (!files.empty() || !map.file_list.text.empty()) return files;
  for (const auto& entry : fs::directory_iterator(rtl.folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".sv" || ending == ".v") files.push_back(fs::absolute(entry.path()).string());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw tb::InputError(rtl.folder, 0, "holds no RTL, expected .sv and .v files");
  return files;
}

RtlLibrary load(const std::string& path) {
  std::string why_not;
  const RtlLibrary library = load_library(fs::absolute(path).string(), why_not);
  if (!why_not.empty()) throw tb::InputError(path, 0, "cannot be loaded: " + why_not);
  return library;
}

/// The first is for the design that begins with zeros. The others are not slowed by counters.
struct UserLibraries {
  RtlLibrary first, others;
};

/// Three designs that begin with zeros, with ones and with random values wherever nothing is initialised or reset
/// (Verilator's randReset). The first is traced and counted.
class UserDesigns : public Rtl {
 public:
  UserDesigns(const UserLibraries& libraries, const tb::PinTable& pins, const std::vector<std::uint32_t>& constants,
              std::optional<RtlTrace> trace)
      : library_(libraries.first), others_(libraries.others), pins_(pins), trace_(std::move(trace)) {
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      RtlStart start;
      start.fill = static_cast<int>(i);
      start.parameters = constants.data();
      designs_.at(i) = of(i).create(&start);
    }
    if (trace_) library_.trace(designs_.front(), trace_->file.c_str());
  }
  ~UserDesigns() override {
    if (trace_) dump();
    for (std::size_t i = 0; i < designs_.size(); ++i) of(i).destroy(designs_.at(i));
  }
  UserDesigns(const UserDesigns&) = delete;
  UserDesigns& operator=(const UserDesigns&) = delete;

  void eval(bool clk, Level* levels) override {
    std::array<Level, kMostPins> other{};
    std::copy_n(levels, pins_.size(), other.begin());
    library_.eval(designs_.front(), clk, levels);
    for (std::size_t i = 1; i < designs_.size(); ++i) {
      others_.eval(designs_.at(i), clk, other.data());
      for (std::size_t pin = 0; pin < pins_.size(); ++pin)
        if (!pins_[pin].input && other.at(pin) != levels[pin]) levels[pin] = tb::kLevelX;
    }
  }
  /// Dumps the result of all evaluations of one time after the last: a trace takes each time once.
  void moment(Tick at) override {
    if (!trace_ || at == now_) return;
    if (now_ >= 0) dump();
    now_ = at;
  }

 private:
  const RtlLibrary& of(std::size_t design) const { return design == 0 ? library_ : others_; }
  void dump() {
    if (now_ >= trace_->from && now_ <= trace_->to)
      library_.dump(designs_.front(), static_cast<std::uint64_t>(tb::picoseconds(now_)));
  }

  const RtlLibrary library_, others_;
  const tb::PinTable& pins_;
  std::array<void*, 3> designs_{};
  std::optional<RtlTrace> trace_;
  Tick now_ = -1;  ///< of the evaluations not dumped yet
};

/// The parts of the generated file that only a traced build needs.
constexpr const char* kTraceIncluded = "#include \"verilated_fst_c.h\"\n";
constexpr const char* kTraceMember = "  VerilatedFstC trace;  // closed before the model goes\n";
constexpr const char* kTraceFunctions =
    "\nextern \"C\" void dsdpv1_rtl_trace(void* self, const char* file) {\n"
    "  auto* design = static_cast<Design*>(self);\n"
    "  design->model->trace(&design->trace, 99);\n"
    "  design->trace.set_time_unit(\"1ps\");\n  design->trace.set_time_resolution(\"1ps\");\n"
    "  design->trace.open(file);\n}\n\n"
    "extern \"C\" void dsdpv1_rtl_dump(void* self, unsigned long long picoseconds) {\n"
    "  static_cast<Design*>(self)->trace.dump(static_cast<uint64_t>(picoseconds));\n}\n";

/// The parts that only a counted build needs. Each design has its counters in an array, which a design without lines
/// lacks.
constexpr const char* kCountIncluded =
    "#include \"V@___024root.h\"\n#include \"V@__Syms.h\"\n#include \"verilated_cov.h\"\n#include <algorithm>\n"
    "#include <cstddef>\n#include <mutex>\n#include <vector>\n";
constexpr const char* kCounters = R"(
std::mutex mutex;
std::vector<unsigned long long> counted;

template <class Symbols, class Use>
auto for_each(Symbols* symbols, const Use& use, int) -> decltype(symbols->__Vcoverage, void()) {
  std::size_t i = 0;
  for (auto& counter : symbols->__Vcoverage) use(counter, i++);
}
template <class Symbols, class Use>
void for_each(Symbols*, const Use&, long) {}

void count(const Design& design) {
  const std::lock_guard<std::mutex> lock(mutex);
  for_each(design.model->rootp->vlSymsp, [](const auto& counter, std::size_t i) {
    if (i >= counted.size()) counted.resize(i + 1);
    counted[i] += counter;
  }, 0);
}
)";
constexpr const char* kCountFunctions = R"(
extern "C" void dsdpv1_rtl_counts(const char* file) {
  const std::lock_guard<std::mutex> lock(mutex);
  Design design;
  design.model = std::make_unique<V@>(&design.context);
  for_each(design.model->rootp->vlSymsp, [](auto& counter, std::size_t i) {
    counter = i < counted.size() ? static_cast<unsigned>(std::min(counted[i], 0xFFFFFFFFULL)) : 0;
  }, 0);
  counted.clear();
  design.context.coveragep()->write(file);
  Verilated::threadContextp(&design.context);
  design.model.reset();
  Verilated::threadContextp(Verilated::defaultContextp());
}
)";

/// `text` with the top's name for each @.
std::string of_top(std::string text, const std::string& top) {
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at + top.size()))
    text.replace(at, 1, top);
  return text;
}

}  // namespace

namespace {

unsigned bits(const tb::PinInfo& pin) { return (1U << static_cast<unsigned>(pin.width)) - 1; }

/// An undriven bus reads as ones.
std::string input_line(const tb::PinInfo& pin, std::size_t number, const Port& port) {
  if (pin.width == 1) return fmt::format("  model.{} = {}levels[{}];\n", port.name, port.inverted ? "!" : "", number);
  const std::string level = pin.bus != nullptr ? fmt::format("(levels[{0}] < 0 ? {1} : levels[{0}])", number, bits(pin))
                                               : fmt::format("levels[{}]", number);
  return fmt::format("  model.{} = ({}{}) & {};\n", port.name, port.inverted ? "~" : "", level, bits(pin));
}

std::string output_line(const tb::PinInfo& pin, std::size_t number, const PinMap& map) {
  const Port& port = map.pins.at(pin.name);
  std::string level = pin.width == 1 ? fmt::format("{}model.{}", port.inverted ? "!" : "", port.name)
                                     : fmt::format("({}model.{}) & {}", port.inverted ? "~" : "", port.name, bits(pin));
  if (pin.released) {
    const Port& enable = map.pins.at(enable_of(pin));
    level = fmt::format("{}model.{} ? {} : -1", enable.inverted ? "!" : "", enable.name, level);
  }
  return fmt::format("  levels[{}] = static_cast<short>({});\n", number, level);
}

}  // namespace

std::string adapter_source(const std::string& top, const PinMap& map, const tb::PinTable& pins, bool traced,
                           const std::string& constants, bool counted) {
  std::string text = fmt::format(
      "// Generated: the pins of {0} for the co-simulation.\n"
      "#include \"V{0}.h\"\n#include \"verilated.h\"\n{1}#include <memory>\n\nnamespace {{\n"
      "struct Start {{\n  int fill;\n  unsigned seed, fault;\n  const void* parameters;\n}};\nstruct Design {{\n"
      "  VerilatedContext context;\n  std::unique_ptr<V{0}> model;\n{2}}};\n{8}}}  // namespace\n\n"
      "extern \"C\" void* dsdpv1_rtl_create(const Start* start) {{\n  auto* design = new Design;\n"
      "  [[maybe_unused]] const auto* values = static_cast<const unsigned*>(start->parameters);\n"
      "  design->context.randReset(start->fill);\n  design->context.randSeed(static_cast<int>(start->seed));\n{3}"
      "  design->model = std::make_unique<V{0}>(&design->context);\n{7}  return design;\n}}\n\n"
      "extern \"C\" void dsdpv1_rtl_destroy(void* self) {{\n  auto* design = static_cast<Design*>(self);\n"
      "  Verilated::threadContextp(&design->context);  // whose names the model takes out\n{9}  delete design;\n"
      "  Verilated::threadContextp(Verilated::defaultContextp());\n}}\n{4}\n"
      "extern \"C\" void dsdpv1_rtl_eval(void* self, bool clk, short* levels) {{\n"
      "  V{0}& model = *static_cast<Design*>(self)->model;\n  model.{5} = {6}clk;\n",
      top, (traced ? kTraceIncluded : "") + (counted ? of_top(kCountIncluded, top) : ""), traced ? kTraceMember : "",
      traced ? "  design->context.traceEverOn(true);\n" : "",
      (traced ? kTraceFunctions : "") + (counted ? of_top(kCountFunctions, top) : ""), map.clock.name,
      map.clock.inverted ? "!" : "", constants, counted ? kCounters : "", counted ? "  count(*design);\n" : "");
  for (std::size_t i = 0; i < pins.size(); ++i)
    if (pins[i].input) text += input_line(pins[i], i, map.pins.at(pins[i].name));
  text += "  model.eval();\n";
  for (std::size_t i = 0; i < pins.size(); ++i)
    if (!pins[i].input) text += output_line(pins[i], i, map);
  return text + "}\n";
}

namespace {

/// Folders with the modules of the reference RTL and their includes.
std::vector<std::string> reference_folders(const UserRtl& rtl) {
  const fs::path root = fs::path(rtl.sources) / "rtl_ref";
  if (!fs::is_directory(root))
    throw tb::InputError(fmt::format("{}: the map of pins has reference: true, but {} is not there, expected a {}",
                                     rtl.command, root.string(), "program whose sources are where it was built"));
  std::vector<std::string> folders = {root.string(), (fs::path(rtl.sources) / "registers").string()};
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.is_directory()) folders.push_back(entry.path().string());
  std::sort(folders.begin() + 2, folders.end());
  return folders;
}

/// A parameter's value in Verilog.
std::string literal(const RtlParameter& parameter) {
  if (parameter.words.size() == 1) return fmt::format("{}", parameter.words.front());
  std::string text = fmt::format("{}'h", parameter.width);
  for (auto word = parameter.words.rbegin(); word != parameter.words.rend(); ++word)
    text += fmt::format("{:08x}", *word);
  return text;
}

/// Counters make so much code that its optimisation would take longer than it saves in a night. Memories are not
/// counted.
constexpr const char* kCounting =
    " '-O1 -fPIC' --coverage-line --coverage-toggle --coverage-max-width 64 --output-split 20000";

std::string verilator_command(const UserRtl& rtl, const PinMap& map, const std::vector<RtlParameter>& parameters,
                              const std::string& build, const std::string& adapter) {
  // No rules of its own for make, which take a path with a space apart.
  std::string command = "verilator --cc --exe --no-MMD -O3 -Wno-fatal --x-assign unique --x-initial unique -CFLAGS";
  command += rtl.counted ? kCounting : " '-O2 -fPIC'";
  const auto add = [&command](const std::string& option) { command.append(" ").append(tb::shell_word(option)); };
  command += rtl.traced ? " --trace-fst --trace-structs -LDFLAGS '-shared -lz'" : " -LDFLAGS -shared";
  command += fmt::format(" --top-module {} --prefix V{} --Mdir {} -I{} -o librtl.so", rtl.top, rtl.top,
                         tb::shell_word(build), tb::shell_word(fs::absolute(rtl.folder).string()));
  for (const MapWord& folder : map.include) add("-I" + existing(rtl, map, folder));
  if (map.reference)
    for (const std::string& folder : reference_folders(rtl)) add("-I" + folder);
  for (const auto& [name, value] : map.defines)
    add(fmt::format("-D{}{}{}", name, value.text.empty() ? "" : "=", value.text));
  for (const auto& [name, value] : map.parameters) add(fmt::format("-G{}={}", name, value.text));
  for (const RtlParameter& each : parameters)
    if (const auto place = map.chip.find(each.key); place != map.chip.end() && !place->second.port)
      add(fmt::format("-G{}={}", place->second.name, literal(each)));
  if (!map.file_list.text.empty()) command += " -F " + tb::shell_word(existing(rtl, map, map.file_list));
  for (const std::string& source : sources(rtl, map)) add(source);
  add(adapter);
  return command;
}

/// A fault that the RTL cannot be told.
void check_fault(const UserRtl& rtl, const PinMap& map) {
  if (rtl.fault != 0 && map.fault.text.empty())
    fail(rtl, map, 0,
         fmt::format("fault: is missing, expected fault: INPUT, the input of {} that selects a single fault", rtl.top));
}

/// What Verilator says of -G.
void check_found(const UserRtl& rtl, const PinMap& map, const std::string& log) {
  const std::string missing = "not found in the design: ", error = first_error(log);
  const std::size_t at = error.find(missing);
  if (at == std::string::npos) return;
  std::string name = error.substr(at + missing.size());
  name.resize(std::min(name.size(), name.find_first_of(", ")));
  const auto says = [&](const std::string& what, int line) {
    fail(rtl, map, line,
         fmt::format("{} has no parameter {} for {}, expected one of its parameters", rtl.top, name, what));
  };
  if (const auto found = map.parameters.find(name); found != map.parameters.end())
    says("parameters", found->second.line);
  for (const auto& [key, place] : map.chip)
    if (!place.port && place.name == name) says("chip." + key, place.line);
}

// --- the ports of the top -------------------------------------------------------------------------------------------

/// A port of the top as the Verilated header declares it: VL_IN8(&name,7,0), VL_INW(&name,127,0,4).
struct TopPort {
  bool input = false, output = false;
  int width = 0;
};
using TopPorts = std::map<std::string, TopPort>;

TopPorts ports_of(const std::string& header) {
  static const std::regex kPort(R"(VL_(IN|OUT|INOUT)(?:8|16|64|W)?\(\(?&(\w+)\)?[^,]*,(\d+),(\d+)[,)])");
  TopPorts ports;
  for (auto at = std::sregex_iterator(header.begin(), header.end(), kPort); at != std::sregex_iterator(); ++at) {
    const std::string direction = (*at)[1];
    const int left = std::stoi((*at)[3]), right = std::stoi((*at)[4]);
    ports[(*at)[2]] = {direction != "OUT", direction != "IN", std::abs(left - right) + 1};
  }
  return ports;
}

std::string names_of(const TopPorts& ports, bool inputs) {
  std::vector<std::string> names;
  for (const auto& [name, port] : ports)
    if (inputs ? port.input : port.output) names.push_back(name);
  return names.empty() ? "none" : tb::join(names);
}

/// Compares the map with the ports: each port in the map is there with the right direction and width, and each input is
/// in the map.
class PortCheck {
 public:
  PortCheck(const UserRtl& rtl, const PinMap& map, const TopPorts& ports) : rtl_(rtl), map_(map), ports_(ports) {}

  void run(const tb::PinTable& pins, const std::vector<RtlParameter>& parameters) {
    check("CLK", map_.clock.name, 1, true, map_.clock.line);
    for (const tb::PinInfo& pin : pins) {
      check(pin.name, map_.pins.at(pin.name), pin.width, pin.input);
      if (pin.released) check(enable_of(pin), map_.pins.at(enable_of(pin)), 1, false);
    }
    for (const RtlParameter& each : parameters)
      if (const auto place = map_.chip.find(each.key); place != map_.chip.end() && place->second.port)
        check("chip." + std::string(each.key), place->second.name, 0, true, place->second.line);
    for (const auto& [name, tie] : map_.ties) check_number("tie", name, tie.value, tie.line);
    if (!map_.fault.text.empty()) check_number("fault", map_.fault.text, rtl_.fault, map_.fault.line);
    for (const auto& [name, port] : ports_)
      if (port.input && used_.count(name) == 0)
        fail(rtl_, map_, 0,
             fmt::format("{}'s input {} is not in the map, expected it in pins, chip, fault or tie: {{{}: 0}}",
                         rtl_.top, name, name));
  }

 private:
  void check(const std::string& what, const Port& port, int width, bool input) {
    check(what, port.name, width, input, port.line);
  }
  /// `width` 0: any.
  void check(const std::string& what, const std::string& name, int width, bool input, int line) {
    const auto found = ports_.find(name);
    const char* const direction = input ? "input" : "output";
    if (found == ports_.end() || !(input ? found->second.input : found->second.output))
      fail(rtl_, map_, line,
           fmt::format("{} has no port {} that is an {}, for {}, expected one of {}", rtl_.top, name, direction, what,
                       names_of(ports_, input)));
    if (width != 0 && found->second.width != width)
      fail(rtl_, map_, line,
           fmt::format("port {} of {} has {} bits, {} has {}, expected as many", name, rtl_.top, found->second.width,
                       what, width));
    if (!used_.emplace(name, what).second)
      fail(rtl_, map_, line, fmt::format("port {} is {} and {}, expected one of them", name, used_.at(name), what));
  }
  void check_number(const std::string& what, const std::string& name, std::uint64_t value, int line) {
    check(what, name, 0, true, line);
    constexpr int kValueBits = 64;
    const int width = ports_.at(name).width;
    if (width < kValueBits && value >> static_cast<unsigned>(width) != 0)
      fail(rtl_, map_, line, fmt::format("{} of {} is {}, expected a number of {} bits", what, name, value, width));
  }

  const UserRtl& rtl_;
  const PinMap& map_;
  const TopPorts& ports_;
  std::map<std::string, std::string> used_;
};

/// The inputs that keep one level: those of parameters, the tied ones and the fault's. The values are given to each
/// design when it is made, so that others need no other build.
class Constants {
 public:
  Constants(const PinMap& map, const TopPorts& ports, const std::vector<RtlParameter>& parameters, unsigned fault) {
    for (const RtlParameter& each : parameters)
      if (const auto place = map.chip.find(each.key); place != map.chip.end() && place->second.port)
        add(place->second.name, ports, each.words);
    for (const auto& [name, tie] : map.ties)
      add(name, ports, {static_cast<std::uint32_t>(tie.value), static_cast<std::uint32_t>(tie.value >> 32U)});
    if (!map.fault.text.empty()) add(map.fault.text, ports, {fault});
  }

  /// Statements of the generated file.
  const std::string& code() const { return code_; }
  const std::vector<std::uint32_t>& values() const { return values_; }

 private:
  /// Upper words that `words` lacks are 0. A port that the top does not have is for PortCheck.
  void add(const std::string& name, const TopPorts& ports, std::vector<std::uint32_t> words) {
    constexpr int kWordBits = 32;
    const auto port = ports.find(name);
    const int width = port == ports.end() ? 1 : port->second.width;
    words.resize(static_cast<std::size_t>((width + kWordBits - 1) / kWordBits));
    const std::string input = "  design->model->" + name;
    const auto value = [this](std::size_t i) { return fmt::format("values[{}]", values_.size() + i); };
    if (words.size() == 1) code_ += fmt::format("{} = {};\n", input, value(0));
    if (words.size() == 2)
      code_ += fmt::format("{} = {}ULL * {} + {};\n", input, std::uint64_t{1} << 32U, value(1), value(0));
    for (std::size_t i = 0; i < words.size() && words.size() > 2; ++i)
      code_ += fmt::format("{}[{}] = {};\n", input, i, value(i));
    values_.insert(values_.end(), words.begin(), words.end());
  }

  std::string code_;
  std::vector<std::uint32_t> values_;
};

/// It is used in names of files and classes, and in commands.
void check_top(const UserRtl& rtl) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const bool begins = !rtl.top.empty() && std::isdigit(static_cast<unsigned char>(rtl.top.front())) == 0;
  if (begins && std::all_of(rtl.top.begin(), rtl.top.end(), fits)) return;
  throw tb::InputError(
      fmt::format("{}: --top is {}, expected the name of a module: letters, digits and _", rtl.command, rtl.top));
}

bool installed(const char* program) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0;
}

void create_folder(const std::string& folder) {
  if (folder.find(' ') != std::string::npos)
    throw tb::InputError(folder, 0, "has a space, in which make cannot build, expected --build FOLDER without one");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw tb::InputError(folder, 0, "cannot be created: " + error.message());
}

/// With ccache, if present: RTL that has been built before is not compiled again.
std::string make_command(const UserRtl& rtl, const std::string& build) {
  return fmt::format("{}make -s -j2 -C {} -f V{}.mk{}", installed("ccache") ? "OBJCACHE=ccache " : "",
                     tb::shell_word(build), rtl.top, rtl.counted ? " OPT_FAST= OPT_GLOBAL=" : "");
}

/// One process at a time builds in a folder; another waits, and then finds what it needs. Verilator and make inherit
/// the lock: when this process is killed, the next one waits for their end.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder) : file_(open((folder + "/lock").c_str(), O_RDWR | O_CREAT, 0666)) {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

/// Other parameters of the top than the usual ones have a build of their own.
std::string build_folder(const UserRtl& rtl, const PinMap& map, const std::vector<RtlParameter>& parameters) {
  fs::path folder = fs::absolute(rtl.build);
  if (rtl.traced) folder /= "traced";
  if (rtl.counted) folder /= "counted";
  std::string unusual;
  for (const RtlParameter& each : parameters)
    if (const auto place = map.chip.find(each.key); !each.usual && place != map.chip.end() && !place->second.port)
      unusual += fmt::format("{}={} ", each.key, literal(each));
  tb::Hash values;
  values.add(unusual);
  if (!unusual.empty()) folder /= fmt::format("{:016x}", values.value());
  return folder.string();
}

constexpr const char* kCompiling = "compiling";  ///< in the folder of a build while make works there

/// A build in its folder.
class Build {
 public:
  Build(UserRtl rtl, const PinMap& map, const tb::ChipKind& kind, const std::vector<RtlParameter>& parameters)
      : rtl_(std::move(rtl)),
        map_(map),
        kind_(kind),
        parameters_(parameters),
        folder_(build_folder(rtl_, map, parameters)) {
    create_folder(folder_);
  }

  /// Makes the library unless it is there and nothing that it depends on has changed; loads it.
  RtlLibrary library() {
    const FolderLock lock(folder_);
    const std::string command = verilator_command(rtl_, map_, parameters_, folder_, adapter());
    if (!is_made(command)) make(command);
    check_ports();
    return load(file("librtl.so"));
  }
  /// The levels of the inputs that keep one.
  std::vector<std::uint32_t> values() const { return constants().values(); }
  const std::string& folder() const { return folder_; }

 private:
  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  std::string adapter() const { return file("adapter.cpp"); }
  std::string header() const { return file("V" + rtl_.top + ".h"); }
  std::string state() const { return file(kBuiltFrom); }

  bool is_made(const std::string& command) const {
    return fs::exists(file("librtl.so")) && fs::exists(header()) && read(state()) == made_from(command, source());
  }

  void make(const std::string& command) {
    fs::remove(state());
    if (!succeeds(command, file("verilator.log"))) {
      check_found(rtl_, map_, file("verilator.log"));
      fail_build(file("verilator.log"), rtl_);
    }
    check_ports();
    const std::string made = source();
    if (read(adapter()) != made) tb::write_file(adapter(), made);  // the same one is not compiled again
    if (fs::exists(file(kCompiling))) remove_objects();
    tb::write_file(file(kCompiling), "");
    if (!succeeds(make_command(rtl_, folder_), file("compiler.log"))) fail_build(file("compiler.log"), rtl_);
    fs::remove(file(kCompiling));
    tb::write_file(state(), made_from(command, made));
  }

  /// A killed compiler may have left half of one, which make takes for a whole one.
  void remove_objects() const {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (const auto ending = entry.path().extension(); ending == ".o" || ending == ".a" || ending == ".so")
        fs::remove(entry.path());
  }

  void check_ports() const { PortCheck(rtl_, map_, ports()).run(kind_.pins(), parameters_); }
  TopPorts ports() const { return ports_of(read(header())); }
  Constants constants() const { return {map_, ports(), parameters_, rtl_.fault}; }
  /// Of the adapter.
  std::string source() const {
    return adapter_source(rtl_.top, map_, kind_.pins(), rtl_.traced, constants().code(), rtl_.counted);
  }

  /// A fingerprint of the command, the adapter, and all files that Verilator has read.
  std::string made_from(const std::string& command, const std::string& made) const {
    tb::Hash all;
    all.add(command);
    all.add(made);
    std::istringstream files(read(file("V" + rtl_.top + "__verFiles.dat")));  // S, numbers, "NAME"
    for (std::string line; std::getline(files, line);)
      if (line.rfind("S ", 0) == 0)
        all.add(read(line.substr(line.find('"') + 1, line.rfind('"') - line.find('"') - 1)));
    return fmt::format("{:016x}\n", all.value());
  }

  const UserRtl rtl_;
  const PinMap& map_;
  const tb::ChipKind& kind_;
  const std::vector<RtlParameter>& parameters_;
  std::string folder_;
};

/// Writes what the designs of a counted library have counted since the last call.
using WriteCounts = void (*)(const char* file);

/// It is loaded already.
WriteCounts counts_of(const std::string& library) {
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
  return reinterpret_cast<WriteCounts>(dlsym(handle, "dsdpv1_rtl_counts"));  // the conversion that POSIX prescribes
}

/// Verilator's records of them, through a file in `folder`.
std::string take_counts(WriteCounts write, const std::string& folder) {
  const std::string file = fmt::format("{}/counts.{}", folder, getpid());
  write(file.c_str());
  std::string records = read(file);
  fs::remove(file);
  return records;
}

}  // namespace

std::string verilator_version() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> said(popen("verilator --version 2>/dev/null", "r"), pclose);
  std::array<char, 256> line{};
  if (!said || std::fgets(line.data(), static_cast<int>(line.size()), said.get()) == nullptr) return "";
  const std::string text(line.data());
  return text.substr(0, text.find('\n'));
}

std::vector<std::string> untold(const PinMap& map, const tb::ChipKind& kind, const tb::OwnSettings& chip) {
  std::vector<std::string> keys;
  for (const RtlParameter& each : kind.rtl()->parameters(chip))
    if (!each.usual && map.chip.count(each.key) == 0) keys.emplace_back(each.key);
  return keys;
}

void check_parameters(const UserRtl& rtl, const PinMap& map, const tb::ChipKind& kind, const tb::OwnSettings& chip) {
  for (const std::string& key : untold(map, kind, chip))
    fail(rtl, map, 0,
         fmt::format("chip.{0} is not the default and the RTL is not told, expected chip: {{{0}: PARAMETER}} or chip: "
                     "{{{0}: {{port: INPUT}}}}",
                     key));
}

BuiltUserRtl build_user_rtl(const UserRtl& rtl, const PinMap& map, const tb::ChipKind& kind,
                            const tb::OwnSettings& chip) {
  check_top(rtl);
  if (!fs::is_directory(rtl.folder)) throw tb::InputError(rtl.folder, 0, "is no folder, expected one with RTL");
  check_parameters(rtl, map, kind, chip);
  check_fault(rtl, map);
  if (!installed("verilator"))
    throw tb::InputError(rtl.command + ": Verilator is missing, expected version 5.006 or later in PATH");
  const std::vector<RtlParameter> parameters = kind.rtl()->parameters(chip);
  UserRtl uncounted = rtl;
  uncounted.counted = false;
  Build others(uncounted, map, kind, parameters), first(rtl, map, kind, parameters);
  const RtlLibrary plain = others.library();
  const UserLibraries libraries{rtl.counted ? first.library() : plain, plain};
  BuiltUserRtl built;
  built.make = [libraries, &pins = kind.pins(), values = others.values()](const std::optional<RtlTrace>& trace) {
    return std::make_unique<UserDesigns>(libraries, pins, values, trace);
  };
  if (rtl.counted)
    built.counts = [write = counts_of(first.folder() + "/librtl.so"), folder = first.folder()] {
      return take_counts(write, folder);
    };
  return built;
}

}  // namespace dsdpv1::cosim
