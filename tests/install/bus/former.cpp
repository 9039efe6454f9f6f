// Headers at their paths of before 0.2, deprecated since (CHANGELOG.md): each is still there and is the one that moved.
#include <cstddef>
#include <dsdpv1/tb/checks/check.hpp>
#include <dsdpv1/tb/checks/chip_checks.hpp>
#include <dsdpv1/tb/checks/histogram.hpp>
#include <dsdpv1/tb/checks/pin_history.hpp>
#include <dsdpv1/tb/checks/recorder.hpp>
#include <dsdpv1/tb/dsdpv1/checks/blocks.hpp>
#include <dsdpv1/tb/dsdpv1/checks/cell_rules.hpp>
#include <dsdpv1/tb/dsdpv1/checks/check.hpp>
#include <dsdpv1/tb/dsdpv1/checks/checks.hpp>
#include <dsdpv1/tb/dsdpv1/checks/host_telegram.hpp>
#include <dsdpv1/tb/dsdpv1/checks/markdown.hpp>
#include <dsdpv1/tb/dsdpv1/checks/ownership.hpp>
#include <dsdpv1/tb/dsdpv1/checks/port_timing.hpp>
#include <dsdpv1/tb/dsdpv1/checks/rxd_sampler.hpp>
#include <dsdpv1/tb/dsdpv1/checks/serial_settings.hpp>
#include <dsdpv1/tb/dsdpv1/checks/service.hpp>
#include <dsdpv1/tb/dsdpv1/checks/spi_frames.hpp>
#include <dsdpv1/tb/dsdpv1/checks/spi_timing.hpp>
#include <dsdpv1/tb/dsdpv1/checks/uart_frames.hpp>
#include <dsdpv1/tb/dsdpv1/pins/pin_table.hpp>
#include <dsdpv1/tb/pins/pins.hpp>

#define X(enumerator, ...) +1
static_assert(0U
#include <dsdpv1/tb/dsdpv1/checks/check_table.inc>
              == sizeof(dsdpv1::checks::kAllChecks) / sizeof(dsdpv1::checks::kAllChecks[0]));
