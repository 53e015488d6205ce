# Read by cpack for each package: its version is what the built program says; a package can be moved, Debian's is /usr's.
execute_process(COMMAND ${CPACK_CMAKE_BINARY_DIR}/bin/tactoscope-cli --version COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_VARIABLE said)
string(REGEX MATCH "^tactoscope-cli ([^\n]+)\n" said "${said}")
set(CPACK_PACKAGE_VERSION ${CMAKE_MATCH_1})
set(CPACK_DEBIAN_PACKAGE_VERSION ${CMAKE_MATCH_1})
set(CPACK_PACKAGE_FILE_NAME tactoscope-${CMAKE_MATCH_1}-linux-${CPACK_CMAKE_SYSTEM_PROCESSOR})
if(CPACK_GENERATOR STREQUAL "DEB")
    set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
endif()
