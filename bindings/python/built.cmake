# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
# Makes a wheel from an existing build: pip wheel . --config-settings cmake.define.DSDPV1_BUILD=$PWD/build/default
add_custom_target(dsdpv1_capi)
add_custom_target(dsdpv1_python)
install(CODE "
  execute_process(COMMAND \"${CMAKE_COMMAND}\" --install \"${DSDPV1_BUILD}\" --component wheel --prefix \"\${CMAKE_INSTALL_PREFIX}\"
                  COMMAND_ERROR_IS_FATAL ANY)" COMPONENT wheel)
