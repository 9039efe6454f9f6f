#pragma once
// Ctrl-C and its kind, for commands that run long.

namespace app {

/// From now on SIGINT, SIGTERM and SIGHUP are remembered, not obeyed. One more of them after 2 s, when the program's own end has got
/// stuck, kills. Signals come in twos when a shell or `timeout` sends them to the process and to its group.
void catch_signals();

/// Whether one has come since.
bool interrupted();

}  // namespace app
