# Compiler settings that every target of ours takes: `target_link_libraries(x PRIVATE voledit_options)`.
add_library(voledit_options INTERFACE)
target_compile_options(voledit_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Werror
  # GCC 12 sees overlaps in `"text" + std::string` that are not there (its bug 105329).
  -Wno-restrict
  # Fused multiply-adds would make pictures depend on the processor.
  -ffp-contract=off)
target_include_directories(voledit_options INTERFACE ${CMAKE_SOURCE_DIR})

option(VOLEDIT_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
if(VOLEDIT_SANITIZE)
  target_compile_options(voledit_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined
    # Instrumented code makes GCC 12 take parts of std::regex for uninitialised.
    -Wno-maybe-uninitialized)
  target_link_options(voledit_options INTERFACE -fsanitize=address,undefined)
endif()
option(VOLEDIT_COVERAGE "gcov counters" OFF)
if(VOLEDIT_COVERAGE)
  target_compile_options(voledit_options INTERFACE --coverage)
  target_link_options(voledit_options INTERFACE --coverage)
endif()

# voledit_precompile(NAME HEADERS… | FROM OTHER): compiles the headers that most files of NAME include once for all of
# them, or takes those of another target of the same flags. Not under a compiler cache, which sees through plain
# headers only; there, files that include too little fail.
function(voledit_precompile name)
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    return()
  endif()
  if(ARGV1 STREQUAL "FROM")
    target_precompile_headers(${name} REUSE_FROM ${ARGV2})
  else()
    target_precompile_headers(${name} PRIVATE ${ARGN})
  endif()
endfunction()
