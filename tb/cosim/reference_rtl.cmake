# The reference RTL as two shared libraries in the folder rtl/ of the build: the RTL as it is, and the one with single faults.
# Their target dsdpv1_rtl_libraries is part of `all` and of nothing else; the program loads them when it is asked for RTL (reference_rtl.hpp).
set(DSDPV1_RTL_DIR ${PROJECT_SOURCE_DIR}/rtl_ref CACHE PATH "Folder of the reference RTL: files.txt and what it names")
mark_as_advanced(DSDPV1_RTL_DIR)
set(rtl_dir ${DSDPV1_RTL_DIR})
set(rtl_folder ${PROJECT_BINARY_DIR}/rtl)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${rtl_dir}/files.txt)
file(STRINGS ${rtl_dir}/files.txt rtl_sources)
list(TRANSFORM rtl_sources PREPEND ${rtl_dir}/)

# dsdpv1_rtl_library(NAME MACROS...): lib<NAME>.so, RTL and adapter with these macros (-D). Verilator's own make keeps it out of the
# configuration, which every `./run` waits for.
function(dsdpv1_rtl_library name)
  set(library ${rtl_folder}/lib${name}.so)
  set(adapter ${CMAKE_CURRENT_SOURCE_DIR}/reference_library.cpp)
  list(JOIN ARGN " " macros)
  set(compile "-O3 -fPIC -std=c++17 -I${PROJECT_SOURCE_DIR} -DDSDPV1_RTL_LAYOUT=${DSDPV1_RTL_LAYOUT} ${macros}")
  add_custom_command(
    OUTPUT ${library}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${rtl_folder}
    COMMAND ${DSDPV1_VERILATOR} --cc --exe --build -O3 --x-assign fast --x-initial unique -DDSDPV1_RUN_TIME_LIMITS -I${rtl_dir} -I${PROJECT_SOURCE_DIR}/registers
            --top-module dsdpv1 --Mdir ${rtl_folder}/${name} -CFLAGS ${compile} -LDFLAGS -shared
            -MAKEFLAGS "-s CXX=${CMAKE_CXX_COMPILER} OBJCACHE=${CMAKE_CXX_COMPILER_LAUNCHER} OPT_FAST= OPT_GLOBAL=" -o ${library} ${ARGN}
            ${CMAKE_CURRENT_SOURCE_DIR}/public.vlt ${rtl_sources} ${adapter}
    DEPENDS ${rtl_sources} ${rtl_dir}/dsdpv1_types.svh ${PROJECT_SOURCE_DIR}/registers/dsdpv1_regs.svh ${adapter}
            ${CMAKE_CURRENT_SOURCE_DIR}/public.vlt ${CMAKE_CURRENT_SOURCE_DIR}/rtl_top.hpp ${CMAKE_CURRENT_SOURCE_DIR}/verilated_top.hpp
    COMMENT "Verilating ${name}"
    VERBATIM)
  set_property(TARGET dsdpv1_rtl_libraries APPEND PROPERTY SOURCES ${library})
endfunction()

dsdpv1_rtl_library(dsdpv1_rtl)
dsdpv1_rtl_library(dsdpv1_rtl_faults -DDSDPV1_FAULTS)
