# What the programs are built from, what is installed, and the packages made of it.
#
# `cmake --install build/release --prefix /usr/local`: programs, what they read, what a desktop shows of them, and their
# documents. Programs find resources beside themselves (bin/../share/tactoscope): the tree can be moved.
# `./dev package` makes the packages.

find_package(pugixml REQUIRED)
set(version_libraries "Qt=${Qt6_VERSION}" "Boost=${Boost_VERSION_STRING}" "Eigen=${Eigen3_VERSION}" "fmt=${fmt_VERSION}"
    "nlohmann-json=${nlohmann_json_VERSION}" "pugixml=${pugixml_VERSION}" "zlib=${ZLIB_VERSION_STRING}")
foreach(module FFTW SQLITE SODIUM USB HIDAPI SIGROK SNDFILE HDF5 DEFLATE XMLSEC ZIP ZSTD)
    list(APPEND version_libraries "${${module}_MODULE_NAME}=${${module}_VERSION}")
endforeach()
# version_in(NAME HEADER PATTERN): of a library that tells its version in a header only
function(version_in name header pattern)
    find_file(TACTOSCOPE_${name}_HEADER ${header} REQUIRED PATH_SUFFIXES qt6 HINTS ${Qt6Core_INCLUDE_DIRS})
    file(STRINGS ${TACTOSCOPE_${name}_HEADER} line REGEX "${pattern}" LIMIT_COUNT 1)
    if(NOT line MATCHES "${pattern}")
        message(FATAL_ERROR "${TACTOSCOPE_${name}_HEADER} tells no version of ${name}; ${pattern} is expected")
    endif()
    set(version_libraries ${version_libraries} "${name}=${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()
version_in(QCustomPlot qcustomplot.h "define QCUSTOMPLOT_VERSION_STR \"([0-9.]+)\"")
version_in(QScintilla Qsci/qsciglobal.h "define QSCINTILLA_VERSION_STR +\"([0-9.]+)\"")
# EDFlib tells it when it runs (Debian's file of 1.27 is called libedf.so.1.23), and zxcvbn nowhere.
try_run(edf_runs edf_compiles
    SOURCE_FROM_CONTENT edf_version.cpp "#include <edflib.h>
#include <cstdio>
int main() { std::printf(\"%d.%02d\", edflib_version() / 100, edflib_version() % 100); }"
    LINK_LIBRARIES ${TACTOSCOPE_EDF} RUN_OUTPUT_VARIABLE edf)
if(NOT edf MATCHES "^[0-9]+[.][0-9]+$")
    message(FATAL_ERROR "EDFlib tells no version: '${edf}'")
endif()
list(APPEND version_libraries "EDFlib=${edf}" "zxcvbn=unversioned")
# Asked of git at each build; only this small file and the programs' links follow a commit.
set(version_file ${CMAKE_BINARY_DIR}/core/base/ProgramVersion.cpp)
add_custom_target(ask_version
    COMMAND ${CMAKE_COMMAND} -D release=${PROJECT_VERSION}
            -D "compiler=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" -D "libraries=${version_libraries}"
            -D out=${version_file} -P ${PROJECT_SOURCE_DIR}/resources/packaging/ProgramVersion.cmake
    BYPRODUCTS ${version_file} VERBATIM)
add_library(tacto_program_version OBJECT ${version_file})
set_target_properties(tacto_program_version PROPERTIES AUTOMOC OFF UNITY_BUILD OFF)
target_link_libraries(tacto_program_version PRIVATE bench_options)
add_dependencies(tacto_program_version ask_version)
foreach(program tactoscope tactoscope-cli tactoscope-report)
    target_link_libraries(${program} PRIVATE tacto_program_version)
endforeach()
foreach(program ${programs})
    target_link_options(${program} PRIVATE -pie)
endforeach()

install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(PROGRAMS ${PROJECT_SOURCE_DIR}/resources/packaging/install-rules DESTINATION ${CMAKE_INSTALL_BINDIR}
        RENAME tactoscope-install-rules)
# Icons are built in; licences stand in copyright.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/resources/ DESTINATION ${CMAKE_INSTALL_DATADIR}/tactoscope
        PATTERN desktop EXCLUDE PATTERN packaging EXCLUDE PATTERN udev EXCLUDE PATTERN icons EXCLUDE PATTERN LICENSE EXCLUDE)
# udev reads /usr/local/lib/udev and /usr/lib/udev alike.
install(FILES ${PROJECT_SOURCE_DIR}/resources/udev/70-tactoscope.rules DESTINATION lib/udev/rules.d)
set(desktop ${PROJECT_SOURCE_DIR}/resources/desktop/io.github.tactoscope.Tactoscope)
install(FILES ${desktop}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${desktop}.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES ${desktop}.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(CODE "execute_process(COMMAND \"${PROJECT_SOURCE_DIR}/resources/packaging/documents\" \"${CMAKE_RUNTIME_OUTPUT_DIRECTORY}\"
                                      \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\" COMMAND_ERROR_IS_FATAL ANY)")

set(CPACK_PACKAGE_NAME tactoscope)
set(CPACK_PACKAGE_CONTACT "Tactoscope authors <tactoscope@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "desktop bench for tactile-feedback stimulation")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Senses what a fingertip feels, encodes texture and pressure into pulse trains,
judges every train against limits before it is delivered, measures what really
came out, and records all of it. With a window and a command line.

A research bench, not a medical device. Its drivers for hardware have been
tried on emulated devices only.")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/../package)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Beside the libraries: the fonts of window and reports, the platform on which reports are drawn, and what reads the
# pictures of style sheets, which was part of a library.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "fonts-noto-core, fonts-dejavu-core, qt6-qpa-plugins, qt6-svg-plugins | libqt6svg6 (<< 6.7.2-5~)")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS qt6-wayland)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "pulseview, python3-pyvisa-py")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_CMAKE_BINARY_DIR ${CMAKE_BINARY_DIR})
set(CPACK_CMAKE_SYSTEM_PROCESSOR ${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/resources/packaging/Package.cmake)
include(CPack)
