# The same files by one rank and by two; a run that was broken off is finished, and nothing is made
# twice. From the same stores come the same files.
foreach(folder 1 2 first stores second third)
  file(REMOVE_RECURSE ${WORK}/${folder})
  file(MAKE_DIRECTORY ${WORK}/${folder})
endforeach()
function(run ranks folder detectors expected)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
      ${MPIEXEC} --oversubscribe -n ${ranks} ${PROGRAM} ${folder} 1 300 ${detectors} ${ARGN}
    OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said MATCHES "^${expected}, by ${ranks} ranks")
    message(FATAL_ERROR "${ranks} ranks said: ${said}")
  endif()
endfunction()
run(1 ${WORK}/1 2 "2 detectors made, 0 kept")
run(2 ${WORK}/2 1 "1 detectors made, 0 kept")
run(2 ${WORK}/2 2 "1 detectors made, 1 kept")
foreach(sca 01 02)
  set(name exposure_00000_sca${sca}.fits)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/1/${name} ${WORK}/2/${name}
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(folder first second third)
  run(1 ${WORK}/${folder} 1 "1 detectors made, 0 kept" ${WORK}/stores)
endforeach()
set(name exposure_00000_sca01.fits)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/second/${name} ${WORK}/third/${name}
  COMMAND_ERROR_IS_FATAL ANY)
if(NOT EXISTS ${WORK}/stores/sca01_J129.store)
  message(FATAL_ERROR "no store is kept")
endif()
file(REMOVE_RECURSE ${WORK})
