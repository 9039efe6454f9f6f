#pragma once
// Where the main thread's stack is, for AddressSanitizer.
//
// SystemC 2.3.4 tells AddressSanitizer when it switches to the stack of a process, but not correctly when it returns:
// it switches to the main stack without giving its place, and leaves an ended process without notice. After the
// simulation the sanitizer has no stack, or a freed one. It then cannot tell who allocated a block and never reports
// such a block as lost; and its leak search at the end of the program walks over the freed stack and crashes where
// pages are gone.

namespace dsdpv1::systemc {

/// Gives AddressSanitizer the main thread's stack again: for a program that continues after sc_start. Does nothing
/// inside a SystemC thread, and in a build without AddressSanitizer.
void announce_main_stack();

/// Does this once at program exit, before the leak search. `require_resolution` calls it, so every program with a
/// module has it.
void announce_main_stack_at_exit();

}  // namespace dsdpv1::systemc
