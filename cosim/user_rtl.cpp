#include "cosim/user_rtl.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "cosim/reference_rtl.hpp"
#include "io/input/input_error.hpp"
#include "io/output/write_file.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::cosim {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Ctrl-C, which the command received as well.
bool was_interrupted(int status) {
  constexpr int kByShell = 128 + SIGINT;
  return (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) || (WIFEXITED(status) && WEXITSTATUS(status) == kByShell);
}

/// Runs a command with its output in a file; if it fails, the first error lines of the file are the message.
void call(const std::string& command, const std::string& log, const UserRtl& rtl) {
  const int status = std::system((command + " >" + quoted(log) + " 2>&1").c_str());
  if (status == 0) return;
  if (was_interrupted(status)) std::raise(SIGINT);  // system() has kept it from this process
  std::ifstream file(log);
  std::string first;
  for (std::string line; first.empty() && std::getline(file, line);)
    if (line.find("rror:") != std::string::npos || line.find("%Error") != std::string::npos) first = line;
  throw tb::InputError(fmt::format("{}: {}: {} (all of it in {}), expected RTL that Verilator 5.006 builds",
                                   rtl.command, rtl.top, first.empty() ? "failed" : first, log));
}

std::vector<std::string> sources(const UserRtl& rtl, const PinMap& map) {
  std::vector<std::string> files;
  for (const std::string& file : map.files) files.push_back(fs::absolute(fs::path(rtl.folder) / file).string());
  if (!files.empty()) return files;
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

/// Three designs that begin with zeros, with ones and with random values wherever nothing is initialised or reset
/// (Verilator's randReset). The first is traced.
class UserDesigns : public Rtl {
 public:
  UserDesigns(const RtlLibrary& library, const tb::PinTable& pins, std::optional<RtlTrace> trace)
      : library_(library), pins_(pins), trace_(std::move(trace)) {
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      RtlStart start;
      start.fill = static_cast<int>(i);
      designs_.at(i) = library.create(&start);
    }
    if (trace_) library_.trace(designs_.front(), trace_->file.c_str());
  }
  ~UserDesigns() override {
    if (trace_) dump();
    for (void* design : designs_) library_.destroy(design);
  }
  UserDesigns(const UserDesigns&) = delete;
  UserDesigns& operator=(const UserDesigns&) = delete;

  void eval(bool clk, Level* levels) override {
    std::array<Level, kMostPins> other{};
    std::copy_n(levels, pins_.size(), other.begin());
    library_.eval(designs_.front(), clk, levels);
    for (std::size_t i = 1; i < designs_.size(); ++i) {
      library_.eval(designs_.at(i), clk, other.data());
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
  void dump() {
    if (now_ >= trace_->from && now_ <= trace_->to)
      library_.dump(designs_.front(), static_cast<std::uint64_t>(tb::picoseconds(now_)));
  }

  const RtlLibrary library_;
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

std::string adapter_source(const std::string& top, const PinMap& map, const tb::PinTable& pins, bool traced) {
  std::string text = fmt::format(
      "// Generated: the pins of {0} for the co-simulation.\n"
      "#include \"V{0}.h\"\n#include \"verilated.h\"\n{1}#include <memory>\n\nnamespace {{\n"
      "struct Start {{\n  int fill;\n  unsigned seed, fault;\n  const void* parameters;\n}};\nstruct Design {{\n"
      "  VerilatedContext context;\n  std::unique_ptr<V{0}> model;\n{2}}};\n}}  // namespace\n\n"
      "extern \"C\" void* dsdpv1_rtl_create(const Start* start) {{\n  auto* design = new Design;\n"
      "  design->context.randReset(start->fill);\n  design->context.randSeed(static_cast<int>(start->seed));\n{3}"
      "  design->model = std::make_unique<V{0}>(&design->context);\n  return design;\n}}\n\n"
      "extern \"C\" void dsdpv1_rtl_destroy(void* self) {{\n  auto* design = static_cast<Design*>(self);\n"
      "  Verilated::threadContextp(&design->context);  // whose names the model takes out\n  delete design;\n"
      "  Verilated::threadContextp(Verilated::defaultContextp());\n}}\n{4}\n"
      "extern \"C\" void dsdpv1_rtl_eval(void* self, bool clk, short* levels) {{\n"
      "  V{0}& model = *static_cast<Design*>(self)->model;\n  model.{5} = {6}clk;\n",
      top, traced ? kTraceIncluded : "", traced ? kTraceMember : "",
      traced ? "  design->context.traceEverOn(true);\n" : "", traced ? kTraceFunctions : "", map.clock.name,
      map.clock.inverted ? "!" : "");
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

std::string verilator_command(const UserRtl& rtl, const PinMap& map, const std::string& build,
                              const std::string& adapter) {
  std::string command = "verilator --cc --exe -O3 -Wno-fatal --x-assign unique --x-initial unique -CFLAGS '-O2 -fPIC'";
  command += rtl.traced ? " --trace-fst --trace-structs -LDFLAGS '-shared -lz'" : " -LDFLAGS -shared";
  command += fmt::format(" --top-module {} --prefix V{} --Mdir {} -I{} -o librtl.so", rtl.top, rtl.top, quoted(build),
                         quoted(fs::absolute(rtl.folder).string()));
  for (const std::string& folder : map.include)
    command += " -I" + quoted(fs::absolute(fs::path(rtl.folder) / folder).string());
  if (map.reference)
    for (const std::string& folder : reference_folders(rtl)) command += " -I" + quoted(folder);
  for (const auto& [name, value] : map.parameters)
    command.append(" ").append(quoted(fmt::format("-G{}={}", name, value)));
  for (const std::string& source : sources(rtl, map)) command += " " + quoted(source);
  return command + " " + quoted(adapter);
}

/// Checks that every port in the map is one of the Verilated top, whose header declares them as VL_IN8(&name,7,0).
void check_ports(const UserRtl& rtl, const PinMap& map, const std::string& build) {
  std::ifstream file(fmt::format("{}/V{}.h", build, rtl.top));
  const std::string header{std::istreambuf_iterator<char>(file), {}};
  const auto check = [&](const std::string& pin, const std::string& name) {
    if (header.find("(&" + name + ",") != std::string::npos) return;
    throw tb::InputError(fmt::format("{}: {} has no port {} for {}, expected its ports, named in --pins", rtl.command,
                                     rtl.top, name, pin));
  };
  check("CLK", map.clock.name);
  for (const auto& [pin, port] : map.pins) check(pin, port.name);
}

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
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw tb::InputError(folder, 0, "cannot be created: " + error.message());
}

/// With ccache, if present: RTL that has been built before is not compiled again.
std::string make_command(const UserRtl& rtl, const std::string& build) {
  return fmt::format("{}make -s -j2 -C {} -f V{}.mk", installed("ccache") ? "OBJCACHE=ccache " : "", quoted(build),
                     rtl.top);
}

}  // namespace

MakeUserRtl build_user_rtl(const UserRtl& rtl, const PinMap& map, const tb::ChipKind& kind) {
  check_top(rtl);
  if (!fs::is_directory(rtl.folder)) throw tb::InputError(rtl.folder, 0, "is no folder, expected one with RTL");
  if (!installed("verilator"))
    throw tb::InputError(rtl.command + ": Verilator is missing, expected version 5.006 or later in PATH");
  const std::string build = fs::absolute(rtl.traced ? fs::path(rtl.build) / "traced" : fs::path(rtl.build)).string();
  create_folder(build);
  const std::string adapter = build + "/adapter.cpp";
  tb::write_file(adapter, adapter_source(rtl.top, map, kind.pins(), rtl.traced));

  call(verilator_command(rtl, map, build, adapter), build + "/verilator.log", rtl);
  check_ports(rtl, map, build);
  call(make_command(rtl, build), build + "/compiler.log", rtl);
  return [library = load(build + "/librtl.so"), &pins = kind.pins()](const std::optional<RtlTrace>& trace) {
    return std::make_unique<UserDesigns>(library, pins, trace);
  };
}

}  // namespace dsdpv1::cosim
