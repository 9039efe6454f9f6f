# The reference RTL, Verilated once for each set of its parameters.
set(DSDPV1_RTL_DIR ${PROJECT_SOURCE_DIR}/rtl_ref CACHE PATH "Folder of the reference RTL: files.txt and what it names")
set(rtl_dir ${DSDPV1_RTL_DIR})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${rtl_dir}/files.txt)
file(STRINGS ${rtl_dir}/files.txt rtl_sources)
list(TRANSFORM rtl_sources PREPEND ${rtl_dir}/)

# SEARCH_WINDOW_MS:SEARCH_WINDOW_BITS:BAUD_CONTROL_MS: those of the shipped scenarios; the quick ones are added below.
set(DSDPV1_RTL_VARIANTS "50:4000:600" "5:4000:600" "10:4000:30" CACHE STRING
    "Parameters of the RTL that scenarios may ask for: search_window_ms:search_window_bits:baud_control_ms")
set(quick_window_ms 1)
set(quick_window_bits 100)
set(quick_baud_control_ms 2)
set(quick "${quick_window_ms}:${quick_window_bits}:${quick_baud_control_ms}")

# dsdpv1_rtl_variant(NAME PARAMETERS HAS_FAULTS): adds make_NAME to dsdpv1_rtl.
function(dsdpv1_rtl_variant variant parameters has_faults)
  string(REPLACE ":" ";" values ${parameters})
  list(GET values 0 window_ms)
  list(GET values 1 window_bits)
  list(GET values 2 baud_control_ms)
  set(arguments -O3 --x-assign fast --x-initial unique -I${rtl_dir} -I${PROJECT_SOURCE_DIR}/registers -GSEARCH_WINDOW_MS=${window_ms}
      -GSEARCH_WINDOW_BITS=${window_bits} -GBAUD_CONTROL_MS=${baud_control_ms})
  if(has_faults)
    list(APPEND arguments -DDSDPV1_FAULTS)
  endif()
  # Generated code: without this project's warnings, and with the compiler's best where the time goes.
  add_library(dsdpv1_${variant} STATIC)
  verilate(dsdpv1_${variant} SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/public.vlt ${rtl_sources} TOP_MODULE dsdpv1 PREFIX V${variant}
           VERILATOR_ARGS ${arguments} OPT_FAST -O2)
  get_target_property(folders dsdpv1_${variant} INTERFACE_INCLUDE_DIRECTORIES)
  configure_file(reference_variant.cpp.in ${variant}.cpp @ONLY)
  target_sources(dsdpv1_rtl PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${variant}.cpp)
  set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/${variant}.cpp PROPERTIES OBJECT_DEPENDS
                              ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/dsdpv1_${variant}.dir/V${variant}.dir/V${variant}.h)
  target_include_directories(dsdpv1_rtl SYSTEM PRIVATE ${folders})
  target_link_libraries(dsdpv1_rtl PRIVATE $<LINK_ONLY:dsdpv1_${variant}>)
endfunction()

add_library(dsdpv1_rtl STATIC)
set(number 0)
foreach(parameters IN LISTS DSDPV1_RTL_VARIANTS quick)
  math(EXPR number "${number} + 1")
  dsdpv1_rtl_variant(rtl_${number} ${parameters} 0)
  string(REPLACE ":" ", " values ${parameters})
  string(APPEND variant_declarations "std::unique_ptr<RtlTop> make_rtl_${number}(std::uint32_t seed, unsigned fault);\n")
  string(APPEND variant_table "    {${values}, make_rtl_${number}},\n")
endforeach()
dsdpv1_rtl_variant(rtl_faults ${quick} 1)
configure_file(reference_rtl.cpp.in reference_rtl.cpp @ONLY)
target_sources(dsdpv1_rtl PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/reference_rtl.cpp)
