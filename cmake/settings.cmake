# Language, warnings and sanitizers, for every target of the project.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(wfpsf_settings INTERFACE)
target_compile_options(wfpsf_settings INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion>
  $<$<AND:$<BOOL:${WFPSF_WARNINGS_AS_ERRORS}>,$<COMPILE_LANGUAGE:C,CXX>>:-Werror>)
if(WFPSF_SANITIZE)
  add_compile_options(-fsanitize=${WFPSF_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${WFPSF_SANITIZE})
  # What these checks look for, AddressSanitizer sees when memory is used; they double the time.
  add_compile_options(-fno-sanitize=null,object-size,pointer-overflow)
  # GCC's manual: sanitizers make this warning say what is not so.
  target_compile_options(wfpsf_settings INTERFACE -Wno-maybe-uninitialized)
endif()

# wfpsf_core_library(NAME SOURCES ... USES ...): one folder of the core as a static library.
function(wfpsf_core_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;USES;PRIVATE_USES")
  add_library(wfpsf_${name} STATIC ${arg_SOURCES})
  target_include_directories(wfpsf_${name} PUBLIC
    ${PROJECT_SOURCE_DIR}/cpp ${PROJECT_SOURCE_DIR}/capi/include)
  target_link_libraries(wfpsf_${name} PUBLIC ${arg_USES} PRIVATE wfpsf_settings ${arg_PRIVATE_USES})
endfunction()
