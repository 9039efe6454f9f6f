# Finds SystemC and TLM through pkg-config (Debian ships no CMake package): target PkgConfig::SYSTEMC.
# Used by the build and, installed, by dsdpv1-config.cmake.
#
# libsystemc exports a symbol with the C++ standard it was built for, and only programs in that standard link. The caller states the program's
# standard: C++17 by default, as in this project.
find_package(PkgConfig REQUIRED)
pkg_check_modules(SYSTEMC REQUIRED IMPORTED_TARGET systemc tlm)

# dsdpv1_systemc_links(STANDARD RESULT): whether a program in this C++ standard links with the SystemC found.
function(dsdpv1_systemc_links standard result)
  set(program ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/systemc_links.cpp)
  file(WRITE ${program} "#include <systemc>\nint sc_main(int, char**) { sc_core::sc_start(); return 0; }\n")
  try_compile(links SOURCES ${program} LINK_LIBRARIES PkgConfig::SYSTEMC NO_CACHE
              CXX_STANDARD ${standard} CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  set(${result} ${links} PARENT_SCOPE)
endfunction()

function(dsdpv1_check_systemc)
  dsdpv1_systemc_links(17 links)
  if(links)
    set(DSDPV1_SYSTEMC_CHECKED "${SYSTEMC_systemc_VERSION} ${SYSTEMC_LINK_LIBRARIES}" CACHE INTERNAL "the SystemC that links with C++17")
    return()
  endif()
  foreach(standard 11 14 20 23)
    dsdpv1_systemc_links(${standard} links)
    if(links)
      message(FATAL_ERROR "SystemC ${SYSTEMC_systemc_VERSION} in ${SYSTEMC_systemc_LIBDIR} was built for C++${standard}; this project needs one built "
                          "for C++17: build it with -DCMAKE_CXX_STANDARD=17, or use Debian's libsystemc-dev.")
    endif()
  endforeach()
  message(FATAL_ERROR "No program links with SystemC ${SYSTEMC_systemc_VERSION} in ${SYSTEMC_systemc_LIBDIR}, in no C++ standard from 11 to 23: "
                      "its headers and its library do not belong together, or it was built by another compiler.")
endfunction()

if(NOT DSDPV1_SYSTEMC_CHECKED STREQUAL "${SYSTEMC_systemc_VERSION} ${SYSTEMC_LINK_LIBRARIES}")
  dsdpv1_check_systemc()
endif()
