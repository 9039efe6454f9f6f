# What `cmake --install` installs, in components of the same names as those of find_package(dsdpv1 COMPONENTS ...) (docs/install.md):
#   core      the chips: dsdpv1::core, dsdpv1::xgate, dsdpv1::registers; needs nothing
#   driver    the C drivers: dsdpv1::driver, dsdpv1::driver_spc3, dsdpv1::driver_xgate; needs nothing
#   bus       segment, masters, monitor, GSD files: dsdpv1::bus
#   checks    the rules of the user's side: dsdpv1::checks
#   systemc   dsdpv1::systemc, dsdpv1::driver_systemc; together with bus dsdpv1::systemc_bus, dsdpv1::systemc_host
#   recorder  what the bench records, for chips in SystemC platforms: dsdpv1::recorder; needs bus, checks and systemc
#   bench     the bench and the commands, for chips of users' own: dsdpv1::bench, dsdpv1::commands; needs bus, checks and systemc
#   capi      libdsdpv1.so: dsdpv1::capi
#   dpi       for simulators: dsdpv1::dpi, dsdpv1::vpi, SystemVerilog
#   python    the module dsdpv1, cocotbext.profibus; the component wheel has what a wheel holds (bindings/python/CMakeLists.txt)
#   tools     the programs, their man page, completions and data (apps/CMakeLists.txt)
#   docs      documents, examples, licences
# A room with bindings (bindings/) calls dsdpv1_install_targets and dsdpv1_install_pc for its targets.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(DSDPV1_INSTALL_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR}/dsdpv1)
set(DSDPV1_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/dsdpv1)
set(DSDPV1_INSTALL_PYTHONDIR lib/python3/dist-packages)  # where Debian's Python finds it with the prefix /usr
set(DSDPV1_INSTALL_DATADIR ${CMAKE_INSTALL_DATADIR}/dsdpv1)

# Makes an archive of g++ that links with other compilers' programs, even with link-time optimisation: templates' static members as weak symbols,
# which every linker merges, instead of GNU's unique ones; and machine code beside the data that only g++ reads (-flto).
function(dsdpv1_link_with_others target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fno-gnu-unique -ffat-lto-objects)
  endif()
endfunction()

# A C++ interface lasts for a minor version. The sources of a shared library need no macro: everything is visible, and compiled once for both.
function(dsdpv1_version_library target)
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "" VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endfunction()

# Headers by the paths of this repository ("model/dsdpv1/chip.hpp"), and in an installation also as <dsdpv1/model/dsdpv1/chip.hpp>.
function(dsdpv1_export_includes target)
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>;$<INSTALL_INTERFACE:${DSDPV1_INSTALL_INCLUDEDIR};${CMAKE_INSTALL_INCLUDEDIR}>")
endfunction()

# Compiled-in libraries add no requirements for programs that link.
function(dsdpv1_export_links target)
  get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
  if(links)
    list(REMOVE_ITEM links "$<LINK_ONLY:dsdpv1_warnings>" "$<LINK_ONLY:nlohmann_json::nlohmann_json>")
    set_target_properties(${target} PROPERTIES INTERFACE_LINK_LIBRARIES "${links}")
  endif()
endfunction()

function(dsdpv1_prepare_target target)
  get_target_property(type ${target} TYPE)
  dsdpv1_link_with_others(${target})
  if(NOT type STREQUAL "EXECUTABLE")
    dsdpv1_export_links(${target})
  endif()
  if(NOT target MATCHES "_(capi|dpi|vpi)$" AND NOT type STREQUAL "EXECUTABLE")  # those have an interface of their own
    dsdpv1_export_includes(${target})
    if(type STREQUAL "SHARED_LIBRARY")
      dsdpv1_version_library(${target})
    endif()
  endif()
endfunction()

# dsdpv1_install_targets(COMPONENT EXPORT targets...): dsdpv1_NAME becomes dsdpv1::NAME, listed in dsdpv1-EXPORT-targets.cmake.
function(dsdpv1_install_targets component export)
  foreach(target ${ARGN})
    string(REGEX REPLACE "^dsdpv1_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    dsdpv1_prepare_target(${target})
  endforeach()
  install(TARGETS ${ARGN} EXPORT dsdpv1-${export}-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
  install(EXPORT dsdpv1-${export}-targets NAMESPACE dsdpv1:: DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} COMPONENT ${component})
endfunction()

# dsdpv1_install_headers(COMPONENT folders...): their headers with their paths, folders in them included.
function(dsdpv1_install_headers component)
  install(DIRECTORY ${ARGN} DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR} COMPONENT ${component}
          FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inc" PATTERN "dsdpv1*.h" PATTERN "spc3*.h" PATTERN "xgate*.h" PATTERN "dsdpv1_regs.svh"
          PATTERN "*_internal.h" EXCLUDE PATTERN "capture" EXCLUDE PATTERN "systemc" EXCLUDE)
endfunction()

# dsdpv1_install_former_header(COMPONENT ROOT FORMER NOW): installs at FORMER, the path before 0.2, a header that includes NOW. Will be removed with
# 0.4.
function(dsdpv1_install_former_header component root former now)
  cmake_path(GET former PARENT_PATH folder)
  file(RELATIVE_PATH way /${folder} /${now})
  set(file ${PROJECT_BINARY_DIR}/former/${former})
  set(message "#pragma message(\"${former} is deprecated: include ${now}\")\n")
  if(former MATCHES "\\.inc$")  # included in the middle of a declaration, where no pragma may stand
    set(message)
  endif()
  file(CONFIGURE OUTPUT ${file} CONTENT "${message}#include \"${way}\"\n")
  install(FILES ${file} DESTINATION ${root}/${folder} COMPONENT ${component})
endfunction()

# dsdpv1_install_pc(COMPONENT NAME DESCRIPTION [LIBS libraries...] [REQUIRES modules...]): NAME.pc for pkg-config; programs that link with archives
# need the archives' requirements, while a shared library brings its own.
function(dsdpv1_install_pc component name description)
  cmake_parse_arguments(ARG "SHARED" "" "LIBS;REQUIRES" ${ARGN})
  set(requires_word Requires)
  if(ARG_SHARED OR BUILD_SHARED_LIBS)
    set(requires_word Requires.private)
  endif()
  list(TRANSFORM ARG_LIBS PREPEND "-l")
  list(JOIN ARG_LIBS " " libs)
  list(JOIN ARG_REQUIRES ", " requires)
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" up ${up})
  set(file ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/dsdpv1.pc.in ${file} @ONLY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endfunction()

function(dsdpv1_install_package)
  set(config ${PROJECT_BINARY_DIR}/dsdpv1-config.cmake)
  set(version ${PROJECT_BINARY_DIR}/dsdpv1-config-version.cmake)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/dsdpv1-config.cmake.in ${config}
                                INSTALL_DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(${version} COMPATIBILITY SameMinorVersion)
  # Installed with every component, because each may be the only one.
  foreach(component core driver bus checks systemc recorder bench capi dpi python tools)
    install(FILES ${config} ${version} ${PROJECT_SOURCE_DIR}/cmake/systemc.cmake
            DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} COMPONENT ${component})
  endforeach()
endfunction()

function(dsdpv1_install_core_and_driver)
  dsdpv1_install_targets(core core dsdpv1_registers dsdpv1_core dsdpv1_xgate)
  dsdpv1_install_headers(core model registers)
  dsdpv1_install_pc(core dsdpv1-core "cycle-accurate model of the DSDPV1: the chip" LIBS dsdpv1_core)
  dsdpv1_install_pc(core dsdpv1-xgate "the XGate-DPS10, a module with a DPV1 slave" LIBS dsdpv1_xgate REQUIRES dsdpv1-core)
  dsdpv1_install_targets(driver driver dsdpv1_driver dsdpv1_driver_spc3 dsdpv1_driver_xgate)
  dsdpv1_install_headers(driver driver registers)
  dsdpv1_install_pc(driver dsdpv1-driver "drivers for the DSDPV1, the SPC3 family and the XGate-DPS10, in C99"
                    LIBS dsdpv1_driver dsdpv1_driver_spc3 dsdpv1_driver_xgate)
endfunction()

# dsdpv1_install_moved_headers(ROOM FORMER [NAME]): installs the headers of ROOM, or the one with this name, also at their former paths.
function(dsdpv1_install_moved_headers room former)
  set(name *)
  if(ARGN)
    set(name ${ARGN})
  endif()
  file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR}/${room} CONFIGURE_DEPENDS ${room}/${name}.hpp ${room}/${name}.inc)
  foreach(header ${headers})
    install(FILES ${room}/${header} DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/${room} COMPONENT checks)
    dsdpv1_install_former_header(checks ${DSDPV1_INSTALL_INCLUDEDIR} ${former}/${header} ${room}/${header})
  endforeach()
endfunction()

function(dsdpv1_install_bus_and_checks)
  dsdpv1_install_targets(bus bus dsdpv1_bus)
  dsdpv1_install_headers(bus bus)
  dsdpv1_install_pc(bus dsdpv1-bus "PROFIBUS segment, masters, monitor and GSD files" LIBS dsdpv1_bus REQUIRES fmt)
  dsdpv1_install_targets(checks checks dsdpv1_pins dsdpv1_check_recorder dsdpv1_checks)
  dsdpv1_install_moved_headers(tb/chip/pins tb/pins)
  dsdpv1_install_moved_headers(tb/chip/checks tb/checks)
  dsdpv1_install_moved_headers(kinds/dsdpv1/checks tb/dsdpv1/checks)
  dsdpv1_install_moved_headers(kinds/dsdpv1/pins tb/dsdpv1/pins pin_table)
  foreach(header host_telegram serial_settings spi_frame_reader)  # the readers that the checks share
    install(FILES kinds/dsdpv1/port/${header}.hpp DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/kinds/dsdpv1/port COMPONENT checks)
  endforeach()
  install(FILES tb/chip/user_cpu/place.hpp DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/tb/chip/user_cpu COMPONENT checks)  # of a violation
  dsdpv1_install_pc(checks dsdpv1-checks "checks of handshake, bus timing and use of the DSDPV1's DPRAM"
                    LIBS dsdpv1_checks dsdpv1_check_recorder dsdpv1_pins REQUIRES dsdpv1-core dsdpv1-bus fmt)
endfunction()

function(dsdpv1_install_systemc)
  dsdpv1_install_targets(systemc systemc dsdpv1_systemc dsdpv1_driver_systemc)
  dsdpv1_install_targets(systemc systemc_bus dsdpv1_systemc_bus)
  dsdpv1_install_targets(systemc systemc_host dsdpv1_systemc_host dsdpv1_host dsdpv1_output dsdpv1_socket)
  foreach(room model/systemc driver/systemc tb/systemc)
    install(DIRECTORY ${room}/ DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/${room} COMPONENT systemc FILES_MATCHING PATTERN "*.hpp")
  endforeach()
  install(DIRECTORY tb/serve/ DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/tb/serve COMPONENT systemc FILES_MATCHING PATTERN "*.hpp" PATTERN "run" EXCLUDE)
  install(FILES io/input/descriptor.hpp DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/io/input COMPONENT systemc)
  dsdpv1_install_pc(systemc dsdpv1-systemc "cycle-accurate model of the DSDPV1: SystemC modules"
                    LIBS dsdpv1_driver_systemc dsdpv1_systemc REQUIRES dsdpv1-core dsdpv1-driver systemc tlm)
  dsdpv1_install_pc(systemc dsdpv1-systemc-bus "PROFIBUS segment and masters in SystemC's time"
                    LIBS dsdpv1_systemc_bus REQUIRES dsdpv1-systemc dsdpv1-bus)
  dsdpv1_install_pc(systemc dsdpv1-systemc-host "PROFIBUS masters outside of a SystemC platform, in real time"
                    LIBS dsdpv1_systemc_host dsdpv1_host dsdpv1_output dsdpv1_socket REQUIRES dsdpv1-systemc-bus fmt)
endfunction()

function(dsdpv1_install_recorder)
  dsdpv1_install_targets(recorder recorder dsdpv1_recorder_whole)
  set_target_properties(dsdpv1_recorder_whole PROPERTIES EXPORT_NAME recorder)
  install(FILES kinds/systemc/chip_recorder.hpp DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/kinds/systemc COMPONENT recorder)
  dsdpv1_install_pc(recorder dsdpv1-recorder "checks, summary, waves and captures of a chip in a SystemC platform" LIBS dsdpv1_recorder boost_context z dl
                    REQUIRES dsdpv1-systemc dsdpv1-xgate dsdpv1-checks fmt yaml-cpp pugixml)
endfunction()

# Called by apps/, whose targets these are.
function(dsdpv1_install_bench)
  dsdpv1_install_targets(bench bench dsdpv1_bench_whole dsdpv1_commands_whole)
  set_target_properties(dsdpv1_bench_whole PROPERTIES EXPORT_NAME bench)
  set_target_properties(dsdpv1_commands_whole PROPERTIES EXPORT_NAME commands)
  foreach(room io tb bus/capture)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room}/ DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/${room} COMPONENT bench FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inc")
  endforeach()
  install(FILES ${PROJECT_SOURCE_DIR}/apps/program.hpp DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR}/apps COMPONENT bench)
  dsdpv1_install_pc(bench dsdpv1-bench "bench for DP slave chips, and a kit for chips of one's own" LIBS dsdpv1_bench boost_context minizip lzma md z dl
                    REQUIRES dsdpv1-checks dsdpv1-xgate dsdpv1-driver yaml-cpp pugixml)
  dsdpv1_install_pc(bench dsdpv1-commands "the commands of dsdpv1-sim, for programs with chips of one's own" LIBS dsdpv1_commands
                    REQUIRES dsdpv1-bench dsdpv1-systemc-bus)
endfunction()

function(dsdpv1_install_capi)
  dsdpv1_install_targets(capi capi dsdpv1_capi)
  install(DIRECTORY include/dsdpv1/ DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR} COMPONENT capi FILES_MATCHING PATTERN "*.h")
  dsdpv1_install_pc(capi dsdpv1-capi "the DSDPV1 with bus, masters, checks and scenarios, in C" SHARED LIBS dsdpv1)
endfunction()

# The libraries that simulators load, beside libdsdpv1.so, and the sources that they compile.
function(dsdpv1_install_dpi)
  if(NOT TARGET dsdpv1_dpi)
    return()
  endif()
  set(targets dsdpv1_dpi)
  if(TARGET dsdpv1_vpi)
    list(APPEND targets dsdpv1_vpi)
  endif()
  dsdpv1_install_targets(dpi dpi ${targets})
  if(TARGET dsdpv1_modules)  # not with a sanitizer
    install(DIRECTORY ${PROJECT_BINARY_DIR}/bindings/systemverilog DESTINATION ${DSDPV1_INSTALL_DATADIR}/bindings COMPONENT dpi)
  endif()
endfunction()

# The Python packages, in the place of Debian's. They load the library of the component capi through a link.
function(dsdpv1_install_python)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/bindings/python/dsdpv1 bindings/cocotb/cocotbext DESTINATION ${DSDPV1_INSTALL_PYTHONDIR} COMPONENT python
          PATTERN "__pycache__" EXCLUDE)
  set(folder ${DSDPV1_INSTALL_PYTHONDIR}/dsdpv1/lib)
  get_target_property(number dsdpv1_capi SOVERSION)
  set(library libdsdpv1.so.${number})
  file(RELATIVE_PATH target /${folder} /${CMAKE_INSTALL_LIBDIR}/${library})
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/python)
  file(CREATE_LINK ${target} ${PROJECT_BINARY_DIR}/python/${library} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/python/${library} DESTINATION ${folder} COMPONENT python)

  file(RELATIVE_PATH target /${DSDPV1_INSTALL_CMAKEDIR} /${DSDPV1_INSTALL_PYTHONDIR})
  set(file ${PROJECT_BINARY_DIR}/dsdpv1-python-targets.cmake)
  file(WRITE ${file} "# For PYTHONPATH.\ncmake_path(SET dsdpv1_PYTHON_DIR NORMALIZE \"\${CMAKE_CURRENT_LIST_DIR}/${target}\")\n")
  install(FILES ${file} DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} COMPONENT python)
endfunction()

function(dsdpv1_install_docs)
  install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE REUSE.toml DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
  install(DIRECTORY docs LICENSES DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs PATTERN "*.py" EXCLUDE)
  install(DIRECTORY examples DESTINATION ${DSDPV1_INSTALL_DATADIR} COMPONENT docs PATTERN ".clang-tidy" EXCLUDE)
  # Sources used by firmware, for the example and for products.
  install(DIRECTORY driver DESTINATION ${DSDPV1_INSTALL_DATADIR} COMPONENT docs
          FILES_MATCHING PATTERN "*.c" PATTERN "*.h" PATTERN "systemc" EXCLUDE)
  install(FILES registers/dsdpv1_regs.h registers/spc3_regs.h DESTINATION ${DSDPV1_INSTALL_DATADIR}/registers COMPONENT docs)
  install(FILES board/firmware/mailbox.h DESTINATION ${DSDPV1_INSTALL_DATADIR}/board/firmware COMPONENT docs)
  dsdpv1_install_former_header(docs ${DSDPV1_INSTALL_DATADIR} tb/dsdpv1/user_cpu/arm/mailbox.h board/firmware/mailbox.h)
endfunction()

# --component dsdpv1, once the only one: core, driver and SystemC modules as before. Will be removed with 0.3 (docs/install.md).
function(dsdpv1_install_former_component)
  install(CODE [[
    foreach(component core driver systemc bus)
      execute_process(COMMAND ${CMAKE_COMMAND} -D CMAKE_INSTALL_PREFIX=${CMAKE_INSTALL_PREFIX} -D CMAKE_INSTALL_COMPONENT=${component}
                              -P ${CMAKE_CURRENT_LIST_FILE} COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
    message(NOTICE "--component dsdpv1 is deprecated: use core, driver, systemc or bus (docs/install.md)")]]
    COMPONENT dsdpv1 EXCLUDE_FROM_ALL)
endfunction()

# The bill of materials of an installation, made last because installing changes programs.
function(dsdpv1_install_sbom)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(lib ${CMAKE_INSTALL_LIBDIR})
  set(files ${CMAKE_INSTALL_BINDIR}/dsdpv1-sim ${lib}/libdsdpv1.so ${lib}/libdsdpv1_dpi.so ${lib}/dsdpv1.vpi)
  list(TRANSFORM files PREPEND "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/")
  set(folder "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}")
  install(CODE "file(MAKE_DIRECTORY \"${folder}\")
    execute_process(COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/cmake/sbom.py \"${folder}/dsdpv1.spdx.json\" ${PROJECT_VERSION} ${files}
                    COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT docs)
endfunction()

# Builds everything that is installed, without tests: `./run examples`.
function(dsdpv1_installed_target)
  add_custom_target(dsdpv1_installed)
  foreach(target core xgate driver driver_spc3 driver_xgate bus checks systemc driver_systemc systemc_bus systemc_host recorder_whole bench_whole commands_whole capi dpi vpi modules python pages rtl_libraries firmware)
    if(TARGET dsdpv1_${target})
      add_dependencies(dsdpv1_installed dsdpv1_${target})
    endif()
  endforeach()
endfunction()

# Called when the targets exist.
function(dsdpv1_install)
  dsdpv1_install_core_and_driver()
  dsdpv1_install_bus_and_checks()
  dsdpv1_install_systemc()
  dsdpv1_install_recorder()
  dsdpv1_install_capi()
  dsdpv1_install_dpi()
  dsdpv1_install_python()
  dsdpv1_install_docs()
  dsdpv1_install_package()
  dsdpv1_install_former_component()
endfunction()
