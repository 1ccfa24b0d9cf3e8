# What a user does with wfpsf: programs in all languages, with the same output.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The outputs of programs, which must be one. Words of a command are parted by |.
function(run_alike)
  foreach(program ${ARGN})
    string(REPLACE "|" ";" command ${program})
    execute_process(COMMAND ${command} ${VERSION} COMMAND_ECHO STDOUT
      OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    message("${output}")
    if(NOT output MATCHES "^sigma = [1-9]")
      message(FATAL_ERROR "${program}: unexpected output")
    endif()
    list(APPEND outputs ${output})
  endforeach()
  list(REMOVE_DUPLICATES outputs)
  list(LENGTH outputs different)
  if(NOT different EQUAL 1)
    message(FATAL_ERROR "the programs' outputs differ")
  endif()
endfunction()

# Builds and runs the programs in `build` with CMake; further arguments configure.
function(consume_by_cmake build)
  run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${build} -DCMAKE_C_COMPILER=${CC}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_Fortran_COMPILER=${FC} -DEXPECTED_VERSION=${VERSION}
    ${ARGN})
  run(${CMAKE_COMMAND} --build ${build})
  run_alike(${build}/consumer_c ${build}/consumer_cpp ${build}/consumer_fortran)
endfunction()

# The same against an installed tree by pkg-config and the compilers alone, in Python and in Julia.
function(consume_by_pkgconfig tree build)
  file(MAKE_DIRECTORY ${build})
  set(ENV{PKG_CONFIG_PATH} ${tree}/${LIBDIR}/pkgconfig)
  foreach(module wfpsf wfpsf-fortran)
    execute_process(COMMAND pkg-config --cflags --libs ${module} = ${VERSION}
      OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    separate_arguments(${module}_flags UNIX_COMMAND "${flags}")
  endforeach()
  set(loader -Wl,-rpath,${tree}/${LIBDIR})
  run(${CC} ${CONSUMER}/main.c ${wfpsf_flags} ${loader} -o ${build}/c)
  run(${CXX} -std=c++17 ${CONSUMER}/main.cpp ${wfpsf_flags} ${loader} -o ${build}/cpp)
  run(${FC} ${CONSUMER}/main.f90 ${wfpsf-fortran_flags} ${loader} -o ${build}/fortran)
  set(ENV{PYTHONPATH} ${tree}/lib/python3/dist-packages)
  if(PYTHON)
    set(python ${PYTHON}|${CONSUMER}/main.py)
  endif()
  # A depot of its own: Julia compiles the package for the place where it stands.
  set(ENV{JULIA_LOAD_PATH} ${tree}/share/wfpsf/julia:@stdlib)
  set(ENV{JULIA_DEPOT_PATH} ${build}/depot:)
  if(JULIA)
    set(julia ${JULIA}|--startup-file=no|${CONSUMER}/main.jl)
  endif()
  run_alike(${build}/c ${build}/cpp ${build}/fortran ${python} ${julia})
endfunction()
