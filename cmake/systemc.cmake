# Finds SystemC and TLM: target dsdpv1::systemc_library. The platform's own comes first: its target SystemC::systemc, then Accellera's CMake package
# SystemCLanguage, then pkg-config (Debian ships no CMake package). Used by the build and, installed, by dsdpv1-config.cmake.
#
# libsystemc exports a symbol with the C++ standard it was built for, and only programs in that standard link. The caller states the program's
# standard: C++17 by default, as in this project.
if(NOT TARGET SystemC::systemc)
  find_package(SystemCLanguage CONFIG QUIET)
endif()
if(TARGET SystemC::systemc)
  set(dsdpv1_systemc_found SystemC::systemc)
  set(dsdpv1_systemc_name "the platform's SystemC::systemc ${SystemCLanguage_VERSION}")
else()
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(SYSTEMC REQUIRED IMPORTED_TARGET systemc tlm)
  set(dsdpv1_systemc_found PkgConfig::SYSTEMC)
  set(dsdpv1_systemc_name "SystemC ${SYSTEMC_systemc_VERSION} in ${SYSTEMC_systemc_LIBDIR}")
endif()
if(NOT TARGET dsdpv1::systemc_library)
  add_library(dsdpv1::systemc_library INTERFACE IMPORTED)
  target_link_libraries(dsdpv1::systemc_library INTERFACE ${dsdpv1_systemc_found})
  get_target_property(dsdpv1_systemc_imported ${dsdpv1_systemc_found} IMPORTED)
  if(NOT dsdpv1_systemc_imported)  # the same project builds it: this project's warnings are not for its headers
    target_include_directories(dsdpv1::systemc_library SYSTEM INTERFACE $<TARGET_PROPERTY:${dsdpv1_systemc_found},INTERFACE_INCLUDE_DIRECTORIES>)
  endif()
endif()

# dsdpv1_systemc_links(STANDARD RESULT): whether a program in this C++ standard links with the SystemC found.
function(dsdpv1_systemc_links standard result)
  set(program ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/systemc_links.cpp)
  file(WRITE ${program} "#include <systemc>\nint sc_main(int, char**) { sc_core::sc_start(); return 0; }\n")
  try_compile(links SOURCES ${program} LINK_LIBRARIES ${dsdpv1_systemc_found} NO_CACHE
              CXX_STANDARD ${standard} CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  set(${result} ${links} PARENT_SCOPE)
endfunction()

function(dsdpv1_check_systemc)
  dsdpv1_systemc_links(17 links)
  if(links)
    set(DSDPV1_SYSTEMC_CHECKED "${dsdpv1_systemc_name} ${SYSTEMC_LINK_LIBRARIES}" CACHE INTERNAL "the SystemC that links with C++17")
    return()
  endif()
  foreach(standard 11 14 20 23)
    dsdpv1_systemc_links(${standard} links)
    if(links)
      message(FATAL_ERROR "${dsdpv1_systemc_name} was built for C++${standard}; this project needs one built "
                          "for C++17: build it with -DCMAKE_CXX_STANDARD=17, or use Debian's libsystemc-dev.")
    endif()
  endforeach()
  message(FATAL_ERROR "No program links with ${dsdpv1_systemc_name}, in no C++ standard from 11 to 23: "
                      "its headers and its library do not belong together, or it was built by another compiler.")
endfunction()

# A target that the same project builds has no library yet.
get_target_property(dsdpv1_systemc_imported ${dsdpv1_systemc_found} IMPORTED)
if(dsdpv1_systemc_imported AND NOT DSDPV1_SYSTEMC_CHECKED STREQUAL "${dsdpv1_systemc_name} ${SYSTEMC_LINK_LIBRARIES}")
  dsdpv1_check_systemc()
endif()
