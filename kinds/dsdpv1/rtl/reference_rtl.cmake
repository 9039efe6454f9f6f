# The reference RTL as shared libraries in the folder rtl/ of the build, two for each top: the RTL as it is, and the one with single faults.
# Their target dsdpv1_rtl_libraries is part of `all` and of nothing else; the program loads them when it is asked for RTL (reference_rtl.hpp).
set(DSDPV1_RTL_DIR ${PROJECT_SOURCE_DIR}/rtl_ref CACHE PATH "Folder of the reference RTL: a folder for each top with its files.txt, and what that names")
mark_as_advanced(DSDPV1_RTL_DIR)
set(rtl_dir ${DSDPV1_RTL_DIR})
file(GLOB lists CONFIGURE_DEPENDS ${rtl_dir}/*/files.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lists})
list(TRANSFORM lists REPLACE "^.*/(.*)/files.txt$" "\\1" OUTPUT_VARIABLE tops)
file(GLOB rtl_headers CONFIGURE_DEPENDS ${rtl_dir}/*.svh)
set(places ${PROJECT_SOURCE_DIR}/kinds/dsdpv1/rtl/public.vlt)  # what the harness looks into

# dsdpv1_rtl_library(TARGET TOP LIBRARY OPTIMISATION ARGUMENTS...): a part of TARGET, the RTL with this top and adapter with these arguments for Verilator and the macros (-D) among
# them. Verilator's own make keeps it out of the configuration, which every `./run` waits for.
function(dsdpv1_rtl_library target top library optimisation)
  set(adapter ${PROJECT_SOURCE_DIR}/kinds/dsdpv1/rtl/reference_library.cpp)
  cmake_path(REMOVE_EXTENSION library OUTPUT_VARIABLE sources_folder)
  cmake_path(GET library PARENT_PATH folder)
  cmake_path(GET library STEM name)
  file(STRINGS ${rtl_dir}/${top}/files.txt files)
  list(TRANSFORM files PREPEND ${rtl_dir}/ OUTPUT_VARIABLE sources)
  set(macros ${ARGN})
  list(FILTER macros INCLUDE REGEX "^-D")
  list(JOIN macros " " macros)
  set(compile "${optimisation} -fPIC -std=c++17 -I${PROJECT_SOURCE_DIR} -DDSDPV1_RTL_LAYOUT=${DSDPV1_RTL_LAYOUT} -DDSDPV1_RTL_OF_${top} ${macros}")
  add_custom_command(
    OUTPUT ${library}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${sources_folder}  # what an earlier build left there may depend on headers that are gone
    COMMAND ${DSDPV1_VERILATOR} --cc --exe --build -O3 --x-assign fast --x-initial unique -DDSDPV1_RUN_TIME_LIMITS -I. -I${PROJECT_SOURCE_DIR}/registers
            --top-module ${top} --prefix Vchip --Mdir ${sources_folder} -CFLAGS ${compile} -LDFLAGS -shared
            -MAKEFLAGS "-s CXX=${CMAKE_CXX_COMPILER} OBJCACHE=${CMAKE_CXX_COMPILER_LAUNCHER} OPT_FAST= OPT_GLOBAL=" -o ${library} ${ARGN}
            ${places} ${files} ${adapter}
    WORKING_DIRECTORY ${rtl_dir}  # what it makes names sources as they are called here
    DEPENDS ${sources} ${rtl_headers} ${PROJECT_SOURCE_DIR}/registers/dsdpv1_regs.svh ${adapter} ${places} ${rtl_shared}
    COMMENT "Verilating ${name}"
    VERBATIM)
  set_property(TARGET ${target} APPEND PROPERTY SOURCES ${library})
endfunction()

set(rtl_folder ${PROJECT_BINARY_DIR}/rtl)
foreach(top ${tops})
  dsdpv1_rtl_library(dsdpv1_rtl_libraries ${top} ${rtl_folder}/lib${top}_rtl.so -O3)
  dsdpv1_rtl_library(dsdpv1_rtl_libraries ${top} ${rtl_folder}/lib${top}_rtl_faults.so -O3 -DSINGLE_FAULTS)
endforeach()

# The RTL as it is once more, counting lines and toggles, and the program beside it, which therefore loads this one: ./run rtl-coverage.
# Far slower, so it is no part of `all`. It writes what it has counted into the folder of the environment's DSDPV1_RTL_COVERAGE. All
# begins with 0: a start with random values would count as toggles.
if(NOT PROJECT_IS_TOP_LEVEL)  # without the program
  return()
endif()
set(coverage_folder ${PROJECT_BINARY_DIR}/rtl-coverage)
add_custom_command(
  OUTPUT ${coverage_folder}/dsdpv1-sim
  COMMAND ${CMAKE_COMMAND} -E make_directory ${coverage_folder}
  COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_FILE:dsdpv1-sim> ${coverage_folder}/dsdpv1-sim
  DEPENDS dsdpv1-sim
  VERBATIM)
add_custom_target(dsdpv1_rtl_coverage SOURCES ${coverage_folder}/dsdpv1-sim)
foreach(top ${tops})
  dsdpv1_rtl_library(dsdpv1_rtl_coverage ${top} ${coverage_folder}/rtl/lib${top}_rtl.so -O1
                     --coverage-line --coverage-toggle --coverage-max-width 64 --output-split 20000 --x-initial 0 -j 2)
endforeach()
