# Runs a main job into a fresh folder and looks at what it leaves; then into a folder that
# cannot be made.
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${PROGRAM} ${OUT} RESULT_VARIABLE code ERROR_VARIABLE errors)
if(errors OR NOT code EQUAL 0)
  message(FATAL_ERROR "exit code ${code}, on stderr: \"${errors}\"")
endif()

set(files psf_Z087.fits psf_Y106.fits psf_J129.fits psf_W149.fits psf_H158.fits psf_F184.fits)
if(WITH_GALLERY)
  list(APPEND files gallery.png)
endif()
foreach(name ${files})
  if(NOT EXISTS ${OUT}/${name})
    message(FATAL_ERROR "${name} was not written")
  endif()
endforeach()

file(STRINGS ${OUT}/table_sizes.csv lines)
list(LENGTH lines count)
if(NOT count EQUAL 73)
  message(FATAL_ERROR "table_sizes.csv has ${count} lines: must be 73")
endif()
string(REGEX MATCH "nan|inf" bad "${lines}")
if(bad)
  message(FATAL_ERROR "table_sizes.csv holds a value of ${bad}")
endif()

execute_process(COMMAND ${PROGRAM} ${OUT}/psf_J129.fits/out
  RESULT_VARIABLE code ERROR_VARIABLE errors OUTPUT_QUIET)
if(NOT code EQUAL 1 OR NOT errors MATCHES "psf_J129.fits/out")
  message(FATAL_ERROR "a folder that cannot be made: exit code ${code}, \"${errors}\"")
endif()
