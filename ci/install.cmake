# What `cmake --install` puts where, by components, and the Debian packages that CPack makes of them (ci/package). Nothing depends on the prefix: the
# program finds its parts and its data from where it lies.
include(GNUInstallDirs)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # `all` has the tests, too; what is installed comes with the target `fernlicht`
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(manual ${CMAKE_BINARY_DIR}/generated/manual)
set(parts lib/fernlicht/modules) # two levels down: from files of lib/NAME CPack concludes that the package has libraries for others

install(TARGETS fernlicht RUNTIME DESTINATION bin COMPONENT program)
install(TARGETS fernlicht-svg fernlicht-ipopt fernlicht-zip fernlicht-gltf LIBRARY DESTINATION ${parts} COMPONENT program)
install(FILES scenarios/control/fernlicht_control.h DESTINATION include/fernlicht/scenarios/control COMPONENT program) # for control laws in C
install(TARGETS fernlicht-openimageio LIBRARY DESTINATION ${parts} COMPONENT openimageio)
if(TARGET fernlicht-import)
  install(TARGETS fernlicht-import RUNTIME DESTINATION ${parts} COMPONENT import)
endif()
install(DIRECTORY scenarios/library/ DESTINATION share/fernlicht COMPONENT data)
file(GLOB_RECURSE schemas CONFIGURE_DEPENDS scenarios/*.schema.json runner/*.schema.json)
install(FILES ${schemas} DESTINATION share/fernlicht/schemas COMPONENT schemas)
install(DIRECTORY ${manual}/man/ DESTINATION share/man/man1 COMPONENT man)
install(FILES ${manual}/bash DESTINATION share/bash-completion/completions RENAME fernlicht COMPONENT completions)
install(FILES ${manual}/fish DESTINATION share/fish/vendor_completions.d RENAME fernlicht.fish COMPONENT completions)
# Debian's zsh looks into this folder below /usr, and into the usual one below /usr/local.
install(CODE "set(folder site-functions)
  if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\")
    set(folder vendor-completions)
  endif()
  file(INSTALL \"${manual}/zsh\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/share/zsh/\${folder}\" RENAME _fernlicht)" COMPONENT completions)
install(FILES README.md CHANGELOG.md ARCHITECTURE.md SECURITY.md CITATION.cff DESTINATION share/doc/fernlicht COMPONENT docs)
install(DIRECTORY docs DESTINATION share/doc/fernlicht COMPONENT docs)

# Packages of Debian. What brings many libraries along is a package of its own.
set(packages program openimageio import docs)
set(package_of_program fernlicht)
set(package_of_openimageio fernlicht-openimageio)
set(package_of_import fernlicht-import)
set(package_of_docs fernlicht-doc)
set(about_program "night drives played offscreen, headlamps measured
fernlicht plays scripted night drives through an offscreen renderer and
measures what the headlamps do: how far and how wide the road is lit, what
dazzles others, and which differences are real. It reads photometric files,
OpenDRIVE roads and OpenSCENARIO storyboards, and needs no GPU.")
set(about_openimageio "pictures of more formats for fernlicht
The part of fernlicht that reads pictures by OpenImageIO, so that they can be
compared. Pictures in PNG, JPEG and OpenEXR are read without it.")
set(about_import "OpenFlight databases for fernlicht
The part of fernlicht that reads OpenFlight by OpenSceneGraph: it belongs to
the command fernlicht import.")
set(about_docs "documentation of fernlicht
The pages that explain files, commands, readings and methods of fernlicht,
ordered by role and by task, with its changes and its architecture.")
set(needs_openimageio "fernlicht (= ${PROJECT_VERSION})")
set(needs_import "fernlicht (= ${PROJECT_VERSION})")
# Mesa and fonts are opened by name, so no tool sees them. OSMesa is the second backend, and Debian 13 has none.
set(needs_program "libegl1, libegl-mesa0, libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_DEBIAN_FERNLICHT_PACKAGE_RECOMMENDS "libosmesa6")
set(CPACK_DEBIAN_FERNLICHT_PACKAGE_SUGGESTS "fernlicht-doc, fernlicht-openimageio, fernlicht-import")
set(CPACK_DEBIAN_FERNLICHT-DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_FERNLICHT-DOC_PACKAGE_SECTION doc)

string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH, where it is set
set(maintainer "fernlicht contributors <contributors@fernlicht.invalid>")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/debian/changelog @ONLY CONTENT "fernlicht (@PROJECT_VERSION@) unstable; urgency=medium

  * Version @PROJECT_VERSION@. The package fernlicht-doc has what changed for users:
    /usr/share/doc/fernlicht/CHANGELOG.md

 -- @maintainer@  @now@
")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/debian/copyright @ONLY CONTENT "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: fernlicht

Files: *
Copyright: 2026 fernlicht contributors
License: Apache-2.0
 On Debian systems the text of the Apache License, version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.
")
execute_process(COMMAND gzip -9nkf ${CMAKE_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(groups "")
foreach(name ${packages})
  if(name STREQUAL "import" AND NOT TARGET fernlicht-import)
    continue()
  endif()
  set(package ${package_of_${name}})
  string(TOUPPER ${package} upper)
  install(FILES ${CMAKE_BINARY_DIR}/debian/copyright ${CMAKE_BINARY_DIR}/debian/changelog.gz DESTINATION share/doc/${package} COMPONENT ${name} EXCLUDE_FROM_ALL)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${about_${name}}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${needs_${name}}")
  list(APPEND groups ${package})
endforeach()
set(CPACK_COMPONENTS_ALL program openimageio import docs data schemas man completions)
if(NOT TARGET fernlicht-import)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL import)
endif()
include(CPack)
foreach(component ${CPACK_COMPONENTS_ALL})
  set(package fernlicht)
  if(DEFINED package_of_${component})
    set(package ${package_of_${component}})
  endif()
  cpack_add_component(${component} GROUP ${package})
endforeach()
