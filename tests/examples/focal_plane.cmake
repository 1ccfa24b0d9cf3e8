# The same files by one rank and by two; a run that was broken off is finished, and nothing is made
# twice.
foreach(ranks 1 2)
  file(REMOVE_RECURSE ${WORK}/${ranks})
  file(MAKE_DIRECTORY ${WORK}/${ranks})
endforeach()
function(run ranks folder detectors expected)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
      ${MPIEXEC} --oversubscribe -n ${ranks} ${PROGRAM} ${folder} 1 300 ${detectors}
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
file(REMOVE_RECURSE ${WORK})
