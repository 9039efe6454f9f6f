// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Declarations shared by this chip's blocks (dsdpv1/), in addition to those of the DPRAM and of every DP slave.
`ifndef DSDPV1_TYPES_SVH
`define DSDPV1_TYPES_SVH
`include "dpram_types.svh"

// The parameters of the rulings are inputs of the blocks, which the top ties to its parameters: constants for a synthesis. In a build
// with DSDPV1_RUN_TIME_LIMITS, for simulation only, the top has inputs instead, to be held during a run, and so one build serves for
// all values. `LIMIT(PARAMETER, port) is the one or the other.
`ifdef DSDPV1_RUN_TIME_LIMITS
`define LIMIT(parameter_name, port) port
`else
`define LIMIT(parameter_name, port) parameter_name
`endif

`endif
