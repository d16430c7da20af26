# Build settings that every target shares, and the three kinds of target: room, tool, test.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

option(STABLECUT_WARNINGS_AS_ERRORS "Stop at any compiler warning in the project's own code" OFF)
option(STABLECUT_ASSERTIONS "Keep the assertions of Eigen, of the standard library and our own" OFF)
set(STABLECUT_SANITIZE "" CACHE STRING "Sanitizers to build with, such as address,undefined or thread")
option(STABLECUT_FUZZ "Build the fuzzer of the readers, with clang and the sanitizers" OFF)
set(STABLECUT_FUZZ_LIBRARIES ${PROJECT_SOURCE_DIR}/build CACHE PATH "For the fuzzer: a built tree, whose numeric rooms are linked as they are")
include(CTest)
include(GNUInstallDirs)

add_library(stablecut_settings INTERFACE)
target_compile_options(stablecut_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 sees overlapping copies in its own std::string (bug 105329).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # No contraction into fused multiply-add: the same bytes from every compiler flag set.
  -ffp-contract=off
  # Complex products and quotients without the detour for infinities; quotients by Smith's method.
  $<$<CXX_COMPILER_ID:GNU>:-fcx-fortran-rules>
  $<$<BOOL:${STABLECUT_WARNINGS_AS_ERRORS}>:-Werror>)
target_compile_definitions(stablecut_settings INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_MPL2_ONLY)
if(STABLECUT_FUZZ)
  target_compile_options(stablecut_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(STABLECUT_ASSERTIONS)
  target_compile_options(stablecut_settings INTERFACE -UNDEBUG)
  target_compile_definitions(stablecut_settings INTERFACE _GLIBCXX_ASSERTIONS)
endif()
if(STABLECUT_SANITIZE)
  # Null and misplaced pointers and objects that are too small stop under the address sanitizer anyway; their checks double the
  # time that it takes to build and to run.
  target_compile_options(stablecut_settings INTERFACE -fsanitize=${STABLECUT_SANITIZE} -fno-sanitize-recover=all
    -fno-sanitize=null,alignment,object-size)
  target_link_options(stablecut_settings INTERFACE -fsanitize=${STABLECUT_SANITIZE})
endif()

# stablecut_vector_kernels(FILE...): files whose functions are built for several widths of vector registers. Their vectors
# are never passed between files; square roots need no errno; wide vectors are copied whole (lib/numerics/README.md).
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256" STABLECUT_HAVE_MOVE_MAX)
function(stablecut_vector_kernels)
  set(options -Wno-psabi -fno-math-errno)
  if(STABLECUT_HAVE_MOVE_MAX)
    list(APPEND options -mmove-max=256 -mstore-max=256)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()

# stablecut_room(NAME SOURCES a.cc ... [LINK rooms and packages] [PRIVATE_LINK packages] [TESTS a_test.cc ...]
#                [BENCHMARKS b_benchmark.cc ...])
# A library of lib/NAME, its unit tests in one executable NAME_test and its benchmarks, one executable each.
function(stablecut_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINK;PRIVATE_LINK;TESTS;BENCHMARKS" ${ARGN})
  # Hostile bytes meet the readers: what is computed with numbers that have passed them takes long to compile under sanitizers.
  if(STABLECUT_FUZZ AND NOT name MATCHES "^(base|dynamics|taps|document|cli)$")
    add_library(stablecut_${name} STATIC IMPORTED GLOBAL)
    set_target_properties(stablecut_${name} PROPERTIES IMPORTED_LOCATION ${STABLECUT_FUZZ_LIBRARIES}/lib/${name}/libstablecut_${name}.a)
    target_include_directories(stablecut_${name} INTERFACE ${PROJECT_SOURCE_DIR}/lib)
    target_link_libraries(stablecut_${name} INTERFACE ${ROOM_LINK} ${ROOM_PRIVATE_LINK})
    return()
  endif()
  add_library(stablecut_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(stablecut_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>)
  target_link_libraries(stablecut_${name} PUBLIC ${ROOM_LINK} PRIVATE stablecut_settings ${ROOM_PRIVATE_LINK})
  if(BUILD_TESTING AND ROOM_TESTS)
    add_executable(${name}_test ${ROOM_TESTS})
    target_link_libraries(${name}_test PRIVATE
      stablecut_${name} stablecut_settings ${ROOM_PRIVATE_LINK} Catch2::Catch2WithMain)
    target_compile_definitions(${name}_test PRIVATE STABLECUT_TESTDATA="${PROJECT_SOURCE_DIR}/testdata")
    # Hundreds of random cases tell a sanitizer no more than the few of the other tests.
    set(cases)
    if(STABLECUT_SANITIZE)
      set(cases "~[campaign]")
    endif()
    add_test(NAME lib.${name} COMMAND ${name}_test ${cases})
  endif()
  foreach(source ${ROOM_BENCHMARKS})
    cmake_path(GET source STEM benchmark)
    add_executable(${benchmark} ${source})
    target_link_libraries(${benchmark} PRIVATE stablecut_${name} stablecut_settings)
  endforeach()
endfunction()

# Every tool.
add_custom_target(tools)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/completion)

# stablecut_tool(NAME [SOURCES more.cc ...] LINK libraries): the executable of apps/NAME, from its main.cpp.
function(stablecut_tool name)
  cmake_parse_arguments(TOOL "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} main.cpp ${TOOL_SOURCES})
  target_link_libraries(${name} PRIVATE stablecut_settings stablecut_cli ${TOOL_LINK})
  add_dependencies(tools ${name})
  install(TARGETS ${name})
  install(FILES ${name}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  set(completion ${PROJECT_BINARY_DIR}/completion)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${name} --print-completion bash >${completion}/${name}
    COMMAND ${name} --print-completion zsh >${completion}/_${name})
  install(FILES ${completion}/${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${completion}/_${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
endfunction()

# stablecut_script_test(NAME SCRIPT): a shell script that exits 0 when what it checks holds and 77 to skip. It
# finds the tools on its PATH, and the checkout in SOURCE.
function(stablecut_script_test name script)
  add_test(NAME ${name} COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/${script})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT
    "SOURCE=${PROJECT_SOURCE_DIR};PATH=${CMAKE_RUNTIME_OUTPUT_DIRECTORY}:$ENV{PATH}")
endfunction()
