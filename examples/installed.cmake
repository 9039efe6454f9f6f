# What the examples show with the installed programs; the project's own tests call these in their own ways.
include(CTest)
set(sim $<TARGET_FILE:dsdpv1::dsdpv1-sim>)

function(shown name expected)
  add_test(NAME examples.${name} COMMAND ${ARGN})
  set_tests_properties(examples.${name} PROPERTIES TIMEOUT 600 PASS_REGULAR_EXPRESSION ${expected})
endfunction()

shown(scenario "PASSED" ${sim} run ${DSDPV1_TREE}/scenarios/power_on_12m.yaml --no-progress
      --wave power_on_12m.vcd --result power_on_12m.json)

# The example firmware, as it has just been built, on the ARM board; the program finds its other half by itself.
find_program(DSDPV1_ARM_GCC arm-none-eabi-gcc)
find_program(DSDPV1_BOARD dsdpv1-board HINTS ${DSDPV1_TREE}/../../libexec/dsdpv1 NO_DEFAULT_PATH)
if(DSDPV1_ARM_GCC AND DSDPV1_BOARD)
  shown(firmware "PASSED" ${sim} run ${DSDPV1_TREE}/scenarios/arm_board_12m.yaml --no-progress
        --set user_cpu.elf=${CMAKE_CURRENT_BINARY_DIR}/firmware/device_O2.elf)
endif()

# RTL of one's own against the model: two things are wrong in it, this is the first that shows (docs/cosim.md).
find_program(DSDPV1_VERILATOR verilator)
if(DSDPV1_VERILATOR)
  shown(own_rtl "first difference  cycle 0 .*pin INTR0: model 1, RTL X" ${sim} cosim --rtl ${CMAKE_CURRENT_SOURCE_DIR}/own_rtl --top board_chip
        --pins ${CMAKE_CURRENT_SOURCE_DIR}/own_rtl/pins.yaml --build own_rtl_build ${DSDPV1_TREE}/scenarios/two_slaves.yaml)
endif()
