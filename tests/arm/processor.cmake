# The processor. Its programs are Thumb assembler, one a group of behaviours; the tests read the raw images.
dsdpv1_test(arm_nvic_test nvic_test.cpp LIBS dsdpv1_cortex_m3)
dsdpv1_test(arm_systick_test systick_test.cpp LIBS dsdpv1_cortex_m3)

find_program(ARM_OBJCOPY arm-none-eabi-objcopy REQUIRED)
set(images)
file(GLOB programs CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/programs/*.s)
foreach(source ${programs})
  get_filename_component(name ${source} NAME_WE)
  set(image ${CMAKE_CURRENT_BINARY_DIR}/${name}.bin)
  add_custom_command(
    OUTPUT ${image}
    COMMAND ${ARM_GCC} -mcpu=cortex-m3 -mthumb -nostdlib -I${CMAKE_CURRENT_SOURCE_DIR}/programs -Wl,-Ttext=0x08000000 -Wl,--build-id=none
            -Wl,-e,0 -x assembler-with-cpp ${source} -o ${name}.elf
    COMMAND ${ARM_OBJCOPY} -O binary -j .text ${name}.elf ${image}
    DEPENDS ${source} ${CMAKE_CURRENT_SOURCE_DIR}/programs/vectors.inc
    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  list(APPEND images ${image})
endforeach()
add_custom_target(cortex_m3_test_programs DEPENDS ${images})

dsdpv1_test(cortex_m3_test cortex_m3_test.cpp exceptions_test.cpp debugged_test.cpp processor_bench.cpp LIBS dsdpv1_cortex_m3 dsdpv1_user_cpu)
add_dependencies(cortex_m3_test cortex_m3_test_programs)
target_compile_definitions(cortex_m3_test PRIVATE PROGRAMS="${CMAKE_CURRENT_BINARY_DIR}")
