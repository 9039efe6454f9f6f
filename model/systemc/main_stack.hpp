#pragma once
// Where the main thread's stack is, for AddressSanitizer.
//
// SystemC 2.3.4 tells AddressSanitizer when it switches to the stack of a process, but not well when it comes back: it
// switches to the main stack without saying where that is, and away from a process that has ended without a word. After
// the simulation the sanitizer knows no stack, or one that is freed. It then cannot tell who allocated a block, and
// never reports such a block as lost; and its search for leaks at the end of the program walks over the freed stack and
// crashes where pages are gone.

namespace dsdpv1::systemc {

/// Tells AddressSanitizer the main thread's own stack again: for a program that goes on after sc_start. Does nothing
/// inside of a SystemC thread, and in a build without AddressSanitizer.
void announce_main_stack();

/// The same once when the program ends, before leaks are looked for. `require_resolution` calls it, so every program
/// with a module has it.
void announce_main_stack_at_exit();

}  // namespace dsdpv1::systemc
