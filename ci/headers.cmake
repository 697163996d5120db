# The target `headers` compiles every header by itself, with the flags and libraries of the library it belongs to:
# a header that leans on what its includer happened to include before fails here. Not part of `all`.
add_custom_target(headers)
foreach(library scenarios metrics renderer runner)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/${library}/*.h)
  set(sources "")
  foreach(header ${headers})
    string(MAKE_C_IDENTIFIER ${header} name)
    set(source ${CMAKE_BINARY_DIR}/generated/headers/${name}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n" @ONLY)
    list(APPEND sources ${source})
  endforeach()
  if(sources)
    add_library(headers_${library} OBJECT EXCLUDE_FROM_ALL ${sources})
    target_link_libraries(headers_${library} PRIVATE $<TARGET_PROPERTY:fernlicht_${library},LINK_LIBRARIES>)
    add_dependencies(headers_${library} fernlicht_${library}) # which generates the GL loader and the embedded files
    add_dependencies(headers headers_${library})
  endif()
endforeach()
