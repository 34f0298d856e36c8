# voledit_module(NAME [SUBFOLDERS …] DEPENDS …): the static library voledit_NAME of the sources in this folder and in the
# named folders below it.
# A module states all that it may include in its one line of DEPENDS; tests/layering_test.cmake checks the rest.
function(voledit_module name)
  cmake_parse_arguments(M "" "" "SUBFOLDERS;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(folder IN LISTS M_SUBFOLDERS)
    file(GLOB more CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    list(APPEND sources ${more})
  endforeach()
  if(sources)
    add_library(voledit_${name} STATIC ${sources})
    target_link_libraries(voledit_${name} PUBLIC ${M_DEPENDS} PRIVATE voledit_options ${M_PRIVATE_DEPENDS})
  else()
    add_library(voledit_${name} INTERFACE)
    target_link_libraries(voledit_${name} INTERFACE ${M_DEPENDS})
  endif()
endfunction()
