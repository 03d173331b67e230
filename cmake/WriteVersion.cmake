# SPDX-License-Identifier: Apache-2.0
# Run at build time: cmake -D SOURCE_DIR=... -D INPUT=... -D OUTPUT=... -D CSLAM_VERSION=... -P this
# Rewrites OUTPUT only when version or commit changed, so a build without news compiles nothing.
set(CSLAM_COMMIT unknown)
find_program(git_program git)
if(git_program)
  execute_process(
    COMMAND ${git_program} -C ${SOURCE_DIR} describe --always --dirty --abbrev=10 --match=no-tag-at-all
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(CSLAM_COMMIT ${described})
  endif()
endif()
configure_file(${INPUT} ${OUTPUT} @ONLY)
