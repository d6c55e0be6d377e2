# Target `tidy`: clang-tidy over every source file. A file is looked at again when its object file is newer,
# which is when it or a header of it has changed.
find_program(ANVIL_CLANG_TIDY NAMES clang-tidy-14 clang-tidy)
if(NOT ANVIL_CLANG_TIDY)
  return()
endif()

set(ANVIL_TIDY_STAMPS)
function(anvil_tidy_target target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(source_dir ${target} SOURCE_DIR)
  get_target_property(binary_dir ${target} BINARY_DIR)
  foreach(source IN LISTS sources)
    if(NOT source MATCHES "\\.cpp$" OR source MATCHES "^${PROJECT_BINARY_DIR}")
      continue()
    endif()
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${source_dir})
    file(RELATIVE_PATH object ${source_dir} ${source})
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
    set(stamp ${PROJECT_BINARY_DIR}/tidy/${name}.stamp)
    cmake_path(GET stamp PARENT_PATH folder)
    file(MAKE_DIRECTORY ${folder})
    add_custom_command(
      OUTPUT ${stamp}
      COMMAND ${ANVIL_CLANG_TIDY} -p ${PROJECT_BINARY_DIR} --quiet ${source}
      COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
      DEPENDS ${binary_dir}/CMakeFiles/${target}.dir/${object}.o ${PROJECT_SOURCE_DIR}/.clang-tidy
      COMMENT "clang-tidy ${name}"
      VERBATIM)
    list(APPEND ANVIL_TIDY_STAMPS ${stamp})
  endforeach()
  set(ANVIL_TIDY_STAMPS ${ANVIL_TIDY_STAMPS} PARENT_SCOPE)
endfunction()

foreach(target anvil_engine anvil_gpu anvil_viewer anvil anvil_test_support anvil_unit_tests anvil_gpu_tests anvil_viewer_tests anvil_app_tests)
  if(TARGET ${target})
    anvil_tidy_target(${target})
  endif()
endforeach()
add_custom_target(tidy DEPENDS ${ANVIL_TIDY_STAMPS})
