// Checks the sanitizer's leak scan in a SystemC program: ctest runs it with `held`, where it must find nothing, and
// with `lost`, where it must find the block. `held` ends the program inside of sc_main, with the block on the main
// thread's stack.
#include <cstdlib>
#include <cstring>
#include <memory>

#include "model/systemc/main_stack.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {
namespace {

/// Volatile: a compiler may omit an unused allocation.
std::unique_ptr<volatile int[]> make_block() {
  auto block = std::make_unique<volatile int[]>(1000);
  block[0] = 1;
  return block;
}

/// Out of line, so that no register and no live frame holds the address of the lost block.
[[gnu::noinline]] void lose_a_block() {
  static_cast<void>(make_block().release());
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): the leak scan must find it

}  // namespace

/// Processes that end and one that does not: SystemC leaves their stacks in different ways.
void simulate() {
  thread([] { wait_until(1 * kUs); });
  thread([] { wait_until(3 * kUs); });
  thread([] {
    for (;;) sc_core::wait(700, sc_core::SC_NS);
  });
  sc_core::sc_start(10, sc_core::SC_US);
}

}  // namespace dsdpv1

int sc_main(int argc, char* argv[]) {
  dsdpv1::systemc::require_resolution();
  const auto held = dsdpv1::make_block();
  dsdpv1::simulate();
  if (argc == 2 && std::strcmp(argv[1], "held") == 0) std::exit(EXIT_SUCCESS);
  dsdpv1::systemc::announce_main_stack();
  dsdpv1::lose_a_block();
  return EXIT_SUCCESS;
}
