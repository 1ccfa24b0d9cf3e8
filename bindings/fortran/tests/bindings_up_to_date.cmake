# The committed low-level bindings must be what the generator makes of the headers today.
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${PYTHON} ${BINDINGS}/generate.py ${WORK} COMMAND_ERROR_IS_FATAL ANY)
foreach(file fortran/src/wfpsf_c.f90 julia/src/LibWfpsf.jl python/wfpsf/_lib.py)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/${file} ${BINDINGS}/${file}
    RESULT_VARIABLE different)
  if(different)
    message(FATAL_ERROR "bindings/${file} is out of date: run bindings/generate.py")
  endif()
endforeach()
