#pragma once

namespace dsdpv1::app {

/// The program needs 512 KB of stack: where less is allowed it allows itself more. False when it may not, with a line
/// on the error channel. The first thing of all: the reader of line tables (libdw) puts up to 160 KB of them on the
/// stack at once.
bool ensure_stack();

}  // namespace dsdpv1::app
