# The page of `bulbus report`, as text in the program: its own files, and three.js, which draws in 3-D.
find_path(THREE_JS three.min.js PATHS /usr/share/javascript/three /usr/share/nodejs/three/build REQUIRED)  # libjs-three
set(page ${PROJECT_SOURCE_DIR}/app/report/page)
set(orbit ${THREE_JS}/examples/js/controls/OrbitControls.js)
set(scripts data colours solid cut shapes scale stage viewer pick views controls main)
list(TRANSFORM scripts PREPEND ${page}/)
list(TRANSFORM scripts APPEND .js)
list(JOIN scripts "+" joined)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/page_files.cpp
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${PROJECT_BINARY_DIR}/page_files.cpp -DHEADER=app/report/page_files.hpp
          -DNAMESPACE=bulbus::page_files
          "-DENTRIES=report_html=${page}/report.html,report_css=${page}/report.css,three_js=${page}/three_licence.js+${THREE_JS}/three.min.js,orbit_controls_js=${orbit},scripts=${joined}"
          -P ${PROJECT_SOURCE_DIR}/cmake/Embed.cmake
  DEPENDS ${page}/three_licence.js ${page}/report.html ${page}/report.css ${THREE_JS}/three.min.js ${orbit} ${scripts}
          ${PROJECT_SOURCE_DIR}/cmake/Embed.cmake VERBATIM)
target_sources(bulbus_app PRIVATE ${PROJECT_BINARY_DIR}/page_files.cpp)
set_source_files_properties(${PROJECT_BINARY_DIR}/page_files.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                            SKIP_PRECOMPILE_HEADERS ON)
