# Helpers that the folders' CMakeLists.txt use. One module = one folder = one static library = one layer.

add_library(tyndall_options INTERFACE)
target_compile_options(tyndall_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # g++ 12 warns of std::string itself (its bug 105651)
  $<$<BOOL:${TYNDALL_WERROR}>:-Werror>)
target_compile_definitions(tyndall_options INTERFACE
  GLM_FORCE_EXPLICIT_CTOR GLM_ENABLE_EXPERIMENTAL SPDLOG_FMT_EXTERNAL
  TYNDALL_VERSION="${PROJECT_VERSION}")
target_include_directories(tyndall_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/shaders)

# tyndall_module(NAME SOURCES a.cpp ... [LIBS public ...] [PRIVATE_LIBS ...])
function(tyndall_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS;PRIVATE_LIBS" ${ARGN})
  add_library(tyndall_${name} STATIC ${ARG_SOURCES})
  target_link_libraries(tyndall_${name}
    PUBLIC tyndall_options glm::glm fmt::fmt ${ARG_LIBS}
    PRIVATE ${ARG_PRIVATE_LIBS})
endfunction()

# tyndall_compile_quickly(TARGET): for code that runs once and includes much (Vulkan-Hpp, JSON, command line).
function(tyndall_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# tyndall_add_kernel(TARGET FILE.comp): compiles FILE.comp to SPIR-V, validates it and embeds it.
# TARGET gets the header kernels/<stem>.h with `const uint32_t k<stem>Spirv[]`.
function(tyndall_add_kernel target source)
  get_filename_component(stem ${source} NAME_WE)
  get_filename_component(input ${source} ABSOLUTE)
  set(dir ${CMAKE_BINARY_DIR}/kernels)
  set(spv ${dir}/${stem}.spv)
  set(header ${dir}/kernels/${stem}.h)
  file(MAKE_DIRECTORY ${dir}/kernels)
  add_custom_command(
    OUTPUT ${spv} ${header} # Ninja takes the dependency file to be that of the first
    COMMAND ${GLSLANG} --quiet --target-env vulkan1.3 -I${CMAKE_SOURCE_DIR}/shaders
            --depfile ${spv}.d -o ${spv} ${input}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${spv}
    COMMAND ${GLSLANG} --quiet --target-env vulkan1.3 -I${CMAKE_SOURCE_DIR}/shaders
            --vn k_${stem}_spirv -o ${header} ${input}
    DEPENDS ${input} DEPFILE ${spv}.d
    COMMENT "Kernel ${stem}" VERBATIM)
  add_custom_target(kernel_${stem} DEPENDS ${header})
  add_dependencies(${target} kernel_${stem})
  target_include_directories(${target} PUBLIC ${dir})
endfunction()

# Builds every test; `all` builds none.
add_custom_target(tyndall_tests)

# tyndall_test(NAME SOURCES a.cpp ... LIBS ... [LABELS unit|device|estimate|long] [TIMEOUT s])
function(tyndall_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBS;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  add_executable(${name} EXCLUDE_FROM_ALL ${ARG_SOURCES})
  add_dependencies(tyndall_tests ${name})
  # What is tested is optimised fully; the tests themselves must compile quickly.
  target_compile_options(${name} PRIVATE -O1)
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
