# The scenes of `bulbus new`, as text in the program.
set(texts ${PROJECT_SOURCE_DIR}/app/new)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/scene_texts.cpp
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${PROJECT_BINARY_DIR}/scene_texts.cpp -DHEADER=app/new/scene_texts.hpp
          -DNAMESPACE=bulbus::scene_texts "-DENTRIES=eye=${texts}/eye.yaml,sphere=${texts}/sphere.yaml,mesh=${texts}/mesh.yaml"
          -P ${PROJECT_SOURCE_DIR}/cmake/Embed.cmake
  DEPENDS ${texts}/eye.yaml ${texts}/sphere.yaml ${texts}/mesh.yaml ${PROJECT_SOURCE_DIR}/cmake/Embed.cmake VERBATIM)
target_sources(bulbus_app PRIVATE ${PROJECT_BINARY_DIR}/scene_texts.cpp)
set_source_files_properties(${PROJECT_BINARY_DIR}/scene_texts.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                            SKIP_PRECOMPILE_HEADERS ON)
