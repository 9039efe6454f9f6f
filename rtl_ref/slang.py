#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Lints with slang, as the package pyslang has it: slang.py ARGUMENTS OF slang. Exit 0 when it finds neither an error nor a warning."""
import shlex
import sys

from pyslang import driver


def main():
    slang = driver.Driver()
    slang.addStandardArgs()
    arguments = shlex.join(["slang", "-Wextra", "-Werror", *sys.argv[1:]])
    if not (slang.parseCommandLine(arguments, driver.CommandLineOptions()) and slang.processOptions() and slang.parseAllSources()):
        sys.exit(1)
    compilation = slang.createCompilation()
    slang.reportCompilation(compilation, True)
    slang.runAnalysis(compilation)
    sys.exit(0 if slang.reportDiagnostics(True) else 1)


if __name__ == "__main__":
    main()
