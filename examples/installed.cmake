# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
# The examples with an installed copy, besides the compiled programs; missing tools are reported. Python is the one that CMake finds, or
# -DPython3_EXECUTABLE=...
set(here ${CMAKE_CURRENT_SOURCE_DIR})
set(sim $<TARGET_FILE:dsdpv1::dsdpv1-sim>)

# needs(RESULT NAME conditions...): RESULT is true if each CONDITION is; else NAME is skipped with a message.
macro(needs result name)
  set(${result} TRUE)
  foreach(condition ${ARGN})
    if(NOT ${condition})
      message(STATUS "examples.${name} is left out: ${condition} is missing")
      set(${result} FALSE)
    endif()
  endforeach()
endmacro()

shown(scenario ${sim} run ${DSDPV1_TREE}/scenarios/power_on_12m.yaml --no-progress --wave power_on_12m.vcd --result power_on_12m.json
      PRINTS "PASSED")
# A scenario whose masters are also used by other benches.
shown(masters ${sim} run ${here}/masters.yaml --no-progress PRINTS "PASSED")

# The example firmware, just built, on the ARM board, if the program has it.
find_program(arm-none-eabi-gcc arm-none-eabi-gcc)
needs(there firmware arm-none-eabi-gcc)
if(there)
  shown(firmware ${sim} run ${DSDPV1_TREE}/scenarios/arm_board_12m.yaml --no-progress --set
        user_cpu.elf=${CMAKE_CURRENT_BINARY_DIR}/firmware/device_O2.elf PRINTS "PASSED")
  shown(firmware_spc3 ${sim} run ${DSDPV1_TREE}/scenarios/spc3_arm.yaml --no-progress --set
        user_cpu.elf=${CMAKE_CURRENT_BINARY_DIR}/firmware/device_spc3.elf PRINTS "PASSED")
endif()

# Your RTL compared with the model: it contains two faults, of which the first is found here (docs/tutorials/own_rtl.md).
find_program(verilator verilator)
needs(there own_rtl verilator)
if(there)
  shown(own_rtl ${sim} cosim --rtl ${here}/own_rtl --top board_chip --pins ${here}/own_rtl/pins.yaml --build own_rtl_build
        ${DSDPV1_TREE}/scenarios/two_slaves.yaml PRINTS "first difference  cycle 0 .*pin INTR0: model 1, RTL X")
endif()

# A bench in SystemVerilog (docs/systemverilog.md).
foreach(target dpi vpi)
  set(dsdpv1-${target} FALSE)
  if(TARGET dsdpv1::${target})
    set(dsdpv1-${target} TRUE)
  endif()
endforeach()
set(sv ${DSDPV1_TREE}/bindings/systemverilog)
file(STRINGS ${sv}/files.txt sources)
list(TRANSFORM sources PREPEND ${sv}/)
list(APPEND sources ${here}/systemverilog/data_exchange.sv)
list(JOIN sources " " sources)
set(exchanged "data exchange with slave 5.*outputs ddccbbaa, inputs 44332211.*services are answered.*passed")
needs(there systemverilog_verilator verilator dsdpv1-dpi)
if(there)
  set(library $<TARGET_FILE:dsdpv1::dpi>)
  shown(systemverilog_verilator sh -ec "verilator --binary --timing -Wno-fatal --top-module data_exchange -Mdir verilated -I${sv} ${sources} \
        -LDFLAGS '${library} -Wl,-rpath,$<TARGET_FILE_DIR:dsdpv1::dpi>' && verilated/Vdata_exchange" PRINTS ${exchanged})
endif()
find_program(iverilog iverilog)
needs(there systemverilog_icarus iverilog dsdpv1-vpi)
if(there)
  shown(systemverilog_icarus sh -ec "iverilog -g2012 -DDSDPV1_VPI -DDSDPV1_IMMEDIATE -I${sv} -s data_exchange -o data_exchange.vvp \
        $<TARGET_FILE:dsdpv1::vpi> ${sources} && vvp data_exchange.vvp" PRINTS ${exchanged})
endif()

# The reference RTL with a planted defect, which its scoreboard finds.
file(STRINGS ${DSDPV1_TREE}/rtl_ref/dsdpv1/files.txt rtl)
list(TRANSFORM rtl PREPEND ${DSDPV1_TREE}/rtl_ref/)
list(JOIN rtl " " rtl)
if(there)
  shown(systemverilog_defect sh -ec "iverilog -g2012 -DDSDPV1_VPI -DDSDPV1_IMMEDIATE -DUSE_RTL -DSINGLE_FAULTS -I${sv} -I${DSDPV1_TREE}/rtl_ref \
        -I${DSDPV1_TREE}/registers -s data_exchange -o defect.vvp $<TARGET_FILE:dsdpv1::vpi> ${sources} ${rtl} && vvp defect.vvp +fault=46"
        PRINTS "first difference at cycle 58808 .*INTR0 is 1, the model's is 0")
endif()

# Python (docs/python.md) and cocotb (docs/cocotb.md).
find_package(Python3 COMPONENTS Interpreter)
set(dsdpv1-python ${dsdpv1_python_FOUND})
set(python ${CMAKE_COMMAND} -E env --unset=DSDPV1_LIBRARY PYTHONPATH=${dsdpv1_PYTHON_DIR} PYTHONDONTWRITEBYTECODE=1
    IPYTHONDIR=${CMAKE_CURRENT_BINARY_DIR}/ipython DSDPV1_ROOT=${DSDPV1_TREE} ${Python3_EXECUTABLE})
foreach(module numpy IPython cocotb)
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import ${module}" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  string(COMPARE EQUAL "${failed}" 0 ${module})
endforeach()
needs(there python dsdpv1-python numpy)
if(there)
  shown(python ${python} ${here}/python/pin_by_pin.py ${DSDPV1_TREE}/scenarios/dsdpv1.gsd PRINTS
        "SLAVE_STATE DATA_EXCHANGE.*outputs 01 02 03 04 05 06 07 08.*inputs at the master ca fe 00 .*changes; violations: 0")
endif()
needs(there notebook dsdpv1-python numpy IPython)
if(there)
  shown(notebook ${python} -m IPython --no-banner --colors=NoColor ${here}/python/run_in_python.ipynb PRINTS
        "Set_Prm: ident 0x0CC9.*accesses.*DATA_EXCHANGE.*TIMING_TS .*12.417 ns of at least 12.500 ns")
endif()
needs(there cocotb dsdpv1-python numpy cocotb iverilog)
if(there)
  shown(cocotb ${python} -W ignore ${here}/cocotb/run.py --test a_master_brings_the_chip_up --build cocotb_build PRINTS
        "data exchange at [0-9.]+ us, [0-9]+ changes are the model's.*TESTS=1 PASS=1 FAIL=0")
  shown(cocotb_defect ${python} -W ignore ${here}/cocotb/run.py --test the_pins_of_a_scenario_are_replayed --fault 48 --build cocotb_defect_build PRINTS
        "first difference +cycle 3106 .*pin L_REQ: model 1, DUT 0")
endif()
