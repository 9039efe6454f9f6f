#pragma once
// The reason for an event: one row of a table, identified by its address. Every room of the model has its own table
// (reasons.inc: those of every DP slave; a chip adds its rooms'), so that no room depends on another's.
#include <cstddef>
#include <cstdint>
#include <functional>

namespace dsdpv1::profibus {

/// The kind of event: decides how it is counted and shown.
enum class Severity : std::uint8_t {
  kInfo,       ///< a state change or a service that was carried out
  kRefusal,    ///< the chip refused something that a master or the user asked for
  kViolation,  ///< the user's side broke a rule of the host port or the handshake
};

// X(identifier, severity, stable code, source, text, advice). The source: rulings of docs/chip.md and docs/chip_rsu.md
// (S6) and clauses of docs/conformance.md (T19-4) that make the chip say this, separated by commas. The text may hold
// {a}, {b}, {c} (decimal), {a:4x} (hexadecimal, 4 digits), {a:ns} (ticks of 1/12 ns, as a time), {a:state} (of DP),
// {a:rate} (of baud), {a:sap} (a SAP or none), {a:rm} (a row of the RM registry), {a:block} (a telegram for the user),
// {a:high} and {a:low} (its bytes), {a:low2x}. Text and advice may hold names of words.inc, as {sync}, replaced by the
// chip's words. docs/reasons.md explains each reason of the chip; it comes from the tables.
struct ReasonRow {
  Severity severity;
  const char *code, *source, *text, *advice;
};

namespace detail {
enum class ReasonIndex : std::size_t {
#define X(id, ...) id,
#include "model/profibus/reasons.inc"
#undef X
  kCount
};
extern const ReasonRow kReasonRows[static_cast<std::size_t>(ReasonIndex::kCount)];
}  // namespace detail

/// As small as a pointer, compared by name: `event.reason == Reason::kPrmIdent`.
class Reason {
 public:
  constexpr Reason() = default;  ///< none yet: assign before use
  constexpr explicit Reason(const ReasonRow& row) : row_(&row) {}

#define X(id, ...) static const Reason id;
#include "model/profibus/reasons.inc"
#undef X

  const ReasonRow& row() const { return *row_; }
  friend constexpr bool operator==(Reason a, Reason b) { return a.row_ == b.row_; }
  friend constexpr bool operator!=(Reason a, Reason b) { return a.row_ != b.row_; }
  /// Some order, for containers.
  friend bool operator<(Reason a, Reason b) { return std::less<>()(a.row_, b.row_); }

 private:
  const ReasonRow* row_ = nullptr;
};

#define X(id, ...) \
  inline constexpr Reason Reason::id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "model/profibus/reasons.inc"
#undef X

/// The stable code of a reason ("PRM_IDENT"), for logs and result files.
inline const char* code(Reason reason) { return reason.row().code; }
inline Severity severity(Reason reason) { return reason.row().severity; }

/// The rows of one room, for listing.
struct ReasonTable {
  const ReasonRow* rows;
  std::size_t size;

  const ReasonRow* begin() const { return rows; }
  const ReasonRow* end() const { return rows + size; }
};
/// The reasons that every DP slave may have.
ReasonTable reasons();

}  // namespace dsdpv1::profibus
