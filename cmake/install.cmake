# Installs the core, the driver and the SystemC modules, so that
#   find_package(dsdpv1)                     gives dsdpv1::core, dsdpv1::driver, dsdpv1::systemc and dsdpv1::driver_systemc
#   find_package(dsdpv1 COMPONENTS core)     gives dsdpv1::core and needs no SystemC
#   find_package(dsdpv1 COMPONENTS driver)   gives dsdpv1::driver, also without SystemC
# Headers keep their paths: #include "model/dsdpv1/chip.hpp".
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(DSDPV1_INSTALL_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR}/dsdpv1)
set(DSDPV1_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/dsdpv1)

# An archive of g++ that other compilers' programs link with, also where they optimise across files: templates' static members as weak
# symbols, which every linker merges, not as GNU's unique ones; and machine code beside what g++ alone reads (-flto).
function(dsdpv1_link_with_others target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fno-gnu-unique -ffat-lto-objects)
  endif()
endfunction()

# dsdpv1_install_targets(COMPONENT targets...): dsdpv1_NAME becomes dsdpv1::NAME, listed in dsdpv1-COMPONENT-targets.cmake.
function(dsdpv1_install_targets component)
  foreach(target ${ARGN})
    string(REPLACE dsdpv1_ "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    dsdpv1_link_with_others(${target})
  endforeach()
  install(TARGETS ${ARGN} EXPORT dsdpv1-${component}-targets COMPONENT dsdpv1
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT dsdpv1-${component}-targets NAMESPACE dsdpv1:: DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} COMPONENT dsdpv1)
endfunction()

function(dsdpv1_install_headers)
  install(DIRECTORY model registers driver DESTINATION ${DSDPV1_INSTALL_INCLUDEDIR} COMPONENT dsdpv1
          FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inc" PATTERN "dsdpv1*.h" PATTERN "dsdpv1_regs.svh"
          PATTERN "*_internal.h" EXCLUDE)
endfunction()

function(dsdpv1_install_package)
  set(config ${PROJECT_BINARY_DIR}/dsdpv1-config.cmake)
  set(version ${PROJECT_BINARY_DIR}/dsdpv1-config-version.cmake)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/dsdpv1-config.cmake.in ${config}
                                INSTALL_DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(${version} COMPATIBILITY SameMinorVersion)
  install(FILES ${config} ${version} ${PROJECT_SOURCE_DIR}/cmake/systemc.cmake
          DESTINATION ${DSDPV1_INSTALL_CMAKEDIR} COMPONENT dsdpv1)
endfunction()

# Called when the targets exist.
function(dsdpv1_install)
  # A static library records what it is linked with, so the warnings (no more than a list of compiler options) go along.
  dsdpv1_install_targets(core dsdpv1_warnings dsdpv1_registers dsdpv1_core)
  dsdpv1_install_targets(driver dsdpv1_driver)
  dsdpv1_install_targets(systemc dsdpv1_systemc dsdpv1_driver_systemc)
  dsdpv1_install_headers()
  dsdpv1_install_package()
endfunction()
