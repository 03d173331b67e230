# SPDX-License-Identifier: Apache-2.0
# cmake -D BUILD_DIR=... -D SOURCE_DIR=... -D PYTHON=... -P this: installs the build into an empty folder, builds
# examples/ against it as a stranger would, and runs what came out.
if(NOT DEFINED BUILD_DIR OR NOT DEFINED SOURCE_DIR OR NOT DEFINED PYTHON)
  message(FATAL_ERROR "BUILD_DIR, SOURCE_DIR and PYTHON are needed")
endif()
set(work ${BUILD_DIR}/install_test)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output WORKING_DIRECTORY ${work})
  list(JOIN ARGN " " command)
  message(STATUS "${command}")
  if(result)
    message(FATAL_ERROR "failed (${result}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text)
  string(FIND "${output}" "${text}" position)
  if(position LESS 0)
    message(FATAL_ERROR "expected '${text}' in:\n${output}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${work})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${prefix}/bin/changing-slam --version)
expect("changing-slam 0.")

# Nothing that is installed may point back into the source or build tree.
file(GLOB_RECURSE texts ${prefix}/lib/*.cmake ${prefix}/include/*.h)
foreach(text ${texts})
  file(READ ${text} content)
  string(FIND "${content}" "${SOURCE_DIR}/" position)
  if(NOT position LESS 0)
    message(FATAL_ERROR "${text} names the source tree")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/examples -B ${work}/build -G Ninja
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/build --parallel 2)

file(WRITE ${work}/reference.txt "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n3 2 1 1 0 0 0 1\n")
run(${work}/build/compare_trajectories reference.txt reference.txt)
expect("4 poses matched, ATE RMSE 0.0000 m")

run(${PYTHON} -B ${SOURCE_DIR}/tests/tiny_dataset.py tiny)
run(${work}/build/track_folder tiny)
expect("20 of 20 frames tracked")
