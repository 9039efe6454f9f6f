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

using Layout = std::uint32_t (*)();
using Make = RtlTop* (*)(const dsdpv1::Config* config, std::uint32_t fault, std::uint32_t seed);

[[noreturn]] void fail(const std::string& what) {
  throw tb::InputError(what +
                       ", allowed is a complete build: ./run build (Verilator 5.006 or later), without it the engines "
                       "step and skip");
}

/// The folder rtl/ of the build that this program belongs to, beside one of the folders above the program; or of the
/// installation.
fs::path find(const std::string& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (fs::path folder = program.parent_path(); folder != folder.root_path(); folder = folder.parent_path())
    for (const char* place : {"rtl", DSDPV1_RTL_INSTALLED})
      if (fs::exists(folder / place / name)) return folder / place / name;
  fail("the reference RTL is not built");
}

template <class Function>
Function symbol(void* library, const char* name) {
  return reinterpret_cast<Function>(dlsym(library, name));  // the way POSIX gives for functions
}

/// Stays loaded to the end of the program: designs may live as long.
Make load(const std::string& name) {
  const fs::path path = find(name);
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(std::string("the reference RTL cannot be loaded: ") + dlerror());
  const auto layout = symbol<Layout>(library, "dsdpv1_rtl_layout");
  if (layout == nullptr || layout() != DSDPV1_RTL_LAYOUT)
    fail(path.string() + " is of another build than this program");
  return symbol<Make>(library, "dsdpv1_rtl_make");
}

/// Of the part's RTL; `kind` is empty or "_faults".
Make make_of(const dsdpv1::Config& config, const char* kind) {
  static std::mutex mutex;
  static std::map<std::string, Make> loaded;
  const std::scoped_lock lock(mutex);
  const std::string name = fmt::format("libdsdpv1{}_rtl{}.so", dsdpv1::row(config.part).rtl, kind);
  const auto found = loaded.find(name);
  return found != loaded.end() ? found->second : loaded.emplace(name, load(name)).first->second;
}

}  // namespace

std::unique_ptr<RtlTop> make_reference_rtl(const dsdpv1::Config& config, std::uint32_t seed) {
  return std::unique_ptr<RtlTop>(make_of(config, "")(&config, 0, seed));
}

std::unique_ptr<RtlTop> make_faulty_rtl(const dsdpv1::Config& config, unsigned fault, std::uint32_t seed) {
  return std::unique_ptr<RtlTop>(make_of(config, "_faults")(&config, fault, seed));
}

}  // namespace dsdpv1::cosim
