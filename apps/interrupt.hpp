#pragma once
// Ctrl-C and its kind: before a run nothing is left, during a run it ends and completes its files.

namespace dsdpv1::app {

/// From now on SIGINT, SIGTERM and SIGHUP remove the temporary files and end the program with exit code 130. A reader
/// that goes away shows as an error of the write, not as SIGPIPE. To be called before the first file is opened.
void leave_nothing_on_signals();

/// From now on SIGINT, SIGTERM and SIGHUP are remembered, not obeyed. One more of them after 2 s, when the program's
/// own end has got stuck, kills and leaves what SIGKILL leaves. SIGHUP stays ignored where it was (nohup). Signals come
/// in twos when a shell or `timeout` sends them to the process and to its group.
void catch_signals();

/// True if one has come since.
bool interrupted();

}  // namespace dsdpv1::app
