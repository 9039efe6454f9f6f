// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into station where telegram_rx is free: by its construction nothing is decided in the cycle in which a rate is selected.
always @* assume (!(decide && restart));
