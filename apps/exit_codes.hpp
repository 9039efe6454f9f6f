#pragma once
// Exit codes of every command.

namespace dsdpv1::app {

constexpr int kPassed = 0;         ///< all checks and expectations passed
constexpr int kFailed = 1;         ///< a check or an expectation failed
constexpr int kNothingJudged = 3;  ///< no data exchange, and nothing was expected
constexpr int kWrongInput = 2;     ///< one line on the error channel says where, what, and what is allowed
constexpr int kInterrupted = 130;  ///< SIGINT or SIGTERM; all files are complete up to there

}  // namespace dsdpv1::app
