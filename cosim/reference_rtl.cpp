#include "cosim/reference_rtl.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "io/input/input_error.hpp"

namespace dsdpv1::cosim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) {
  throw tb::InputError(what +
                       ", expected a complete build: ./run build (Verilator 5.006 or later), without it the engines "
                       "step and skip");
}

/// The file in rtl/ of this program's build, in a folder above the program, or in the installation.
fs::path find(const std::string& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (fs::path folder = program.parent_path(); folder != folder.root_path(); folder = folder.parent_path())
    for (const char* place : {"rtl", DSDPV1_RTL_INSTALLED})
      if (fs::exists(folder / place / name)) return folder / place / name;
  fail("the reference RTL is not built");
}

template <class Function>
Function symbol(void* library, const std::string& name) {
  return reinterpret_cast<Function>(
      dlsym(library, ("dsdpv1_rtl_" + name).c_str()));  // the conversion that POSIX prescribes for functions
}

class Design : public Rtl {
 public:
  Design(const RtlLibrary& library, const RtlStart& start) : library_(library), design_(library.create(&start)) {}
  ~Design() override { library_.destroy(design_); }
  Design(const Design&) = delete;
  Design& operator=(const Design&) = delete;

  void eval(bool clk, Level* levels) override { library_.eval(design_, clk, levels); }
  bool memory(std::uint8_t* image) const override {
    if (library_.memory == nullptr) return false;
    library_.memory(design_, image);
    return true;
  }

 private:
  const RtlLibrary library_;
  void* design_;
};

RtlLibrary load_reference(const std::string& name) {
  const fs::path path = find(name);
  std::string why_not;
  const RtlLibrary library = load_library(path, why_not);
  if (!why_not.empty()) fail("the reference RTL cannot be loaded: " + why_not);
  if (library.layout == nullptr || library.layout() != DSDPV1_RTL_LAYOUT)
    fail(path.string() + " is of another build than this program");
  return library;
}

}  // namespace

RtlLibrary load_library(const std::string& path, std::string& why_not) {
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    why_not = dlerror();
    return {};
  }
  RtlLibrary library;
  library.create = symbol<decltype(library.create)>(handle, "create");
  library.destroy = symbol<decltype(library.destroy)>(handle, "destroy");
  library.layout = symbol<decltype(library.layout)>(handle, "layout");
  library.eval = symbol<decltype(library.eval)>(handle, "eval");
  library.memory = symbol<decltype(library.memory)>(handle, "memory");
  library.trace = symbol<decltype(library.trace)>(handle, "trace");
  library.dump = symbol<decltype(library.dump)>(handle, "dump");
  return library;
}

RtlLibrary reference_library(const std::string& top, bool with_faults) {
  static std::mutex mutex;
  static std::map<std::string, RtlLibrary> loaded;
  const std::scoped_lock lock(mutex);
  const std::string name = fmt::format("lib{}_rtl{}.so", top, with_faults ? "_faults" : "");
  const auto found = loaded.find(name);
  return found != loaded.end() ? found->second : loaded.emplace(name, load_reference(name)).first->second;
}

std::unique_ptr<Rtl> make_design(const RtlLibrary& library, const RtlStart& start) {
  return std::make_unique<Design>(library, start);
}

MakeRtl reference_rtl(unsigned fault, std::uint32_t seed) {
  return [fault, seed](const std::string&, const tb::ChipKind& kind, const tb::OwnSettings& chip) {
    if (!kind.has_reference_rtl())
      throw tb::InputError(fmt::format(
          "the scenario has {}, and that kind has no reference RTL, expected RTL of yours: cosim, traces check --rtl",
          kind.name()));
    return kind.rtl()->make_reference(chip, fault, seed);
  };
}

}  // namespace dsdpv1::cosim
