# cmake --install: the program, the scenes, and the floors as targets bulbus::NAME for find_package(bulbus).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/bulbus)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/bulbus)
set(floors base mesh io material element problem solve precond contact eye)

foreach(floor ${floors})
  set_target_properties(bulbus_${floor} PROPERTIES EXPORT_NAME ${floor})
  list(APPEND targets bulbus_${floor})
endforeach()
install(TARGETS ${targets} trilinos hypre mumps superlu_dist umfpack hdf5_parallel EXPORT bulbus COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT bulbus NAMESPACE bulbus:: DESTINATION ${config} FILE bulbusTargets.cmake COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR}/precond ${PROJECT_SOURCE_DIR}/contact DESTINATION ${headers}
        COMPONENT development FILES_MATCHING PATTERN *.hpp)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/app/eye DESTINATION ${headers}/app COMPONENT development FILES_MATCHING PATTERN *.hpp)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/bulbusConfig.cmake.in ${PROJECT_BINARY_DIR}/bulbusConfig.cmake
                              INSTALL_DESTINATION ${config})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bulbusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bulbusConfig.cmake ${PROJECT_BINARY_DIR}/bulbusConfigVersion.cmake DESTINATION ${config}
        COMPONENT development)

install(TARGETS bulbus COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/scenes ${PROJECT_SOURCE_DIR}/data/meshes ${PROJECT_SOURCE_DIR}/python
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bulbus COMPONENT program PATTERN __pycache__ EXCLUDE)
# What the program tells of itself: completions, manual page and schemas, made by it when it is installed.
install(CODE "
  foreach(made IN ITEMS
      \"completion bash|${CMAKE_INSTALL_DATADIR}/bash-completion/completions|bulbus\"
      \"completion zsh|${CMAKE_INSTALL_DATADIR}/zsh/site-functions|_bulbus\"
      \"man|${CMAKE_INSTALL_MANDIR}/man1|bulbus.1\"
      \"schema scene|${CMAKE_INSTALL_DATADIR}/bulbus|scene.schema.json\"
      \"schema study|${CMAKE_INSTALL_DATADIR}/bulbus|study.schema.json\")
    string(REPLACE \"|\" \";\" made \"\${made}\")
    list(GET made 0 command)
    list(GET made 1 folder)
    list(GET made 2 name)
    separate_arguments(command)
    set(file \"${PROJECT_BINARY_DIR}/made/\${name}\")
    file(MAKE_DIRECTORY \"${PROJECT_BINARY_DIR}/made\")
    execute_process(COMMAND \"$<TARGET_FILE:bulbus>\" \${command} OUTPUT_FILE \"\${file}\" COMMAND_ERROR_IS_FATAL ANY)
    file(INSTALL \"\${file}\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${folder}\")
  endforeach()" COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# cpack --preset package: a Debian package of the program.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME bulbus)
set(CPACK_PACKAGE_CONTACT "The Bulbus developers <bulbus@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Finite-strain analysis of soft tissue coupled to enclosed liquid, with contact and sutures")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME bulbus)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS librsvg2-bin)  # bulbus plot -o FILE.png
set(CPACK_STRIP_FILES ON)
include(CPack)
