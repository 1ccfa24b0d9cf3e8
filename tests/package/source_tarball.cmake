# Makes the source tarball, and builds it as a part of a user's project, which links the static
# library; nothing comes from a network.
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)

file(REMOVE_RECURSE ${WORK})
run(${CPACK} --config ${BUILD}/CPackSourceConfig.cmake -B ${WORK})
consume_by_cmake(${WORK}/consumer -DTARBALL=${WORK}/wfpsf-${VERSION}.tar.gz
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 -DCMAKE_CXX_FLAGS_DEBUG=-O0)
