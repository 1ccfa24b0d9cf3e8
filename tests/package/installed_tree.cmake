# Installs into a fresh tree, moves it, and uses it there.
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)
consume_by_cmake(${WORK}/consumer -DCMAKE_PREFIX_PATH=${WORK}/moved)
consume_by_pkgconfig(${WORK}/moved ${WORK}/by_pkgconfig)
