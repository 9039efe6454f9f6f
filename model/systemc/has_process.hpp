#pragma once
// DSDPV1_HAS_PROCESS(Module): what SC_METHOD and SC_THREAD need up to IEEE 1666-2011; IEEE 1666-2023 makes it obsolete.
#include <systemc>

#if IEEE_1666_SYSTEMC < 202301L
#define DSDPV1_HAS_PROCESS(module) SC_HAS_PROCESS(module)
#else
#define DSDPV1_HAS_PROCESS(module) static_assert(true, "")
#endif
