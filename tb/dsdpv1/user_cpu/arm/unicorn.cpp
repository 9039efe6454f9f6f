#include "tb/dsdpv1/user_cpu/arm/unicorn.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace arm {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(std::string("which needs Unicorn (Debian: libunicorn2): ") + dlerror());
}

template <class Function>
void find(void* library, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(dlsym(library, name));
  if (function == nullptr) fail();
}

}  // namespace

Unicorn::Unicorn(const std::string& library) {
  void* const loaded = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (loaded == nullptr) fail();
  find(loaded, "uc_open", open);
  find(loaded, "uc_close", close);
  find(loaded, "uc_ctl", ctl);
  find(loaded, "uc_strerror", strerror);
  find(loaded, "uc_hook_add", hook_add);
  find(loaded, "uc_hook_del", hook_del);
  find(loaded, "uc_mem_map_ptr", mem_map_ptr);
  find(loaded, "uc_mmio_map", mmio_map);
  find(loaded, "uc_reg_read", reg_read);
  find(loaded, "uc_reg_write", reg_write);
  find(loaded, "uc_emu_start", emu_start);
  find(loaded, "uc_emu_stop", emu_stop);
}

const Unicorn& unicorn() {
  static const Unicorn loaded("libunicorn.so." + std::to_string(UC_API_MAJOR));
  return loaded;
}

}  // namespace arm
