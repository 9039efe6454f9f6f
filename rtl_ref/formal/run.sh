#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Unbounded proofs of the reference RTL and their broken twins: prints a table, exit 0 only when every proof holds and every twin is
# found. Arguments: names of proofs, by default all. OUT is the folder for models and logs, by default build/rtl-formal.
set -eu
cd "$(dirname "$0")"
exec python3 -B prove.py --out "${OUT:-../../build/rtl-formal}" "$@"
