# SPDX-License-Identifier: Apache-2.0
# Flags every target of ours gets through cslam_compile_options; nothing is set globally.
add_library(cslam_compile_options INTERFACE)
target_compile_options(cslam_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wdouble-promotion
  # Bit-identical results need the same arithmetic in every build of a function.
  -ffp-contract=off)

# Descriptors are compared by counting bits; every x86-64 processor since 2008 has an instruction
# for it, which the compiler's baseline leaves out.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(cslam_compile_options INTERFACE -mpopcnt)
endif()

if(CSLAM_SANITIZE)
  list(JOIN CSLAM_SANITIZE "," sanitizers)
  target_compile_options(cslam_compile_options INTERFACE -fsanitize=${sanitizers} -fno-omit-frame-pointer)
  target_link_options(cslam_compile_options INTERFACE -fsanitize=${sanitizers})
endif()
if(CSLAM_COVERAGE)
  target_compile_options(cslam_compile_options INTERFACE --coverage)
  target_link_options(cslam_compile_options INTERFACE --coverage)
endif()

find_program(CSLAM_CCACHE ccache)
if(CSLAM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CSLAM_CCACHE})
endif()
