# Compiles shaders/*.comp and shaders/viewer/*.{vert,frag} to SPIR-V at build time, each embedded as
# `const uint32_t deform_comp[]` in the build tree's header "embedded/deform.comp.h". Nothing is read at run time.
# For Vulkan 1.2: SPIR-V 1.6 states workgroup sizes in a way that wants one more device feature.
# glslangValidator's dependency file makes a changed include rebuild what includes it.
function(anvil_embed_shaders target)
  file(GLOB shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*.comp ${PROJECT_SOURCE_DIR}/shaders/viewer/*.vert
       ${PROJECT_SOURCE_DIR}/shaders/viewer/*.frag)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders/embedded)
  file(MAKE_DIRECTORY ${folder})
  set(headers)
  foreach(shader IN LISTS shaders)
    get_filename_component(name ${shader} NAME)
    string(REPLACE "." "_" symbol ${name})
    set(header ${folder}/${name}.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${ANVIL_GLSLANG} --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR} -I${PROJECT_SOURCE_DIR}/shaders
              --depfile ${header}.d --vn ${symbol} -o ${header} ${shader}
      DEPENDS ${shader}
      DEPFILE ${header}.d
      COMMENT "Compiling shader ${name}"
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/shaders)
endfunction()
