# Installs into a fresh tree, moves it, and builds and runs a C program against it by find_package
# and by pkg-config.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
set(tree ${WORK}/moved)
file(RENAME ${WORK}/first ${tree})

run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${WORK}/consumer -DCMAKE_PREFIX_PATH=${tree}
  -DCMAKE_C_COMPILER=${CC} -DEXPECTED_VERSION=${VERSION})
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/consumer ${VERSION})

set(ENV{PKG_CONFIG_PATH} ${tree}/${LIBDIR}/pkgconfig)
execute_process(COMMAND pkg-config --cflags --libs wfpsf = ${VERSION}
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(${CC} ${CONSUMER}/main.c ${flags} -Wl,-rpath,${tree}/${LIBDIR} -o ${WORK}/by_pkgconfig)
run(${WORK}/by_pkgconfig ${VERSION})
